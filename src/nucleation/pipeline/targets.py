"""What a user may ask the workflow for: the default, and what a name it lacks may have meant."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import Any

from ..configuration.load import Configuration

PAPER = "paper"
STUDIES = "studies"


def default_target(settings: Configuration) -> str:
    """The target that stands for all that a configuration can make.

    It is ``paper`` if a study has that role, and ``studies``, the tables and figures of each study,
    if all are the user's own.
    """
    return PAPER if settings.studies_for("paper") else STUDIES


def unknown_target(asked: str, rules: Iterable[Any]) -> str:
    """What to say of a target that no rule makes.

    Parameters
    ----------
    asked : name of a rule or path of a file, as on the command line.
    rules : Snakemake's.
    """
    concrete = [rule for rule in rules if not rule.has_wildcards()]
    known = [name for rule in concrete for name in (rule.name, *map(str, rule.output))]
    close = difflib.get_close_matches(asked, known, n=3)
    if close:
        return f"no target {asked}: did you mean {' or '.join(close)}?"
    return f"no target {asked}: docs/workflow.md and `snakemake --list-target-rules` name them"
