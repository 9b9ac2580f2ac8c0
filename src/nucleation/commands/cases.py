"""The runs of ``drop``: with one value of each parameter, or one for each draw."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from replication.configuration.given_fault import IN_STUDIES
from replication.configuration.half_spaces import Blocks, without_half_spaces
from replication.configuration.runs import Run
from replication.configuration.samples import read_samples
from replication.configuration.single_run import merged, merged_parameters, single_run
from replication.configuration.study_names import study_parameters

from ..lengths.draws import Draws, draw
from ..model.friction.constants import CONSTANTS
from ..model.own_fault import follows_from
from ..model.parameters import Parameters, names
from ..model.quantities import ParameterError
from ..theory.arrays import critical_length
from ..theory.of_runs import fault_of_run
from .options import parameter_options, source_options, together
from .system_text import system_of_run
from .uncertainty import ranges_among

USUAL = {"perturbation": "normal_load", "strength": 1e-4}
"""The perturbation by default; the law is verified up to this strength."""

_GROUPS = ("material", "friction", "loading", "perturbation", "second_body")
_WITHOUT_EFFECT = ("second_n_y", "second_grading", "loading", "stress_rate", "seed")
"""Parameters of these groups without effect: the law has no mesh, holds for an edge that is pushed,
and covers all realisations."""


def _counts(name: str) -> bool:
    """Whether a parameter, by its name in studies, has an effect on the drop."""
    if name in CONSTANTS or name == "height":
        return True
    return names().full(name).startswith(_GROUPS) and name not in _WITHOUT_EFFECT


COUNTING = tuple(filter(_counts, study_parameters()))
"""The parameters with an effect on the drop, by their names in studies."""

case_options = together(parameter_options(COUNTING, USUAL, ranges=True), source_options)
"""Options for the runs of a command and for the source of other parameters."""


def uncertain_of(given: Mapping[str, Any], samples: Path | None) -> dict[str, Any]:
    """The ranges and samples of a fault.

    Parameters
    ----------
    given : mapping
        The given values by their names in studies.
    samples : Path or None
        A file of samples.

    Returns
    -------
    dict
        In SI units, by their names in studies.

    Raises
    ------
    ParameterError
        If a parameter is given twice, or the samples have one that a simulation does not have.
    """
    found = ranges_among(given)
    if samples is None:
        return found
    for name, values in read_samples(samples).items():
        if name not in IN_STUDIES:
            raise ParameterError(f"{samples}: {name} does not matter to the drop")
        if name in given:
            raise ParameterError(f"{name} is given twice: as an option and in {samples}")
        found[name] = values
    return found


def drawn_from(uncertain: Mapping[str, Any], draws: int) -> Draws:
    """Draw from ranges and samples.

    Parameters
    ----------
    uncertain : mapping
        Ranges and samples by their names in studies.
    draws : int
        Number of draws.

    Returns
    -------
    Draws
    """
    known = {name: entry for name, entry in study_parameters().items() if not entry.worded}
    return draw(uncertain, draws, known=known)


def medians_of(uncertain: Mapping[str, Any]) -> dict[str, float]:
    """The medians of ranges and samples, by name."""
    return {name: float(np.median(value)) for name, value in uncertain.items()}


def case_of(
    base: Parameters | None,
    given: Mapping[str, Any],
    paper: bool,
) -> tuple[dict[str, Any], Blocks | None]:
    """One run, with blocks in place of half-spaces.

    Parameters
    ----------
    base : Parameters or None
        The run or dataset from which parameters are taken.
    given : mapping
        The given values by their names in studies, in SI units.
    paper : bool
        Whether parameters that are not given are the paper's.

    Returns
    -------
    values : dict
        All values by their names in studies; without a base the length of the block follows from
        the theory.
    blocks : Blocks or None
        None without half-spaces.

    Raises
    ------
    ParameterError
        If a value is wrong.
    """
    usual = USUAL if base is None else {}
    fixed, blocks = without_half_spaces(base, {**usual, **_completed(base, given, paper)})
    return merged(base, fixed), blocks


def _completed(
    base: Parameters | None,
    given: Mapping[str, Any],
    paper: bool,
) -> dict[str, Any]:
    """The given values and those that follow from them, if neither base nor paper has these."""
    return {**given} if base or paper else {**given, **follows_from(given)}


def system_of_case(
    case: tuple[dict[str, Any], Blocks | None],
    base: Parameters | None,
    given: Mapping[str, Any],
    paper: bool,
    remark: str = "",
) -> list[str]:
    """A run in words.

    Parameters
    ----------
    case : tuple
        Of :func:`case_of`.
    base, given, paper
        As for :func:`case_of`.
    remark : str
        Addition to the sentence about blocks in place of half-spaces.

    Returns
    -------
    list of str
    """
    values, blocks = case
    own = _completed(base, given, paper)
    system = system_of_run(merged_parameters(None, values), base, own)
    if blocks:
        system.append(blocks.in_words() + remark)
    return system


def run_of(values: dict[str, Any]) -> Run:
    """The run of values of :func:`case_of`; neither results nor a mesh are made."""
    return single_run(values, results="results", limits={"memory": 9e6})


def cases_of(
    base: Parameters | None,
    fixed: Mapping[str, Any],
    drawn: Draws | None,
    paper: bool,
) -> list[Parameters]:
    """The runs of all draws that are valid.

    Parameters
    ----------
    base, paper
        As for :func:`case_of`.
    fixed : mapping
        The given certain values, by their names in studies.
    drawn : Draws or None
        The draws of the uncertain values, if there are any.

    Returns
    -------
    list of Parameters

    Raises
    ------
    ParameterError
        If no draw is a valid fault.
    """
    draws = [drawn.at(i) for i in range(drawn.size)] if drawn else [{}]
    cases = []
    refusals = []
    for one in draws:
        plain = {}
        for name, value in {**fixed, **one}.items():
            plain[name] = float(value) if isinstance(value, np.floating) else value
        try:
            cases.append(_parameters_of(base, plain, paper))
        except ParameterError as refusal:
            refusals.append(refusal)
    if not cases:
        raise refusals[0]
    return cases


def _parameters_of(base: Parameters | None, given: dict[str, Any], paper: bool) -> Parameters:
    """A run; for a stable fault the theory has no length of the block, and it has the default."""
    values, _ = case_of(base, given, paper)
    parameters = merged_parameters(None, values)
    if math.isnan(float(critical_length(**fault_of_run(parameters)))):
        return parameters
    return run_of(values).parameters
