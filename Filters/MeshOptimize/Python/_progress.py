# SPDX-License-Identifier: BSD-3-Clause
"""Progress bars: tqdm's or rich's where one is installed, else a plain line."""
import contextlib
import sys


def _tqdm_bar():
    from tqdm.auto import tqdm

    bar = tqdm(total=100, bar_format="{l_bar}{bar}| {elapsed}{postfix}", leave=False)

    def show(fraction, text):
        bar.update(round(100 * fraction) - bar.n)
        bar.set_postfix_str(text)

    return show, bar.close


def _rich_bar():
    from rich.progress import Progress

    bar = Progress(transient=True)
    task = bar.add_task("", total=1.0)
    bar.start()
    return lambda fraction, text: bar.update(task, completed=fraction, description=text), bar.stop


def plain_bar(stream=None):
    """A line that is written over on a terminal; a line for each tenth elsewhere, such as in a log."""
    stream = stream or sys.stderr
    terminal = getattr(stream, "isatty", lambda: False)()  # ParaView's streams do not say
    shown = [-1]

    def show(fraction, text):
        step = int(100 * fraction) if terminal else int(10 * fraction)
        if terminal:
            print(f"\r{step:3d} % [{'#' * (step // 4):25}] {text:50}", end="", file=stream, flush=True)
        elif step > shown[0]:
            print(f"{10 * step:3d} % {text}", file=stream, flush=True)
        shown[0] = step

    def close():
        if terminal:
            print("\r" + 90 * " " + "\r", end="", file=stream, flush=True)

    return show, close


@contextlib.contextmanager
def bar():
    """The callback progress(fraction, text) of a bar that is taken away at the end."""
    for make in (_tqdm_bar, _rich_bar, plain_bar):
        with contextlib.suppress(ImportError):
            show, close = make()
            break
    try:
        yield show
    finally:
        close()
