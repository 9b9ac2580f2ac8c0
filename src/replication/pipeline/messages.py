"""Messages of the workflow: one line each, on standard error.

A job redirects its standard error to its log, with the messages and everything that libraries
print. Progress, warnings and errors of a job also appear on the terminal.
"""

import logging
import signal
import sys
from types import FrameType
from typing import Any

LOGGER = logging.getLogger("replication.pipeline")
PROGRESS = (logging.INFO + logging.WARNING) // 2
"""Level of messages that appear on the terminal, too, though nothing is wrong."""


class _StandardError(logging.Handler):
    """Writes to the current standard error, which may have been redirected."""

    def emit(self, record: logging.LogRecord) -> None:
        print(self.format(record), file=sys.stderr, flush=True)


LOGGER.setLevel(logging.INFO)
LOGGER.propagate = False  # Snakemake's options for quiet or coloured output are about its own lines
LOGGER.addHandler(_StandardError())


def end_in_one_line(logger: logging.Logger) -> None:
    """After Ctrl-C, have a line of ours in place of Snakemake's reports on jobs that it stops."""
    before: Any = signal.getsignal(signal.SIGINT)

    def stop(number: int, frame: FrameType | None) -> None:
        signal.signal(number, before)
        LOGGER.error("Stopped by Ctrl-C; the same command continues from here")
        logger.addFilter(lambda record: record.levelno < logging.ERROR)
        before(number, frame)

    signal.signal(signal.SIGINT, stop)
