"""MeshOptimize in Python: the wrapped VTK classes.

    from meshoptimize import vtkMeshOptimizeFilter, vtkMeshQualityMinMax

vtkTetGenFilter is among them where the module was built with TetGen.
"""
from importlib.util import find_spec

import vtkmodules.vtkCommonExecutionModel  # noqa: F401  (base classes must be there first)
from .vtkFiltersMeshOptimize import *  # noqa: F401,F403
from .vtkFiltersThermoelastic import *  # noqa: F401,F403

if find_spec(__name__ + ".vtkFiltersTetGen"):
    from .vtkFiltersTetGen import *  # noqa: F401,F403
