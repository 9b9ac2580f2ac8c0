"""The target that a configuration stands for."""

from __future__ import annotations

from ..configuration.load import Configuration
from ..model.quantities import ParameterError

PAPER = "paper"
STUDIES = "studies"


def default_target(settings: Configuration) -> str:
    """The target that stands for all that a configuration can make.

    It is ``paper`` if the configuration has the runs that the paper's figures show, and
    ``studies``, the tables and figures of each study, if it is one of the user's own.
    """
    initial = settings.base.loading.initial_state
    shown = (settings.figures.inset_height, settings.figures.space_time_height)
    try:
        for height in shown:
            settings.find(study="paper", law="aging", height=height, phi0=initial)
    except ParameterError:
        return STUDIES
    return PAPER
