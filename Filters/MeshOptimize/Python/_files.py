# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files: VTK's by VTK, the others by meshio. README.md beside this file says what survives in which format."""
import contextlib
import importlib
import io
import os
import pathlib
import re
import tempfile
import warnings

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import (vtkCompositeDataSet, vtkMultiBlockDataSet, vtkPartitionedDataSet,
                                           vtkPartitionedDataSetCollection, vtkUnstructuredGrid)
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader, vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

from . import _abaqus, _groups
from ._meshes import adapter
from ._run import MeshOptimizeError, collect, text_of

VTK_FORMATS = {".vtu": (vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter),
               ".vtk": (vtkUnstructuredGridReader, vtkUnstructuredGridWriter)}
MESHIO_FORMATS = {".msh": "gmsh", ".mesh": "medit", ".meshb": "medit", ".inp": "abaqus", ".bdf": "nastran",
                  ".nas": "nastran", ".fem": "nastran"}

# Files that name others, which have the parts: what they hold, and VTK's classes for them without Reader or Writer
_PARTS = {".pvtu": (vtkUnstructuredGrid, "vtkXMLPUnstructuredGrid"),
          ".vtm": (vtkMultiBlockDataSet, "vtkXMLMultiBlockData"), ".vtmb": (vtkMultiBlockDataSet, "vtkXMLMultiBlockData"),
          ".vtpd": (vtkPartitionedDataSet, "vtkXMLPartitionedDataSet"),
          ".vtpc": (vtkPartitionedDataSetCollection, "vtkXMLPartitionedDataSetCollection")}
SUFFIXES = (*VTK_FORMATS, *_PARTS, *MESHIO_FORMATS)

_SURFACES = (".stl", ".vtp", ".ply", ".obj", ".off")
_TO_BE_FILLED = "a surface, which has to be filled first: Tetrahedralize (TetGen) in ParaView, or vtkTetGenFilter"

# What VTK says after the error that counts
_FOLLOWS = ("Algorithm vtk", "No update piece number")

# Keywords at the beginning of a line that meshio passes over in silence, and those that it reads.
_KEYWORDS = {
    "medit": (re.compile(r"^\s*([A-Za-z]+)\s*\d*\s*$", re.MULTILINE),
              {"MeshVersionFormatted", "Dimension", "Vertices", "Edges", "Triangles", "Quadrilaterals", "Tetrahedra",
               "Prisms", "Pyramids", "Hexahedra", "Hexaedra", "End"}),
    "nastran": (re.compile(r"^([A-Z][A-Z0-9]*)", re.MULTILINE | re.IGNORECASE),
                {"BEGIN", "ENDDATA", "CEND", "GRID", "CTRIA3", "CQUAD4", "CQUAD8", "CTETRA", "CPYRAM", "CPENTA",
                 "CHEXA"}),
}


def suffix_of(path, to_read=False):
    suffix = pathlib.Path(path).suffix.lower()
    if to_read and suffix in _SURFACES:
        raise ValueError(f"{path}: {_TO_BE_FILLED}")
    if suffix not in SUFFIXES:
        raise ValueError(f"{path}: the format {suffix or 'without a suffix'} is none of {', '.join(SUFFIXES)}")
    return suffix


def blocks_in(path):
    """The class of composite data that a file of this suffix holds; None for one grid."""
    held = _PARTS.get(suffix_of(path), (vtkUnstructuredGrid,))[0]
    return None if held is vtkUnstructuredGrid else held


def check_blocks(kind, path):
    """ValueError if composite data of this class (None: one grid) have no place in a file of this suffix."""
    held = blocks_in(path)
    if kind and not (held and issubclass(kind, held)):
        fitting = [suffix for suffix, (other, _) in _PARTS.items() if issubclass(kind, other)]
        raise ValueError(f"{path}: blocks ({kind.__name__}) are written to {', '.join(fitting)} only")
    if held and not kind:
        raise ValueError(f"{path}: this format is for blocks, and the mesh is one grid")


def folder_of_parts(path):
    """The folder in which VTK puts the parts of a file of blocks; None for other files."""
    return pathlib.Path(path).with_suffix("") if blocks_in(path) else None


def _vtk_class(name):
    """A class of VTK that reads or writes XML. Which module has it depends on the version."""
    for module in ("vtkIOXML", "vtkIOParallelXML"):
        with contextlib.suppress(ImportError, AttributeError):
            return getattr(importlib.import_module("vtkmodules." + module), name)
    raise MeshOptimizeError(f"this VTK has no {name}")


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
    reader.SetFileName(os.fsencode(path))
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
    said = window.GetOutput() or ""
    if errors or "ERROR:" in said:  # a part that cannot be read is no error of the file that names it
        texts = [text_of(text) for text in re.split(r"(?=ERROR: In )", said)]
        texts = " ".join([*(text for text in texts if not text.startswith(_FOLLOWS)), *errors[:1]]).strip()
        if "dataset type: polydata" in texts:
            raise MeshOptimizeError(f"{path}: {_TO_BE_FILLED}")
        hint = ("; if it has raw appended data: this VTK may not read them, write it with SetDataModeToBinary()"
                if "not well-formed" in texts else "")
        raise MeshOptimizeError(f"{path}: {texts}{hint}")
    return reader.GetOutputDataObject(0)


def _read_parts(path):
    """What is wrong is said of the part that it is wrong with."""
    try:
        return _read_vtk(path, _vtk_class(_PARTS[suffix_of(path)][1] + "Reader")())
    except MeshOptimizeError:
        names = re.findall(r'(?:file|Source)="([^"]+\.vtu)"', pathlib.Path(path).read_text("utf-8", "replace"))
        for name in names:
            _read_vtk(pathlib.Path(path).parent / name, vtkXMLUnstructuredGridReader())
        raise


def _read_pieces(path):
    """One grid of all pieces, without ghosts. Their points are not joined: on the two sides of a crack they coincide, too."""
    grid = _read_parts(path)
    grid.RemoveGhostCells()
    if pathlib.Path(path).read_text("utf-8", "replace").count("<Piece ") > 1:
        warnings.warn(f"{path}: the faces between the pieces stay as they are; on several ranks they are optimized, too: "
                      "mpirun -np 4 pvbatch ranks.py IN.pvtu OUT.pvtu (ParaViewPlugin/Examples)", stacklevel=3)
    return grid


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
        .vtu, .vtk, .pvtu (pieces), .vtm, .vtmb, .vtpd, .vtpc (blocks) by VTK; .msh (Gmsh), .mesh, .meshb (Medit), .inp (Abaqus), .bdf, .nas, .fem (Nastran) by meshio.

    Returns
    -------
    vtkUnstructuredGrid, meshio.Mesh, or composite data of VTK for a file of blocks

    Raises
    ------
    FileNotFoundError, IsADirectoryError
    ValueError
        A suffix of no known format.
    MeshOptimizeError
        A file that cannot be read, or meshio is missing.

    Warns
    -----
    UserWarning
        What of the file is left out.
    """
    suffix = suffix_of(path, to_read=True)
    if os.path.isdir(path):
        raise IsADirectoryError(f"{path} is a folder")
    if not os.path.isfile(path):
        raise FileNotFoundError(f"{path} is not there")
    if suffix in VTK_FORMATS:
        return _read_vtk(path, VTK_FORMATS[suffix][0]())
    if suffix == ".pvtu":
        return _read_pieces(path)
    if suffix in _PARTS:
        return _read_parts(path)
    return _read_meshio(path, suffix)


def write(mesh, path):
    """Write a mesh file, in place of one that is there; whole or not at all. Parts come before the file that names them.

    Parameters
    ----------
    mesh : vtkUnstructuredGrid, blocks of them, meshio.Mesh or a pair of arrays (points, cells)
    path : str or path
        As for `read`.

    Raises
    ------
    ValueError
        A suffix of no known format, or of one that is not for blocks.
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
    check_blocks(type(mesh) if isinstance(mesh, vtkCompositeDataSet) else None, path)
    if suffix in _PARTS:
        _write_parts(mesh, path, _vtk_class(_PARTS[suffix][1] + "Writer")())
        return
    part = path.with_name(f".{path.stem}.part{suffix}")  # in the same folder, so that it can be renamed
    try:
        if suffix in VTK_FORMATS:
            _write_vtk(mesh, part, VTK_FORMATS[suffix][1](), path)
        else:
            _write_meshio(mesh, part, MESHIO_FORMATS[suffix], path)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def _write_parts(mesh, path, writer):
    with tempfile.TemporaryDirectory(prefix=".", dir=path.parent) as folder:  # there, so that files can be renamed
        _write_vtk(mesh, pathlib.Path(folder) / path.name, writer, path)
        files = [file for file in pathlib.Path(folder).rglob("*") if file.is_file()]
        for file in sorted(files, key=lambda file: file.name == path.name):  # the file that names the others is last
            target = path.parent / file.relative_to(folder)
            target.parent.mkdir(exist_ok=True)
            os.replace(file, target)


def _write_vtk(mesh, part, writer, path):
    grid = _groups.grid_of(mesh) if _groups.is_meshio(mesh) else adapter(mesh).grid
    errors, _ = collect(writer, "ErrorEvent", "WarningEvent")
    writer.SetInputDataObject(grid)
    writer.SetFileName(os.fsencode(part))
    if isinstance(writer, vtkUnstructuredGridWriter):
        writer.SetFileTypeToBinary()
    else:  # Debian's VTK cannot read raw appended data, the writer's default
        writer.SetDataModeToBinary()
    if writer.Write() != 1 or errors:
        errors = [text for text in errors if not text.startswith(_FOLLOWS)]
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
