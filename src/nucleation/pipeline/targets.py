"""The target that a configuration stands for."""

from __future__ import annotations

from ..configuration.load import Configuration

PAPER = "paper"
STUDIES = "studies"


def default_target(settings: Configuration) -> str:
    """The target that stands for all that a configuration can make.

    It is ``paper`` if a study has that role, and ``studies``, the tables and figures of each study,
    if all are the user's own.
    """
    return PAPER if settings.studies_for("paper") else STUDIES
