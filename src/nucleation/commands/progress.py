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
    on_terminal = sys.stderr.isatty()
    began = time.monotonic()
    due = began + _SILENT
    shown = False

    def report(done: int, total: int) -> None:
        nonlocal due, shown
        now = time.monotonic()
        if done >= total:
            if shown and on_terminal:
                click.echo(f"\r{'':<70}\r", err=True, nl=False)
            shown = False
        elif now >= due:
            due = now + (_PAUSE_ON_TERMINAL if on_terminal else _PAUSE)
            left = (now - began) * (total - done) / max(done, 1)
            text = f"{done} of {total} {things}, about {left:.0f} s left"
            click.echo(f"\r{text:<70}" if on_terminal else text, err=True, nl=not on_terminal)
            shown = True

    return report
