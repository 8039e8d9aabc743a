# SPDX-License-Identifier: BSD-3-Clause
"""Filters/REFERENCE.md shows the properties and results of each filter as the plugin's XML has them. A test.

    python3 Testing/Pages/TestReference.py            its exit status is 1 if a table differs from the XML
    python3 Testing/Pages/TestReference.py --write    brings the tables up to date

A table is bound to a proxy by the comment before it:  <!-- properties: MeshOptimize -->  or  <!-- results: MeshOptimize -->
"""
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAGE = SOURCE / "Filters" / "REFERENCE.md"
TABLE = re.compile(r"<!-- (\w+): (\w+) -->\n((?:\|.*\n)+)")


def documentation(prop):
    return " ".join(prop.findtext("Documentation").split())


def default_of(prop):
    default = prop.get("default_values", "none").split(";")[-1]
    for entry in prop.findall("EnumerationDomain/Entry"):
        if entry.get("value") == default:
            default = entry.get("text")
    if prop.find("BooleanDomain") is not None:
        default = {"0": "off", "1": "on"}[default]
    return f"`{default}`"


def values_of(prop):
    if prop.get("command") == "SetInputArrayToProcess":
        return "array"
    if prop.find("BooleanDomain") is not None:
        return "on, off"
    for tag in ("IntRangeDomain", "DoubleRangeDomain"):
        domain = prop.find(tag)
        if domain is not None:
            low, high = domain.get("min"), domain.get("max")
            return f"{low} to {high}" if high else f"from {low}"
    entries = [entry.get("text") for entry in prop.findall("EnumerationDomain/Entry")]
    return ", ".join(entries)


def row(prop):
    return f"| `{prop.get('name')}` | {default_of(prop)} | {values_of(prop)} | {documentation(prop)} |"


def tables_of(path):
    """The two tables of one XML file, as they must stand in the page: (kind, proxy) -> text."""
    proxy = ElementTree.parse(path).find("ProxyGroup/SourceProxy")
    if proxy is None:  # no filter: Charts.xml
        return {}
    properties = {p.get("name"): p for p in proxy if p.tag.endswith("VectorProperty")}
    results = [name for name, p in properties.items() if p.get("information_only") == "1"]
    rows, shown = [], set()
    for group in proxy.findall("PropertyGroup"):  # as in the panel
        names = [p.get("name") for p in group.findall("Property") if p.get("name") not in results]
        rows += [f"| *{group.get('label')}* | | | |"] * bool(names) + [row(properties[name]) for name in names]
        shown.update(names)
    rows += [row(p) for name, p in properties.items() if name not in shown and name not in results]
    head = "| property | default | values | meaning |\n|---|---|---|---|\n"
    tables = {("properties", path.stem): head + "\n".join(rows) + "\n"}
    if results:
        tables["results", path.stem] = "| result | meaning |\n|---|---|\n" + "".join(
            f"| `{name}` | {documentation(properties[name])} |\n" for name in results)
    return tables


def main():
    expected = {}
    for path in sorted((SOURCE / "ParaViewPlugin").glob("*.xml")):
        expected.update(tables_of(path))
    page = PAGE.read_text(encoding="utf-8")
    if "--write" in sys.argv[1:]:
        PAGE.write_text(TABLE.sub(lambda m: f"<!-- {m[1]}: {m[2]} -->\n{expected[m[1], m[2]]}", page), encoding="utf-8")
        return 0
    shown = {(kind, proxy): text for kind, proxy, text in TABLE.findall(page)}
    faults = [f"a table of {kind} of {proxy}, which is no filter of the plugin" for kind, proxy in shown.keys() - expected.keys()]
    for key, text in sorted(expected.items()):
        if key not in shown:
            faults.append(f"no table of the {key[0]} of {key[1]}")
            continue
        have, want = shown[key].splitlines(), text.splitlines()
        faults += [f"{key[1]}: the XML has     {line}" for line in want if line not in have]
        faults += [f"{key[1]}: the page has    {line}" for line in have if line not in want]
        if not faults and have != want:
            faults.append(f"{key[1]}: {key[0]} in another order than in the XML, or twice")
    for fault in faults:
        print("FAILED:", fault[:200])
    if faults:
        print("If the XML is right: python3 Testing/Pages/TestReference.py --write")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
