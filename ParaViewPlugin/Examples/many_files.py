"""Many files, and a table of what was reached: /usr/bin/python3 many_files.py FOLDER IN.vtu ..."""
import csv
import pathlib
import sys

import meshoptimize

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
rows = []
for path in map(pathlib.Path, sys.argv[2:]):
    mesh, report = meshoptimize.optimize(meshoptimize.read(path), target_quality=0.3, time_limit=60)
    meshoptimize.write(mesh, folder / path.name)
    rows.append({"file": path.name, "cells": report.cells_after, "before": report.worst_before,
                 "after": report.worst_after, "bound": report.bound, "seconds": report.seconds, "stop": report.stop})
    print(f"{path.name}: {report.worst_before:.4f} -> {report.worst_after:.4f}")

with open(folder / "table.csv", "w", newline="") as file:
    table = csv.DictWriter(file, rows[0].keys())
    table.writeheader()
    table.writerows(rows)
