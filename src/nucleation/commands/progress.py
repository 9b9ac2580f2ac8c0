"""Progress of a command, on the standard error, if it takes longer than two seconds."""

import sys
import time

import click

_SILENT = 2.0  # s without a report at the beginning
_PAUSE = 10.0  # s between the lines of a log
_PAUSE_ON_TERMINAL = 0.5


class Progress:
    """Prints the number of finished things: on a terminal in one line that changes, else in lines.

    Parameters
    ----------
    things : str
        Name of the things in the plural, such as ``draws``.
    """

    def __init__(self, things: str) -> None:
        self._things = things
        self._terminal = sys.stderr.isatty()
        self._began = time.monotonic()
        self._next = self._began + _SILENT
        self._shown = False

    def __call__(self, done: int, total: int) -> None:
        """Report the number of finished things and the total number."""
        now = time.monotonic()
        if done >= total:
            self._clear()
        elif now >= self._next:
            self._next = now + (_PAUSE_ON_TERMINAL if self._terminal else _PAUSE)
            passed = now - self._began
            left = passed * (total - done) / max(done, 1)
            self._show(f"{done} of {total} {self._things}, about {left:.0f} s left")

    def _show(self, text: str) -> None:
        self._shown = True
        if self._terminal:
            click.echo(f"\r{text:<70}", err=True, nl=False)
        else:
            click.echo(text, err=True)

    def _clear(self) -> None:
        if self._shown and self._terminal:
            click.echo(f"\r{'':<70}\r", err=True, nl=False)
        self._shown = False
