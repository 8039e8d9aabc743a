# SPDX-License-Identifier: BSD-3-Clause
"""cpack makes a Debian package and a .tar.gz; unpacked in a folder, its plugin, commands, Python and CMake packages work."""
import sys

from package_case import BUILD, PELLET, PVPYTHON, SOURCE, WORK, fresh_folder, run, use_commands

PARAVIEW = """
import sys
from paraview import simple
simple.LoadPlugin(sys.argv[1], ns=globals())
mesh = simple.XMLUnstructuredGridReader(FileName=[sys.argv[2]])
optimized = MeshOptimize(Input=mesh, TargetQuality=0.3, Effort="Quick")
optimized.UpdatePipeline()
optimized.UpdatePropertyInformation()
assert optimized.WorstQualityBefore < 0.01 < 0.2 < optimized.WorstQualityAfter, optimized.WorstQualityAfter
"""


def unpack():
    """The folder that stands for /usr, out of the Debian package if there is one, else out of the .tar.gz."""
    run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", WORK)
    archive, = WORK.glob("*.tar.gz")
    (WORK / "tar").mkdir()
    run("tar", "-xzf", archive, "-C", WORK / "tar")
    prefix, = (WORK / "tar").iterdir()
    packages = list(WORK.glob("*.deb"))
    if not packages:
        return prefix
    run("dpkg", "-x", packages[0], WORK / "deb")
    control = dict(line.split(": ", 1) for line in run("dpkg-deb", "-f", packages[0]).splitlines() if ": " in line)
    python = "python3 (>= {}.{})".format(*sys.version_info)
    assert python in control["Depends"] and "libstdc++6" in control["Depends"], control
    assert not PVPYTHON or "paraview (>= 5" in control["Depends"], control
    names = [{path.relative_to(top) for path in top.rglob("*") if path.is_file()} for top in (WORK / "deb/usr", prefix)]
    assert names[0] == names[1] and len(names[0]) > 50, names[0] ^ names[1]
    return WORK / "deb/usr"


def use_python(prefix):
    """As the interpreter reads a folder of packages, Debian's dist-packages among them, when it starts."""
    run("/usr/bin/python3", "-c", f"import site; site.addsitedir({str(prefix / 'lib/python3/dist-packages')!r})\n"
        f"import meshoptimize; assert meshoptimize.__file__.startswith({str(prefix)!r})")


def use_cmake(prefix):
    project = SOURCE / "Testing/Consumer/Project"
    run("cmake", "-S", project, "-B", WORK / "consumer", f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Debug")
    run("cmake", "--build", WORK / "consumer", "--target", "consumer")
    assert "worst quality" in run(WORK / "consumer/consumer")


def main():
    fresh_folder()
    prefix = unpack()
    use_commands(prefix / "bin")
    use_python(prefix)
    if PVPYTHON:
        plugin, = prefix.glob("lib*/**/plugins/MeshOptimize/MeshOptimize.so")
        (WORK / "use.py").write_text(PARAVIEW)
        run(PVPYTHON, WORK / "use.py", plugin, PELLET)
    use_cmake(prefix)


if __name__ == "__main__":
    main()
