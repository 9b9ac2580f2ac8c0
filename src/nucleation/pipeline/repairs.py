"""What Snakemake and its plugins leave out, put right from within the Snakefile.

Each repair stands for one gap in the pinned versions, and does nothing where it has been closed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import snakemake.api  # first: its parts import each other
import snakemake.dag
import snakemake.jobs
from snakemake.exceptions import MissingRuleException
from snakemake.io import AnnotatedString, _IOFile, is_flagged
from snakemake.logging import logger

from .targets import unknown_target

SUBMISSION = "\n    sbatch call:"
"""Where, in a message of the plugin for Slurm, a command of some kB follows the reason."""


def show_why_groups_fail() -> None:
    """Log why a group of jobs could not be submitted, such as a partition that does not exist.

    The executor says so to the group, as to a single job; a group drops what it was told and
    prints ``Error in group simulations`` alone.
    """
    original = snakemake.jobs.GroupJob.log_error
    if getattr(original, "says_why", False):
        return  # a Snakefile may be read twice in one process

    def log_error(self: Any, msg: str | None = None, *arguments: Any, **named: Any) -> None:
        if msg:
            reason = str(msg).partition(SUBMISSION)[0].strip()
            logger.error(f"Group {getattr(self, 'groupid', '')}: {reason}")
        original(self, msg, *arguments, **named)

    log_error.says_why = True  # type: ignore[attr-defined]
    snakemake.jobs.GroupJob.log_error = log_error


def suggest_targets(rules: Callable[[], Iterable[Any]]) -> None:
    """Have Snakemake say of a target that it doesn't know which ones it does.

    Parameters
    ----------
    rules : gives the rules of the workflow once all are read.
    """

    class UnknownTarget(MissingRuleException):
        def __init__(self, file: Any, *arguments: Any, **named: Any) -> None:
            super().__init__(file, *arguments, **named)
            self._asked = str(file)

        def __str__(self) -> str:  # not before: of files that need no rule it is raised and caught
            return unknown_target(self._asked, rules())

    snakemake.dag.MissingRuleException = UnknownTarget


def caption_where_made(rules: Iterable[Any]) -> None:
    """Have Snakemake's report show a file with the job that made it.

    A target that lists a file for the report is taken for its maker as well. The caption of one
    job was then filled in from the parameters of another, which has none.
    """
    for rule in rules:
        for file in rule.input:
            if isinstance(file, _IOFile) and is_flagged(file, "report"):
                # in place, as inputs with a name are listed under it too; flags are shared
                others = {name: value for name, value in file.flags.items() if name != "report"}
                file._file = AnnotatedString(str(file))
                file._file.flags = others
