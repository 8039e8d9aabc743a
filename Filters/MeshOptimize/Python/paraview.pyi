# SPDX-License-Identifier: BSD-3-Clause
# Types of the views. ParaView makes its classes of proxies when it runs, so a view or a filter is any of them here.
# Testing/Python/TestOneCall.py holds names, parameters and defaults against the module.
from typing import Any

BAD: float
PALE: list[float]
INK: list[float]

_Proxy = Any

def show_worst_elements(source: _Proxy | None = None, number: int = 10) -> tuple[_Proxy, _Proxy, _Proxy]: ...
def show_histogram(source: _Proxy | None = None) -> tuple[_Proxy, _Proxy]: ...
def show_history(optimized: _Proxy | None = None) -> _Proxy: ...
def compare_before_and_after(optimized: _Proxy | None = None) -> _Proxy: ...
