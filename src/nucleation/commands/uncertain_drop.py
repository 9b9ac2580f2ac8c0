"""``nucleation drop`` for faults with uncertain parameters."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from ..answers.draws import Draws, draw
from ..configuration.given_fault import IN_STUDIES
from ..configuration.samples import read_samples
from ..configuration.single_run import merged, merged_parameters, single_run, without_half_spaces
from ..configuration.study_names import study_parameters
from ..model.own_fault import follows_from
from ..model.parameters import Parameters
from ..model.quantities import ParameterError
from ..theory.arrays import critical_length
from ..theory.of_runs import fault_of_run
from . import DONE, STABLE
from .progress import Progress
from .system_text import system_of_run
from .text import table, to_json, wrapped
from .uncertainty import (
    QUANTILE_COLUMNS,
    QUANTILE_HEAD,
    by_quantile,
    ranges_among,
    row_of_quantiles,
)

if TYPE_CHECKING:
    import xarray as xr


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


def print_drop_quantiles(
    base: Parameters | None,
    given: Mapping[str, Any],
    uncertain: Mapping[str, Any],
    usual: Mapping[str, Any],
    paper: bool,
    draws: int,
    as_json: bool,
) -> int:
    """Print the quantiles of L_c, L_s and the length at the drop.

    Parameters
    ----------
    base : Parameters or None
        The run or dataset from which parameters are taken.
    given : mapping
        The given values by their names in studies, in SI units.
    uncertain : mapping
        The ranges and samples among them.
    usual : mapping
        Defaults of the command, by their names in studies.
    paper : bool
        Whether parameters that are not given are the paper's.
    draws : int
        Number of draws.
    as_json : bool
        Whether to print JSON.

    Returns
    -------
    int
        The exit code.
    """
    from ..patch.drop_quantiles import drop_quantiles  # imported here, since SciPy takes a while

    fixed = {name: value for name, value in given.items() if name not in uncertain}
    drawn = draw_in_studies(uncertain, draws)
    cases = cases_of(base, usual, fixed, drawn, paper)
    invalid = drawn.total - len(cases)
    found = drop_quantiles(cases, progress=Progress("draws"))

    middle = {name: float(np.median(value)) for name, value in uncertain.items()}
    own = completed(fixed | middle, base is not None or paper)
    defaults = usual if base is None else {}
    fixed, blocks = without_half_spaces(base, {**defaults, **own})
    system = system_of_run(merged_parameters(base, fixed), base, own)
    if blocks:
        system.append(f"{blocks.in_words()} Each draw has its own.")
    if as_json:
        click.echo(to_json(_described(system, found, uncertain, invalid)))
    else:
        click.echo("\n".join(_lines(system, found, uncertain, invalid)))
    return DONE if found["share"][0] > 0.0 else STABLE


def draw_in_studies(uncertain: Mapping[str, Any], draws: int) -> Draws:
    """Draws of uncertain parameters.

    Parameters
    ----------
    uncertain : mapping
        Ranges and samples by their names in studies, in SI units.
    draws : int
        Number of draws.

    Returns
    -------
    Draws
        By names in studies.

    Raises
    ------
    ParameterError
        If no draw is valid.
    """
    known = {name: entry for name, entry in study_parameters().items() if not entry.worded}
    return draw(uncertain, draws, known=known)


def cases_of(
    base: Parameters | None,
    usual: Mapping[str, Any],
    fixed: Mapping[str, Any],
    drawn: Draws,
    paper: bool,
) -> list[Parameters]:
    """The runs of all draws that are valid.

    Parameters
    ----------
    base : Parameters or None
        The run or dataset from which parameters are taken.
    usual : mapping
        Defaults of the command, by their names in studies.
    fixed : mapping
        The given certain values, by their names in studies.
    drawn : Draws
        The draws of the uncertain values.
    paper : bool
        Whether parameters that are not given are the paper's.

    Returns
    -------
    list of Parameters

    Raises
    ------
    ParameterError
        If no draw is a valid fault.
    """
    complete = base is not None or paper
    cases = []
    refusals = []
    for i in range(drawn.size):
        given = {**fixed, **drawn.at(i)}
        try:
            cases.append(case_of(base, usual, given, complete))
        except ParameterError as refusal:
            refusals.append(refusal)
    if not cases:
        raise refusals[0]
    return cases


def completed(values: dict[str, Any], complete: bool) -> dict[str, Any]:
    """Values together with those that follow from them.

    Parameters
    ----------
    values : dict
        The given values by their names in studies, in SI units.
    complete : bool
        Whether all other values are known, from a base or the paper, so that none follows.

    Returns
    -------
    dict
    """
    return values if complete else values | follows_from(values)


def case_of(
    base: Parameters | None,
    usual: Mapping[str, Any],
    given: Mapping[str, Any],
    complete: bool,
) -> Parameters:
    """The run of one draw, with a block of the length that follows from the theory.

    Parameters
    ----------
    base : Parameters or None
        The run or dataset from which parameters are taken.
    usual : mapping
        Defaults of the command, by their names in studies.
    given : mapping
        The values of the draw, by their names in studies, in SI units.
    complete : bool
        Whether all other values are known, as for :func:`completed`.

    Returns
    -------
    Parameters

    Raises
    ------
    ParameterError
        If the draw is no valid fault.
    """
    plain = {}
    for name, value in given.items():
        plain[name] = float(value) if isinstance(value, np.floating) else value
    own = completed(plain, complete)
    defaults = usual if base is None else {}
    fixed, _ = without_half_spaces(base, {**defaults, **own})
    values = merged(base, fixed)
    parameters = merged_parameters(None, values)
    critical = float(critical_length(**fault_of_run(parameters)))
    if math.isnan(critical):
        return parameters  # for a stable fault the theory has no length of the block
    return single_run(values, results="results", limits={"memory": 9e6}).parameters


def _described(
    system: list[str],
    found: xr.Dataset,
    uncertain: Mapping[str, Any],
    invalid: int,
) -> dict[str, Any]:
    """The quantiles for JSON, in SI units."""
    lengths = []
    for key in found["key"].values:
        one = found.sel(key=key)
        lengths.append(
            {
                "key": str(key),
                "title": str(one["title"].values),
                "units": "m",
                "quantiles": by_quantile(one["value"].values.tolist()),
                "errors": by_quantile(one["error"].values.tolist()),
                "share": float(one["share"]),
                "why_not": str(one["why_not"].values),
            }
        )
    draws = found.attrs["draws"] + invalid
    return {
        "system": system,
        "uncertain": list(uncertain),
        **found.attrs,
        "draws": draws,
        "invalid": invalid,
        "lengths": lengths,
    }


def _lines(
    system: list[str],
    found: xr.Dataset,
    uncertain: Mapping[str, Any],
    invalid: int,
) -> list[str]:
    """The quantiles as a table."""
    count = found.attrs
    stable = round(count["draws"] * (1.0 - float(found["share"][0])))
    draws = (
        f"{count['draws'] + invalid} draws of {', '.join(uncertain)}: {invalid} left out, "
        f"{stable} of the others stable, without L_c"
    )
    rows: list[Sequence[str] | str] = [QUANTILE_HEAD]
    for key in found["key"].values:
        one = found.sel(key=key)
        share = float(one["share"])
        title = one["title"].item()
        rows.append(row_of_quantiles(title, one["value"].values, one["error"].values, share))
        if share < 1.0:
            rows.append(f"      in the other draws: {one['why_not'].item()}")
    lines = [*wrapped(*system, "", draws, ""), *table(rows, QUANTILE_COLUMNS)]
    if count["doubtful"]:
        doubtful = f"DO NOT RELY ON {count['doubtful']} of the draws: {count['doubts']}"
        lines += wrapped("", doubtful)
    remark = (
        "stable: no patch nucleates in the range of the search; digits by the number of draws. The "
        "length at the drop varies also with the realisation of the perturbation."
    )
    return [*lines, *wrapped("", remark)]
