# SPDX-License-Identifier: BSD-3-Clause
"""README.md shows programs that run: each code block bound to a file equals that file. A test.

    python3 Testing/Pages/TestExamples.py

A block is bound to its file by the comment before it:  <!-- file: path from the top of the repository -->
The files themselves are run by tests: EXAMPLES says by which.
"""
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:<!-- file: (\S+) -->\n)?^```(\w+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
# What README.md must show, and where it is run.
EXAMPLES = {
    "ParaViewPlugin/Examples/paraview_example.py": "Testing/ParaView/CMakeLists.txt",
    "ParaViewPlugin/Examples/ranks.py": "Testing/ParaView/TestRanksExample.py",
    "ParaViewPlugin/Examples/one_call.py": "Testing/Python/CMakeLists.txt",
    "Testing/Consumer/Project/CMakeLists.txt": "Testing/Consumer/run.cmake",
    "Testing/Consumer/Project/consumer.cxx": "Testing/Consumer/run.cmake",
}


def main():
    faults = []
    blocks = BLOCK.findall((SOURCE / "README.md").read_text(encoding="utf-8"))
    for path, language, shown in blocks:
        if not path and language != "sh":
            faults.append(f"README.md shows {language} code that is no file: {shown.splitlines()[0]}")
        elif path and (SOURCE / path).read_text(encoding="utf-8") != shown:
            faults.append(f"README.md does not show {path} as it is")
    shown = [path for path, _, _ in blocks if path]
    for path, runner in EXAMPLES.items():
        if path not in shown:
            faults.append(f"README.md does not show {path}")
        name = path.rsplit("/", 1)[-1].split(".")[0]
        if name != "CMakeLists" and name not in (SOURCE / runner).read_text(encoding="utf-8"):
            faults.append(f"{runner} does not run {path}")
    faults += [f"README.md shows {path}, of which no test is known" for path in shown if path not in EXAMPLES]
    for fault in faults:
        print("FAILED:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
