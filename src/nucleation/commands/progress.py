"""Progress of a command, on the standard error, if it takes longer than two seconds."""

import sys
import time
from collections.abc import Callable

import click

_SILENT = 2.0  # s without a report at the beginning
_PAUSE = 10.0  # s between the lines of a log
_PAUSE_ON_TERMINAL = 0.5


def progress_of(things: str) -> Callable[[int, int], None]:
    """A function that prints how many things are finished.

    Parameters
    ----------
    things : str
        Name of the things in the plural, such as ``draws``.

    Returns
    -------
    callable
        Its arguments are the number of finished things and the total number. On a terminal it
        prints one line that changes, else lines.
    """
    on_terminal = sys.stderr is not None and sys.stderr.isatty()
    began = time.monotonic()
    due = began + _SILENT
    first: tuple[int, float] | None = None  # imports and tables take longer than the first draws
    shown = False

    def report(done: int, total: int) -> None:
        nonlocal due, first, shown
        now = time.monotonic()
        if first is None:
            first = done, now
        if done >= total:
            if shown and on_terminal:
                click.echo(f"\r{'':<70}\r", err=True, nl=False)
            shown = False
        elif now >= due:
            due = now + (_PAUSE_ON_TERMINAL if on_terminal else _PAUSE)
            text = f"{done} of {total} {things}"
            if done > first[0]:
                left = (now - first[1]) * (total - done) / (done - first[0])
                text += f", about {left:.0f} s left"
            click.echo(f"\r{text:<70}" if on_terminal else text, err=True, nl=not on_terminal)
            shown = True

    return report
