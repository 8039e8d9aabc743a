# SPDX-License-Identifier: BSD-3-Clause
"""MeshOptimize in Python: one call, or the wrapped VTK classes.

    import meshoptimize
    mesh = meshoptimize.read("in.vtu")
    mesh, report = meshoptimize.optimize(mesh, target_quality=0.6)
    print(report)
    meshoptimize.write(mesh, "out.vtu")

    from meshoptimize import vtkMeshOptimizeFilter, vtkMeshQualityMinMax

vtkTetGenFilter is among the classes where the module was built with TetGen.
"""
from importlib.util import find_spec

import vtkmodules.vtkCommonExecutionModel  # noqa: F401  (base classes must be there first)
import vtkmodules.vtkParallelCore  # noqa: F401  (so must the class of the property Controller)
from vtkmodules.vtkCommonCore import vtkVersion

from ._built_with import VTK_VERSION

# The classes of one VTK cannot be used with those of another: without this the loader, or a crash, would say so.
if vtkVersion.GetVTKVersion() != VTK_VERSION:
    raise ImportError(
        f"meshoptimize was built with VTK {VTK_VERSION}, and this Python has VTK {vtkVersion.GetVTKVersion()} "
        f"({vtkmodules.__path__[0]}): build meshoptimize with that VTK, or use the Python of the VTK it was built with")

from .vtkFiltersMeshOptimize import *  # noqa: E402,F401,F403
from .vtkFiltersThermoelastic import *  # noqa: E402,F401,F403

if find_spec(__name__ + ".vtkFiltersTetGen"):
    from .vtkFiltersTetGen import *  # noqa: F401,F403

from ._api import optimize, quality  # noqa: E402,F401
from ._files import read, write  # noqa: E402,F401
from ._reports import OptimizeReport, QualityReport  # noqa: E402,F401
from ._run import MeshOptimizeError  # noqa: E402,F401
