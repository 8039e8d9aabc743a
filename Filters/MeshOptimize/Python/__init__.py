"""MeshOptimize in Python: the wrapped VTK classes.

    from meshoptimize import vtkMeshOptimizeFilter, vtkMeshQualityMinMax
"""
import vtkmodules.vtkCommonExecutionModel  # noqa: F401  (base classes must be there first)
from .vtkFiltersMeshOptimize import *  # noqa: F401,F403
