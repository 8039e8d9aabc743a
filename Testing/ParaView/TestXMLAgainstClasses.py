# SPDX-License-Identifier: BSD-3-Clause
"""Holds the plugin's XML against the wrapped classes: defaults, ranges, enumerations, ports, nothing missing.

Runs without ParaView's server manager: it reads the XML files as files. TestProxies.py then asks the loaded proxies.
"""
import glob
import os
import re
import sys
import xml.etree.ElementTree as ElementTree

import meshoptimize
from vtkmodules.vtkCommonExecutionModel import vtkUnstructuredGridAlgorithm

SOURCE = os.environ["MESHOPTIMIZE_SOURCE"]
# What the class can and the XML leaves out on purpose.
NOT_OFFERED = {
    # report only: an error in the optimizer
    ("MeshOptimize", "QualityMeasure"): {"MinimumDihedralAngle"},
}
NOT_IN_XML = {"MeshOptimize": {"Controller", "GeometryData"}, "MeshQualityMinMax": {"Controller"},
              "SolutionMetric": {"Controller"}, "Thermoelastic": {"Controller"},
              "TetGen": {"InteriorPointsData"}}

# What a script calls the proxy, where the label says more than the name.
PYTHON_NAMES = {"TetGen": "TetrahedralizeTetGen"}
# Modules that may be left out.
OPTIONAL = {"TetGen"}
# Arrays without which there is nothing to do have no default: ParaView takes the active ones. All others are None until chosen.
NEEDED_ARRAYS = {"SolutionMetric.SolutionArray"}

failures = []


def check(condition, message):
    if not condition:
        failures.append(message)


def numbers(text):
    return [float(word) for word in (text or "").split()]


def own_setters(filter_class):
    """Names X of the class' own SetX, without SetXToY and without what the superclass has."""
    inherited = set(dir(vtkUnstructuredGridAlgorithm))
    names = {m[3:] for m in dir(filter_class) if m.startswith("Set") and m not in inherited}
    return {n for n in names if not any(n.startswith(other + "To") for other in names)}


def check_number(proxy, prop, instance):
    name = prop.get("name")
    where = f"{proxy}.{name}"
    getter = getattr(instance, "Get" + name, None)
    check(getter is not None, f"{where}: the class has no Get{name}")
    if getter is None:
        return
    default = numbers(prop.get("default_values"))
    value = getter()
    check(default == [float(value)], f"{where}: default {default} in the XML, {value} in the class")

    domain = prop.find("IntRangeDomain")
    domain = prop.find("DoubleRangeDomain") if domain is None else domain
    if domain is not None:
        for end, method in (("min", "MinValue"), ("max", "MaxValue")):
            limit = getattr(instance, f"Get{name}{method}", None)
            check(limit is not None, f"{where}: the class has no Get{name}{method}")
            if limit is None:
                continue
            in_xml = domain.get(end)
            unlimited = abs(limit()) >= 1e6  # VTK_INT_MAX, ...: no limit that a slider should show
            if unlimited:
                check(in_xml is None, f"{where}: {end} {in_xml} in the XML, unlimited in the class")
            else:
                check(in_xml is not None and float(in_xml) == limit(),
                      f"{where}: {end} {in_xml} in the XML, {limit()} in the class")

    enumeration = prop.find("EnumerationDomain")
    if enumeration is not None:
        offered = set()
        for entry in enumeration.findall("Entry"):
            word = entry.get("text").replace(" ", "")
            offered.add(word)
            setter = getattr(instance, f"Set{name}To{word}", None)
            check(setter is not None, f"{where}: the class has no Set{name}To{word}")
            if setter is not None:
                setter()
                check(getter() == int(entry.get("value")),
                      f"{where}: {word} is {entry.get('value')} in the XML, {getter()} in the class")
        prefix = f"Set{name}To"
        available = {m[len(prefix):] for m in dir(instance) if m.startswith(prefix)}
        hidden = NOT_OFFERED.get((proxy, name), set())
        check(available - hidden == offered, f"{where}: the class offers {available}, the XML {offered}")
        if name == "QualityMeasure":
            check_measures(where, prefix, instance, available)


def check_measures(where, prefix, instance, available):
    """The class has the numbers of the core: they are cast from one to the other."""
    header = open(os.path.join(SOURCE, "Filters", "Core", "Quality", "Measure.h"), encoding="utf-8").read()
    body = re.search(r"enum class Measure\n\{(.*?)\n\};", header, re.DOTALL).group(1)
    core = {word: int(number) for word, number in re.findall(r"(\w+) =\s*(\d+)", body)}
    check(len(core) >= 7, f"{where}: the core has {core}")
    for word in available:
        getattr(instance, prefix + word)()
        check(instance.GetQualityMeasure() == core.get(word),
              f"{where}: {word} is {instance.GetQualityMeasure()} in the class, {core.get(word)} in the core")


def check_proxy(path):
    proxy_xml = ElementTree.parse(path).getroot().find("ProxyGroup/SourceProxy")
    if proxy_xml is None:  # no filter: Charts.xml
        return
    proxy = proxy_xml.get("name")
    if proxy in OPTIONAL and not hasattr(meshoptimize, proxy_xml.get("class")):
        return
    filter_class = getattr(meshoptimize, proxy_xml.get("class"))
    instance = filter_class()
    check(re.sub(r"[^A-Za-z0-9]", "", proxy_xml.get("label")) == PYTHON_NAMES.get(proxy, proxy),
          f"{proxy}: the label is the Python name")
    check(len(proxy_xml.findall("OutputPort")) == instance.GetNumberOfOutputPorts(),
          f"{proxy}: number of output ports")

    in_groups = [p.get("name") for p in proxy_xml.findall("PropertyGroup/Property")]
    named = set()
    connections = set()
    arrays = set()
    for prop in proxy_xml:
        if prop.tag == "InputProperty":
            check(hasattr(instance, prop.get("command")), f"{proxy}: the class has no {prop.get('command')}")
            check(len((prop.findtext("Documentation") or "").strip()) > 20, f"{proxy}: an input without documentation")
            connections.add(prop.get("command")[3:])
        if not prop.tag.endswith("VectorProperty"):
            continue
        name, command = prop.get("name"), prop.get("command")
        named.add(name)
        where = f"{proxy}.{name}"
        check(prop.get("label").replace(" ", "") == name, f"{where}: the label is the Python name")
        documentation = (prop.findtext("Documentation") or "").strip()
        check(len(documentation) > 20, f"{where}: no documentation")
        if prop.get("information_only") == "1":
            check(hasattr(instance, command), f"{where}: the class has no {command}")
        elif command == "SetInputArrayToProcess":
            needed = where in NEEDED_ARRAYS
            index, port, connection, association, default = prop.get("default_values", "0;0;0;0;").split(";")
            check(default == ("" if needed else "None") and (port, connection) == ("0", "0"), f"{where}: default {default}")
            check(index not in arrays, f"{where}: array index {index} used twice")
            arrays.add(index)
        elif prop.get("repeat_command") == "1":
            cleaner = prop.get("clean_command")
            check(command == "Add" + name[:-1] and hasattr(instance, command), f"{where}: command {command}")
            check(cleaner == "RemoveAll" + name and hasattr(instance, cleaner), f"{where}: clean_command {cleaner}")
        else:
            check(command == "Set" + name and hasattr(instance, command), f"{where}: command {command}")
            check_number(proxy, prop, filter_class())
        if prop.get("information_only") != "1":
            check(in_groups.count(name) == 1, f"{where}: in {in_groups.count(name)} property groups")
    check(set(in_groups) <= named, f"{proxy}: groups name {set(in_groups) - named}")

    missing = own_setters(filter_class) - named - connections - NOT_IN_XML.get(proxy, set())
    check(not missing, f"{proxy}: the XML lacks {sorted(missing)}")


for path in sorted(glob.glob(os.path.join(SOURCE, "ParaViewPlugin", "*.xml"))):
    check_proxy(path)
for failure in failures:
    print("FAILED:", failure)
sys.exit(1 if failures else 0)
