"""Messages of the workflow: one line each, on standard error.

A job redirects its standard error to its log, with the messages and everything that libraries
print. Warnings and errors of a job also appear on the terminal.
"""

import contextlib
import logging
import sys
from collections.abc import Iterator
from typing import TextIO

LOGGER = logging.getLogger("replication.pipeline")


class _StandardError(logging.Handler):
    """Writes to the current standard error, which may have been redirected."""

    def emit(self, record: logging.LogRecord) -> None:
        print(self.format(record), file=sys.stderr, flush=True)


LOGGER.setLevel(logging.INFO)
LOGGER.propagate = False  # Snakemake's options for quiet or coloured output are about its own lines
LOGGER.addHandler(_StandardError())


@contextlib.contextmanager
def warnings_on(terminal: TextIO) -> Iterator[None]:
    """Within this context warnings and errors are written to `terminal`, too."""
    handler = logging.StreamHandler(terminal)
    handler.setLevel(logging.WARNING)
    LOGGER.addHandler(handler)
    try:
        yield
    finally:
        LOGGER.removeHandler(handler)
