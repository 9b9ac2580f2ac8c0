"""How far a command is, on the standard error, if it takes longer than two seconds."""

import sys
import time

import click

SILENT = 2.0  # s, of what is done quickly nothing is shown
PAUSE = 10.0  # s between the lines of a log
PAUSE_ON_TERMINAL = 0.5


class Progress:
    """Shows the number of things that are done; a terminal has one line that changes, a log lines.

    Parameters
    ----------
    things : str
        What is counted, in the plural, such as ``draws``.
    """

    def __init__(self, things: str) -> None:
        self._things = things
        self._terminal = sys.stderr.isatty()
        self._began = time.monotonic()
        self._next = self._began + SILENT
        self._shown = False

    def __call__(self, done: int, total: int) -> None:
        """Take note of how many things are done, of how many."""
        now = time.monotonic()
        if done >= total:
            self._clear()
        elif now >= self._next:
            self._next = now + (PAUSE_ON_TERMINAL if self._terminal else PAUSE)
            left = (now - self._began) * (total - done) / max(done, 1)
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
