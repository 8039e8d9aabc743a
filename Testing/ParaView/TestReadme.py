"""README.md shows what runs: code blocks equal their files, the tables of properties equal the plugin's XML.

A block is bound to its file by the comment before it:  <!-- file: path from the top of the repository -->
A table is bound to a proxy by:  <!-- properties: MeshOptimize -->
"""
import glob
import os
import re
import sys
import xml.etree.ElementTree as ElementTree

SOURCE = os.environ["MESHOPTIMIZE_SOURCE"]
readme = open(os.path.join(SOURCE, "README.md"), encoding="utf-8").read()
failures = []

blocks = re.findall(r"<!-- file: (\S+) -->\n```\w*\n(.*?)```\n", readme, re.DOTALL)
for path, shown in blocks:
    if open(os.path.join(SOURCE, path), encoding="utf-8").read() != shown:
        failures.append(f"README.md does not show {path} as it is")
if len(blocks) < 4:
    failures.append(f"only {len(blocks)} code blocks of README.md are bound to files")

for path in sorted(glob.glob(os.path.join(SOURCE, "ParaViewPlugin", "*.xml"))):
    proxy = os.path.splitext(os.path.basename(path))[0]
    table = re.search(rf"<!-- properties: {proxy} -->\n((?:\|.*\n)+)", readme)
    if not table:
        failures.append(f"README.md has no table of the properties of {proxy}")
        continue
    shown = {}
    for row in table.group(1).splitlines()[2:]:
        name, default = [cell.strip().strip("`") for cell in row.strip("|").split("|")[:2]]
        shown[name] = default
    xml = ElementTree.parse(path).find("ProxyGroup/SourceProxy")
    in_xml = {}
    for prop in xml:
        if not prop.tag.endswith("VectorProperty") or prop.get("information_only") == "1":
            continue
        default = prop.get("default_values", "none").split(";")[-1]
        for entry in prop.findall("EnumerationDomain/Entry"):
            if entry.get("value") == default:
                default = entry.get("text")
        if prop.find("BooleanDomain") is not None:
            default = {"0": "off", "1": "on"}[default]
        in_xml[prop.get("name")] = default
    for name in sorted(set(in_xml) | set(shown)):
        if in_xml.get(name) != shown.get(name):
            failures.append(f"{proxy}.{name}: {in_xml.get(name)} in the XML, {shown.get(name)} in README.md")

for failure in failures:
    print("FAILED:", failure)
sys.exit(1 if failures else 0)
