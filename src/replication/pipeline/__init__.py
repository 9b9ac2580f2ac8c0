"""The workflow: recipes of results, jobs, stores, views of results, and checks.

Messages are one line each, on standard error, which a job redirects to its log; progress, warnings
and errors of a job also appear on the terminal.
"""

import logging
import sys

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
