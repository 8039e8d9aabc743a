# SPDX-License-Identifier: BSD-3-Clause
"""netgen_optimize.py IN.vtu OUT.vtu: Netgen's optimization of a volume mesh, its surface kept; prints the seconds."""
import sys
import time

import formats
import netgen.meshing as netgen
import numpy as np

ORDER = [0, 1, 3, 2]  # Netgen's tetrahedra are numbered the other way round


def main():
    points, cells = formats.read(sys.argv[1])
    mesh = netgen.Mesh(3)
    face = mesh.Add(netgen.FaceDescriptor(bc=1, domin=1, domout=0, surfnr=1))
    ids = [mesh.Add(netgen.MeshPoint(netgen.Point3d(*p))) for p in points.tolist()]
    for triangle in formats.boundary(cells).tolist():
        mesh.Add(netgen.Element2D(face, [ids[p] for p in triangle]))
    for cell in cells[:, ORDER].tolist():
        mesh.Add(netgen.Element3D(1, [ids[p] for p in cell]))
    mesh.CalcLocalH(0.3)
    start = time.perf_counter()
    mesh.OptimizeVolumeMesh()
    seconds = time.perf_counter() - start
    points = np.array([p.p for p in mesh.Points()])
    cells = np.array([[v.nr for v in cell.vertices] for cell in mesh.Elements3D()]) - 1
    formats.write(sys.argv[2], points, cells[:, ORDER])
    print("seconds", seconds)


if __name__ == "__main__":
    main()
