# SPDX-License-Identifier: BSD-3-Clause
"""`pip install BUILD/python` in a virtual environment that sees the system's VTK: package and commands, and nothing fetched."""
import sys

from package_case import BUILD, PELLET, WORK, fresh_folder, run, skip, use_commands

CALL = """
import sys, meshoptimize
assert meshoptimize.__file__.startswith(sys.prefix), meshoptimize.__file__
mesh, report = meshoptimize.optimize(meshoptimize.read(sys.argv[1]), target_quality=0.2, effort="quick")
assert report.worst_after > 0.15 > report.worst_before, report
"""


def main():
    try:
        import ensurepip  # noqa: F401
        import venv  # noqa: F401
    except ImportError:
        skip("there is no pip for virtual environments (Debian: apt-get install python3-venv)")
    fresh_folder()
    environment = WORK / "environment"
    run(sys.executable, "-m", "venv", "--system-site-packages", environment)
    run(environment / "bin/pip", "install", "--no-index", "--disable-pip-version-check", BUILD / "python")
    run(environment / "bin/python", "-c", CALL, PELLET)
    use_commands(environment / "bin")
    files = run(environment / "bin/pip", "show", "--files", "meshoptimize")
    assert "libvtkFiltersMeshOptimize.so" in files and "mesh-quality" in files, files
    run(environment / "bin/pip", "uninstall", "--yes", "meshoptimize")
    assert not list(environment.rglob("meshoptimize")), "something is left"


if __name__ == "__main__":
    main()
