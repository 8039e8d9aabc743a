# SPDX-License-Identifier: BSD-3-Clause
"""Random solids: booleans of boxes, cylinders and spheres by Gmsh (OpenCASCADE; Debian: python3-gmsh), filled by TetGen.

fuzz_solids.py uses them. Gmsh runs in a child process: it ends the process where it fails.
"""
import importlib.util
import os
import pickle
import signal

import numpy as np
from meshoptimize import vtkTetGenFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkCellArray, vtkPolyData, vtkUnstructuredGrid


def is_missing():
    """What to do about it, or nothing."""
    if importlib.util.find_spec("gmsh") is None:
        return "Gmsh's Python module is missing: apt-get install python3-gmsh"
    return None


def in_child(function, seconds):
    """(result, None) of a function that may end its process or take too long, or (None, what happened)."""
    receive, send = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(receive)
        status = 1
        try:
            signal.alarm(max(int(seconds), 1))
            with os.fdopen(send, "wb") as pipe:
                pickle.dump(function(), pipe)
            status = 0
        finally:
            os._exit(status)
    os.close(send)
    with os.fdopen(receive, "rb") as pipe:
        data = pipe.read()
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status == -signal.SIGALRM:
        return None, f"took more than {seconds} s"
    if status < 0:
        return None, f"ended by signal {-status} ({signal.Signals(-status).name})"
    return (pickle.loads(data), None) if status == 0 else (None, f"ended with status {status}")


def rotation(random):
    q = np.linalg.qr(random.normal(size=(3, 3)))[0]
    return q * np.sign(np.linalg.det(q))


class Primitive:
    """A box, cylinder or sphere with its axes; contains() says which points are in it."""

    def __init__(self, random, is_turned):
        self.kind = str(random.choice(["box", "box", "cylinder", "cylinder", "sphere"]))
        self.centre = random.uniform(-0.4, 0.4, 3)
        if not is_turned and random.random() < 0.4:
            self.centre = random.integers(-2, 3, 3) / 5.0  # faces that meet
        self.size = random.uniform(0.15, 0.6, 3)
        if not is_turned and random.random() < 0.4:
            self.size = random.integers(1, 4, 3) / 5.0
        self.axes = rotation(random) if is_turned or self.kind == "sphere" else np.eye(3)  # of spheres: Gmsh's seam

    def make(self, occ):
        x, s = self.centre, self.size
        if self.kind == "box":
            tag = occ.addBox(*(-s), *(2 * s))
        elif self.kind == "cylinder":
            tag = occ.addCylinder(0, 0, -s[1], 0, 0, 2 * s[1], s[0])
        else:
            tag = occ.addSphere(0, 0, 0, s[0])
        occ.affineTransform([(3, tag)], np.c_[self.axes, x].ravel().tolist() + [0, 0, 0, 1])
        return (3, tag)

    def contains(self, points):
        y, s = (points - self.centre) @ self.axes, self.size
        if self.kind == "box":
            return (np.abs(y) < s).all(axis=1)
        if self.kind == "cylinder":
            return (np.abs(y[:, 2]) < s[1]) & (np.hypot(y[:, 0], y[:, 1]) < s[0])
        return (y ** 2).sum(axis=1) < s[0] ** 2


def mesh_of_surface(make, count, algorithm=6):
    """(points, triangles, face of each) of the volumes that make(occ) gives, divided into about so many triangles. To be called in
    a child."""
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    occ = gmsh.model.occ
    body = [x for x in make(occ) if x[0] == 3]
    occ.synchronize()
    faces = sorted({abs(tag) for _, tag in gmsh.model.getBoundary(body, combined=False, oriented=False)})
    length = (sum(occ.getMass(2, tag) for tag in faces) / count / 0.43) ** 0.5
    gmsh.option.setNumber("Mesh.CharacteristicLengthMin", length)
    gmsh.option.setNumber("Mesh.CharacteristicLengthMax", length)
    gmsh.option.setNumber("Mesh.Algorithm", algorithm)
    gmsh.model.mesh.generate(2)
    tags, x, _ = gmsh.model.mesh.getNodes()
    place = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    place[tags.astype(np.int64)] = np.arange(len(tags))
    triangles = [place[gmsh.model.mesh.getElementsByType(2, tag)[1].astype(np.int64)].reshape(-1, 3) for tag in faces]
    owners = np.repeat(faces, [len(t) for t in triangles])
    used, local = np.unique(np.concatenate(triangles), return_inverse=True)
    return np.array(x).reshape(-1, 3)[used], local.reshape(-1, 3), owners


class Solid:
    """points, triangles of its surface and of the walls in it, the face of the solid that each is of."""

    def __init__(self, random):
        turned = random.random() < 0.5
        self.parts = [Primitive(random, turned) for _ in range(random.integers(2, 4))]
        self.operations = [str(x) for x in random.choice(["fuse", "cut", "cut", "intersect"], len(self.parts) - 1)]
        self.has_materials = random.random() < 0.35
        if self.has_materials:
            self.operations[-1] = "fragment"
        self.count = float(10 ** random.uniform(2.1, 3.1))  # of triangles, about
        self.algorithm = int(random.choice([1, 5, 6]))
        self.text = self.parts[0].kind + "".join(f" {o} {p.kind}" for o, p in zip(self.operations, self.parts[1:]))
        self.text += ", turned" if turned else ""
        done, self.fault = in_child(self.mesh, 20)
        if done:
            self.points, self.triangles, self.faces = done

    def mesh(self):
        return mesh_of_surface(self.make, self.count, self.algorithm)

    def make(self, occ):
        body = [self.parts[0].make(occ)]
        for operation, part in zip(self.operations, self.parts[1:]):
            tool = [part.make(occ)]
            if operation == "fragment":
                out, origin = occ.fragment(body, tool)
                keep = sorted({x for one in origin[:len(body)] for x in one})
                occ.remove([x for x in out if x not in keep], recursive=True)
                body = keep
            else:
                body = getattr(occ, operation)(body, tool)[0]
        return body

    def contains(self, points):
        good = self.parts[0].contains(points)
        for operation, part in zip(self.operations, self.parts[1:]):
            other = part.contains(points)
            good = {"fuse": good | other, "cut": good & ~other, "intersect": good & other, "fragment": good}[operation]
        return good

    def throw(self, random):
        """Displaces nodes: of flat faces within the face, so that they stay flat; or all, a little."""
        p, t = self.points, self.triangles
        edges = np.linalg.norm(p[t] - p[np.roll(t, 1, axis=1)], axis=2)
        reach = np.full(len(p), np.inf)
        for k in range(3):
            np.minimum.at(reach, t[:, k], np.minimum(edges[:, k], edges[:, (k + 1) % 3]))
        way = random.uniform(-1, 1, p.shape)
        if random.random() < 0.5:
            for face in np.unique(self.faces):
                mine, others = np.unique(t[self.faces == face]), np.unique(t[self.faces != face])
                inner = np.setdiff1d(mine, others)
                x = p[mine] - p[mine].mean(axis=0)
                value, vector = np.linalg.svd(x, full_matrices=True)[1:]
                is_flat = len(mine) > 3 and value[2] < 1e-9
                way[inner] = way[inner] - np.outer(way[inner] @ vector[2], vector[2]) if is_flat else 0.0
                way[np.intersect1d(mine, others)] = 0.0
            factor, how = random.choice([0.2, 0.5]), "in its flat faces"
        else:
            factor, how = random.choice([1e-4, 1e-2, 0.05, 0.15]), "thrown"
        was = np.cross(p[t[:, 1]] - p[t[:, 0]], p[t[:, 2]] - p[t[:, 0]])
        while True:  # until no facet folds onto its neighbours
            x = p + factor * way * reach[:, None]
            now = np.cross(x[t[:, 1]] - x[t[:, 0]], x[t[:, 2]] - x[t[:, 0]])
            cosine = (was * now).sum(axis=1) / np.linalg.norm(was, axis=1) / np.maximum(np.linalg.norm(now, axis=1), 1e-300)
            if cosine.min() > 0.5:
                break
            factor /= 2
        self.points = x
        self.text += f", {how} {factor:g}"


def polydata(points, triangles):
    data, x, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    x.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int64), deep=1),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(triangles, dtype=np.int64).ravel(), deep=1))
    data.SetPoints(x)
    data.SetPolys(cells)
    return data


def fill(points, triangles, ratio=2.0, volume=0.0):
    """(points, tetrahedra, compartment of each), or what TetGen says."""
    f, messages = vtkTetGenFilter(), []

    def observe(caller, name, text):
        messages.append(text)
    observe.CallDataType = "string0"
    f.AddObserver("ErrorEvent", observe)
    f.GetExecutive().AddObserver("ErrorEvent", observe)
    f.SetInputData(polydata(points, triangles))
    f.SetMaximumRadiusEdgeRatio(ratio)
    f.SetMaximumVolume(volume)
    f.SetOptimizationLevel(0)
    f.Update()
    out = f.GetOutput()
    if messages or out.GetNumberOfCells() == 0:
        return None, messages[0] if messages else "no tetrahedra"
    return (vtk_to_numpy(out.GetPoints().GetData()).astype(float),
            vtk_to_numpy(out.GetCells().GetConnectivityArray()).reshape(-1, 4).astype(np.int64),
            vtk_to_numpy(out.GetCellData().GetArray("Region")).astype(int)), None


def grid_of(points, cells, regions, triangles=None, faces=None):
    """Tetrahedra with the array Region; triangles, if any, with the array Face (0 for tetrahedra)."""
    grid, x, all_cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    x.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=float), deep=1))
    count = 0 if triangles is None else len(triangles)
    nodes = cells.ravel() if not count else np.concatenate([cells.ravel(), triangles.ravel()])
    offsets = np.concatenate([np.arange(0, 4 * len(cells) + 1, 4), 4 * len(cells) + 3 * np.arange(1, count + 1)])
    all_cells.SetData(numpy_to_vtkIdTypeArray(offsets.astype(np.int64), deep=1),
                      numpy_to_vtkIdTypeArray(np.ascontiguousarray(nodes, dtype=np.int64), deep=1))
    types = np.repeat(np.array([VTK_TETRA, VTK_TRIANGLE], dtype=np.uint8), [len(cells), count])
    grid.SetPoints(x)
    grid.SetCells(numpy_to_vtk(types, deep=1), all_cells)
    arrays = {"Region": np.r_[regions, np.zeros(count, dtype=int)]}
    if count:
        arrays["Face"] = np.r_[np.zeros(len(cells), dtype=int), faces]
    for name, values in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(values, dtype=np.int32), deep=1)
        array.SetName(name)
        grid.GetCellData().AddArray(array)
    return grid
