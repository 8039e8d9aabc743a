# SPDX-License-Identifier: BSD-3-Clause
"""The properties of a filter as keywords, read off its class: names, kinds, ranges and defaults are nowhere repeated.

A class that wraps a VTK filter has for a property `Name`: SetName, GetName, GetNameMinValue and GetNameMaxValue where
values are clamped, NameOn where it is a switch, SetNameToChoice for each choice.
"""
import dataclasses
import difflib
import functools
import operator
import re


def snake_case(name):
    """TargetQuality -> target_quality, BSpline -> bspline: as VTK 9.4 names properties in Python."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def _plain(text):
    """Worst First, worst-first and worst_first are the same choice."""
    return re.sub(r"[^a-z0-9]", "", text.lower())


def nearest(word, words):
    """The words that `word` may have been meant to be, as the end of a message."""
    found = difflib.get_close_matches(word, words, n=1, cutoff=0.5)
    return f"; did you mean {found[0]!r}?" if found else ""


@dataclasses.dataclass(frozen=True)
class Property:
    """One property: `kind` is choice, switch, whole, real, array or data."""

    name: str
    kind: str
    default: object = None
    low: object = None
    high: object = None
    choices: dict = dataclasses.field(default_factory=dict)  # keyword -> number
    description: str = ""  # the first sentence of the setter's documentation

    @property
    def keyword(self):
        return snake_case(self.name)

    @property
    def values(self):
        """What it may be, in words."""
        if self.kind == "choice":
            return ", ".join(repr(choice) for choice in self.choices)
        if self.kind in ("whole", "real"):
            unlimited = self.high is None or self.high >= (1e299 if self.kind == "real" else 2**31 - 1)
            number = "a whole number" if self.kind == "whole" else "a number"
            return f"{number} from {self.low:g}" + ("" if unlimited else f" to {self.high:g}")
        return {"switch": "True or False", "array": "the name of an array, or None", "data": "a vtkPolyData"}[self.kind]

    @property
    def shown_default(self):
        return next((choice for choice, number in self.choices.items() if number == self.default), self.default)

    def set(self, algorithm, value):
        """Sets it, or raises ValueError with what is allowed."""
        try:
            self._set(algorithm, value)
        except (TypeError, ValueError, OverflowError):
            hint = nearest(value, self.choices) if isinstance(value, str) else ""
            raise ValueError(f"{self.keyword} is {value!r}; it must be {self.values}{hint}") from None

    def _set(self, algorithm, value):
        setter = getattr(algorithm, f"Set{self.name}Data" if self.kind == "data" else f"Set{self.name}")
        if self.kind == "choice":
            if isinstance(value, str):
                value = {_plain(choice): number for choice, number in self.choices.items()}.get(_plain(value))
            if value not in self.choices.values():
                raise ValueError
            setter(operator.index(value))
        elif self.kind == "switch":
            if value not in (0, 1):
                raise ValueError
            setter(bool(value))
        elif self.kind in ("whole", "real"):
            number = operator.index(value) if self.kind == "whole" else float(value)
            setter(number)
            if getattr(algorithm, "Get" + self.name)() != number:  # clamped
                raise ValueError
        else:
            setter(value)


def _description(cls, setter):
    text = (getattr(cls, setter).__doc__ or "").partition("\n\n")[2]  # after the signature
    return " ".join(re.split(r"(?<=\.)\s", text, maxsplit=1)[0].split())


def _property_of(cls, algorithm, setter):
    """The property that a setter sets, or None: of those of the class itself, not of all algorithms."""
    name, description = setter[len("Set"):], _description(cls, setter)
    if name.endswith("Array"):
        return Property(name, "array", description="The array by its name.")
    if name.endswith("Data"):
        return Property(name[:-len("Data")], "data", description=description)
    getter = getattr(algorithm, "Get" + name, None)
    default = getter() if getter else None
    if not isinstance(default, (bool, int, float)):
        return None
    choices = {snake_case(key[len(setter + "To"):]): int(getattr(cls, key[len(setter + "To"):]))
               for key in vars(cls) if key.startswith(setter + "To")}
    if choices:
        return Property(name, "choice", int(default), choices=choices, description=description)
    if name + "On" in vars(cls):
        return Property(name, "switch", bool(default), description=description)
    low, high = (getattr(algorithm, f"Get{name}{end}Value", lambda: None)() for end in ("Min", "Max"))
    kind = "real" if isinstance(default, float) else "whole"
    return Property(name, kind, default, low, high, description=description)


@functools.lru_cache(maxsize=None)
def properties(cls):
    """The properties of a filter's class: keyword -> Property."""
    algorithm = cls()
    found = [_property_of(cls, algorithm, key) for key in vars(cls) if key.startswith("Set")]
    return {prop.keyword: prop for prop in found if prop}


def make(cls, options):
    """A filter of this class with these options. TypeError: no such keyword; ValueError: no such value."""
    algorithm, known = cls(), properties(cls)
    for keyword, value in options.items():
        if keyword not in known:
            raise TypeError(f"there is no option {keyword!r}{nearest(keyword, known)}")
        known[keyword].set(algorithm, value)
    return algorithm
