"""One line for each job in Snakemake's output, in place of five."""

import logging
import time
from collections.abc import Collection
from enum import Enum
from typing import Any

from snakemake_interface_logger_plugins.common import LogEvent

_NEEDLESS = (
    "Select jobs to execute...",
    "Using shell: ",
    "Rules claiming more threads will be scaled down.",
)
"""Beginnings of lines without news."""


class _JobLines(logging.Filter):
    """Prints a job as it starts: the time, how many jobs are done, what it makes, its rule.

    Errors, warnings and the table of jobs stay as they are.
    """

    def __init__(self, quietness: Enum) -> None:
        super().__init__()
        self._quietness = quietness
        self._done = 0
        self._all = 0

    def filter(self, record: logging.LogRecord) -> bool:
        """Replace the text of a record, or leave the record out."""
        event = getattr(record, "event", None)
        if event == LogEvent.RUN_INFO:
            self._all = vars(record).get("stats", {}).get("total", 0)
        if event == LogEvent.JOB_FINISHED:
            self._done += 1
        if event == LogEvent.JOB_INFO:
            self._shorten(record)
        if event == LogEvent.PROGRESS:
            return bool(vars(record)["done"] == vars(record)["total"])
        if event in (LogEvent.JOB_STARTED, LogEvent.JOB_FINISHED):
            return False
        return not str(record.msg).startswith(_NEEDLESS)

    def _shorten(self, record: logging.LogRecord) -> None:
        facts = vars(record)
        rule = facts["rule_name"]
        message = facts["rule_msg"]
        job = f"{message} ({rule})" if message else rule
        record.msg = f"{time.strftime('%H:%M:%S')} [{self._done}/{self._all}] {job}"
        # Snakemake's own form of such a record has several lines
        del facts["event"]
        facts["quietness"] = self._quietness


def shorten(logger: logging.Logger, quiet: Collection[Enum] | None) -> None:
    """Print one line for each job, unless the reasons of jobs are asked for.

    Parameters
    ----------
    logger : logging.Logger
        Snakemake's.
    quiet : collection of Enum, optional
        Kinds of lines that Snakemake does not print; None without a profile.
    """
    is_short = any(isinstance(one, _JobLines) for one in logger.filters)
    reasons = [one for one in quiet or () if one.name == "REASON"]
    if reasons and not is_short:
        kinds: Any = type(reasons[0])
        logger.addFilter(_JobLines(kinds.RULES))
