# SPDX-License-Identifier: BSD-3-Clause
"""Runs a filter as a Python function runs: errors are exceptions, warnings are warnings, Ctrl-C stops it."""
import contextlib
import re
import signal
import threading
import warnings

from ._grids import names_of_leaves

# "ERROR: In FILE, line N\nCLASS (0x...): TEXT\n\n", as vtkErrorMacro writes it
_HEAD = re.compile(r"\A\s*\w+: In .*?, line \d+\s+\w+ \(\w+\): ", re.DOTALL)


class MeshOptimizeError(RuntimeError):
    """A mesh, an array or a file cannot be used; the text says what is wrong and where."""


def text_of(message):
    """A message of VTK without where in its sources it came from."""
    return _HEAD.sub("", message).strip()


def collect(algorithm, *events):
    """A list for each event, into which the algorithm's messages go instead of to the standard error."""
    collected = []
    for event in events:
        texts = []

        def observe(caller, name, message, texts=texts):
            texts.append(text_of(message))

        observe.CallDataType = "string0"
        algorithm.AddObserver(event, observe)
        algorithm.GetExecutive().AddObserver(event, observe)
        collected.append(texts)
    return collected


@contextlib.contextmanager
def _on_ctrl_c(handler):
    """Within, Ctrl-C calls the handler. The handler of before comes back, also after an exception.

    Python lets only the main thread do so. What ends a process here is VTK: it exits when an observer, which is where
    Python notices Ctrl-C during a run, raises KeyboardInterrupt.
    """
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or before in (None, signal.SIG_IGN):
        yield
        return
    signal.signal(signal.SIGINT, handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _with_names(text, names):
    """A message of a filter on composite data calls a block by its number: its name is added."""
    return re.sub(r"\ABlock (\d+)(?=:)",
                  lambda found: found[0] + (f" ({names[int(found[1])]})" if int(found[1]) in names else ""), text)


def run(algorithm, progress=None, warn=True):
    """Updates the filter. True if Ctrl-C stopped it.

    `progress(fraction, text)` is called about ten times a second at most; what it raises stops the filter and is
    raised again. Raises MeshOptimizeError with the filter's own text.
    """
    errors, texts = collect(algorithm, "ErrorEvent", "WarningEvent")
    interrupted, raised = [], []

    def on_ctrl_c(number, frame):
        interrupted.append(True)
        algorithm.SetAbortExecute(1)

    # Always observed: Python runs the handler of Ctrl-C only when the filter comes back to Python.
    def on_progress(caller, event):
        if progress and not raised:
            try:
                progress(caller.GetProgress(), caller.GetProgressText() or "")
            except Exception as error:  # VTK would print it and go on
                raised.append(error)
                caller.SetAbortExecute(1)

    algorithm.AddObserver("ProgressEvent", on_progress)
    with _on_ctrl_c(on_ctrl_c):
        algorithm.Update()
    names = names_of_leaves(algorithm.GetInputDataObject(0, 0)) if errors or texts else {}
    for text in texts if warn else ():
        warnings.warn(_with_names(text, names), stacklevel=3)  # the caller of optimize() or quality()
    if raised:
        raise raised[0]
    if errors:
        raise MeshOptimizeError("\n".join(_with_names(text, names) for text in errors))
    return bool(interrupted)
