# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files: VTK's by VTK, the others by meshio. README.md beside this file says what survives in which format."""
import contextlib
import io
import os
import pathlib
import re
import tempfile
import warnings

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader, vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

from . import _abaqus, _groups
from ._meshes import adapter
from ._run import MeshOptimizeError, collect, text_of

VTK_FORMATS = {".vtu": (vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter),
               ".vtk": (vtkUnstructuredGridReader, vtkUnstructuredGridWriter)}
MESHIO_FORMATS = {".msh": "gmsh", ".mesh": "medit", ".meshb": "medit", ".inp": "abaqus", ".bdf": "nastran",
                  ".nas": "nastran", ".fem": "nastran"}
SUFFIXES = (*VTK_FORMATS, *MESHIO_FORMATS)

# Meshes in several parts. The calls and commands take one grid; ParaView, with the plugin, takes them as they are.
_SCRIPT = 'from paraview.simple import *; SaveData("OUT{0}", proxy=MeshOptimize(Input=OpenDataFile("{1}")), DataMode="Binary")'
_OF_PARTS = {
    ".pvtu": "pieces, which ParaView optimizes on several ranks: mpirun -np 4 pvbatch ranks.py {1} OUT{0}, with ranks.py of "
             "ParaViewPlugin/Examples",
    **dict.fromkeys((".vtm", ".vtmb", ".vtpd", ".vtpc"), f"blocks, which ParaView optimizes. In pvpython: {_SCRIPT}"),
}

# Keywords at the beginning of a line that meshio passes over in silence, and those that it reads.
_KEYWORDS = {
    "medit": (re.compile(r"^\s*([A-Za-z]+)\s*\d*\s*$", re.MULTILINE),
              {"MeshVersionFormatted", "Dimension", "Vertices", "Edges", "Triangles", "Quadrilaterals", "Tetrahedra",
               "Prisms", "Pyramids", "Hexahedra", "Hexaedra", "End"}),
    "nastran": (re.compile(r"^([A-Z][A-Z0-9]*)", re.MULTILINE | re.IGNORECASE),
                {"BEGIN", "ENDDATA", "CEND", "GRID", "CTRIA3", "CQUAD4", "CQUAD8", "CTETRA", "CPYRAM", "CPENTA",
                 "CHEXA"}),
}


def suffix_of(path):
    suffix = pathlib.Path(path).suffix.lower()
    if suffix in _OF_PARTS:
        raise ValueError(f"{path}: a file of {_OF_PARTS[suffix].format(suffix, path)}")
    if suffix not in SUFFIXES:
        raise ValueError(f"{path}: the format {suffix or 'without a suffix'} is none of {', '.join(SUFFIXES)}")
    return suffix


def _import_meshio(path):
    try:
        import meshio
    except ImportError:
        raise MeshOptimizeError(f"{path}: this format needs meshio, which is not installed "
                                "(Debian: apt-get install python3-meshio; else: pip install meshio)") from None
    return meshio


@contextlib.contextmanager
def _meshio_speaking(path):
    """meshio writes its warnings to the standard error, and ends the program where it cannot read."""
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
            yield
    except (Exception, SystemExit) as error:
        text = " ".join(said.getvalue().split()) or str(error) or type(error).__name__
        hint = ("; of Gmsh 4 it reads only files with all elements in groups, or none: save without Mesh.SaveAll, or "
                "as version 2.2" if "gmsh:physical" in text else "")
        raise MeshOptimizeError(f"{path}: meshio cannot use it: {text}{hint}") from error
    for text in filter(None, said.getvalue().split("Warning:")):
        warnings.warn(f"{path}: meshio says:{' '.join(['', *text.split()])}", stacklevel=5)


def _warn_of_lost(path, format_name):
    pattern, known = _KEYWORDS[format_name]
    text = pathlib.Path(path).read_text(encoding="utf-8", errors="replace")
    lost = {word for word in pattern.findall(text) if word not in known and word.upper() not in known}
    if lost:
        warnings.warn(f"{path}: lost or changed: {', '.join(sorted(lost))}", stacklevel=4)


def _read_vtk(path, reader):
    errors, _ = collect(reader, "ErrorEvent", "WarningEvent")
    reader.SetFileName(os.fspath(path))
    # What reads XML within the reader cannot be observed: its messages are caught where VTK writes them.
    window, before = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(window)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        reader.Update()
    finally:
        vtkOutputWindow.SetInstance(before)
        vtkLogger.SetStderrVerbosity(verbosity)
    if errors:
        texts = f"{text_of(window.GetOutput())} {errors[0]}".strip()
        hint = ("; if it has raw appended data: this VTK may not read them, write it with SetDataModeToBinary()"
                if "not well-formed" in texts else "")
        raise MeshOptimizeError(f"{path}: {texts}{hint}")
    return reader.GetOutput()


@contextlib.contextmanager
def _without_element_data(path):
    """A Gmsh file that meshio can read: of version 2 it cannot read the values at elements."""
    content = pathlib.Path(path).read_bytes()
    without = content
    if re.match(rb"\$MeshFormat\s+2", content):
        without = re.sub(rb"\$ElementData\s.*?\$EndElementData\s*", b"", content, flags=re.DOTALL)
    if without == content:
        yield path
        return
    warnings.warn(f"{path}: lost: $ElementData, which meshio cannot read", stacklevel=5)
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / pathlib.Path(path).name
        copy.write_bytes(without)
        yield copy


def _read_meshio(path, suffix):
    meshio, format_name = _import_meshio(path), MESHIO_FORMATS[suffix]
    if format_name == "abaqus":
        return _abaqus.read(path)
    if suffix != ".meshb" and format_name in _KEYWORDS:
        _warn_of_lost(path, format_name)
    with _without_element_data(path) if format_name == "gmsh" else contextlib.nullcontext(path) as file:
        with _meshio_speaking(path):
            mesh = meshio.read(file, file_format=format_name)
    for name, values in mesh.cell_data.items():
        if [len(block) for block in mesh.cells] != [len(part) for part in values]:
            raise MeshOptimizeError(f"{path}: only some cells have a number in {name}")
    if mesh.point_data.pop("nastran:ref", None) is not None:
        warnings.warn(f"{path}: lost: the coordinate systems of GRID; all coordinates are taken for basic ones",
                      stacklevel=3)
    return mesh


def read(path):
    """Read a mesh file.

    Parameters
    ----------
    path : str or path
        .vtu, .vtk by VTK; .msh (Gmsh), .mesh, .meshb (Medit), .inp (Abaqus), .bdf, .nas, .fem (Nastran) by meshio.

    Returns
    -------
    vtkUnstructuredGrid or meshio.Mesh

    Raises
    ------
    FileNotFoundError
    ValueError
        A suffix of no known format.
    MeshOptimizeError
        A file that cannot be read, or meshio is missing.

    Warns
    -----
    UserWarning
        What of the file is left out.
    """
    suffix = suffix_of(path)
    if not os.path.isfile(path):
        raise FileNotFoundError(f"{path} is not there")
    if suffix in VTK_FORMATS:
        return _read_vtk(path, VTK_FORMATS[suffix][0]())
    return _read_meshio(path, suffix)


def write(mesh, path):
    """Write a mesh file, in place of one that is there; whole or not at all.

    Parameters
    ----------
    mesh : vtkUnstructuredGrid, meshio.Mesh or a pair of arrays (points, cells)
    path : str or path
        As for `read`.

    Raises
    ------
    ValueError
        A suffix of no known format.
    MeshOptimizeError
        The file cannot be written, or meshio is missing.

    Warns
    -----
    UserWarning
        What of the mesh the format cannot hold.

    Examples
    --------
    >>> import os, tempfile
    >>> import numpy as np
    >>> import meshoptimize
    >>> tetrahedron = np.eye(4, 3), np.array([[3, 0, 1, 2]])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "tetrahedron.vtu")
    ...     meshoptimize.write(tetrahedron, path)
    ...     meshoptimize.read(path).GetNumberOfCells()
    1
    """
    suffix = suffix_of(path)
    path = pathlib.Path(path)
    part = path.with_name(f".{path.stem}.part{suffix}")  # in the same folder, so that it can be renamed
    try:
        if suffix in VTK_FORMATS:
            _write_vtk(mesh, part, VTK_FORMATS[suffix][1](), path)
        else:
            _write_meshio(mesh, part, MESHIO_FORMATS[suffix], path)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def _write_vtk(mesh, part, writer, path):
    grid = _groups.grid_of(mesh) if _groups.is_meshio(mesh) else adapter(mesh).grid
    errors, _ = collect(writer, "ErrorEvent", "WarningEvent")
    writer.SetInputDataObject(grid)
    writer.SetFileName(os.fspath(part))
    if hasattr(writer, "SetDataModeToBinary"):  # Debian's VTK cannot read raw appended data, the writer's default
        writer.SetDataModeToBinary()
    else:
        writer.SetFileTypeToBinary()
    if writer.Write() != 1 or errors:
        raise MeshOptimizeError(f"{path}: {' '.join(errors) or 'it cannot be written'}")


def _write_meshio(mesh, part, format_name, path):
    meshio = _import_meshio(path)
    if not _groups.is_meshio(mesh):
        mesh = _groups.mesh_of(adapter(mesh).grid)
    mesh, options, lost = _groups.PREPARE[format_name](mesh)
    if lost:
        warnings.warn(f"{path}: lost, as the format has no place for it: {', '.join(lost)}", stacklevel=3)
    with _meshio_speaking(path):
        meshio.write(part, mesh, **options)
