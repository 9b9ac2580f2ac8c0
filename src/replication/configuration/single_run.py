"""One run outside a configuration: of a command line, or of a fault of the library."""

import dataclasses
from collections.abc import Mapping
from typing import Any

from nucleation.model.friction.constants import CONSTANTS, with_constants
from nucleation.model.parameters import Parameters, names
from nucleation.model.quantities import ParameterError

from .load import configure
from .runs import Run

STUDY = "command"
"""Name of the study with one run."""

_IN_COMMANDS = {
    "the configuration has one problem:\n  - ": "",
    "the configuration has": "the parameters have",
    f"studies.{STUDY}.runs[0]: ": "",
    f"studies.{STUDY}.runs[0].": "",
    f"studies.{STUDY}.defaults: ": "",
    f"studies.{STUDY}.defaults.": "",
    "limits.memory": "--memory",
    "results = ": "OUTPUT's directory = ",
}
"""Places in a configuration, and their names in messages of commands."""


def flat(parameters: Parameters) -> dict[str, Any]:
    """Parameters by their names in studies, without those that are None."""
    known = names()
    found = {}
    for full, value in parameters.named().items():
        if value is not None:
            found[known.short(full)] = value
    return found


def merged(base: Parameters | None, given: dict[str, Any]) -> dict[str, Any]:
    """All values of a run by their names in studies.

    Parameters
    ----------
    base : Parameters or None
        The parameters of a run or a dataset; the defaults if None. Without a base, the block's
        length and the end time are omitted unless they are given: they follow from the theory.
    given : dict
        Values that replace those of the base, in SI units.

    Returns
    -------
    dict
        In SI units.
    """
    values = flat(merged_parameters(base, given))
    if base is None:
        for name in {"block_length", "end_time", "time_after_event"} - given.keys():
            del values[name]
    return values


def merged_parameters(base: Parameters | None, given: Mapping[str, Any]) -> Parameters:
    """The parameters of a run.

    Parameters
    ----------
    base : Parameters or None
        The parameters of a run or a dataset; the defaults if None.
    given : mapping
        Values that replace those of the base, by their names in studies, in SI units; constants of
        friction set the parameters of the friction law.

    Returns
    -------
    Parameters
    """
    plain = {name: value for name, value in given.items() if name not in CONSTANTS}
    parameters = (base or Parameters()).replaced(plain)
    velocity = parameters.loading.velocity
    friction = with_constants(parameters.friction, velocity, given)
    return dataclasses.replace(parameters, friction=friction)


def single_run(
    values: Mapping[str, Any],
    study: Mapping[str, Any] = {},
    **config: Any,
) -> Run:
    """One run outside a configuration, checked as a run of one.

    Parameters
    ----------
    values : mapping
        Values by their names in studies, in SI units; those that are left out have their defaults.
    study : mapping
        Settings of the study of the run.
    **config
        Other sections of the configuration.

    Returns
    -------
    Run

    Raises
    ------
    ParameterError
        With all problems of the run.
    """
    defaults = dict(values)
    runs = [{"height": defaults.pop("height")}]
    own_study = {**study, "defaults": defaults, "runs": runs}
    try:
        settings = configure({"studies": {STUDY: own_study}, **config})
    except ParameterError as error:
        text = str(error)
        for place, own in _IN_COMMANDS.items():
            text = text.replace(place, own)
        raise ParameterError(text) from None
    return settings.runs[0]
