"""``nucleation drop`` for parameters that are ranges or samples."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click
import numpy as np

from ..answers.draws import Draws, Range, draw
from ..answers.uncertainty import QUANTILES
from ..configuration.samples import read_samples
from ..configuration.study_names import study_parameters
from ..model.own_fault import follows_from
from ..model.parameters import Parameters
from ..model.quantities import ParameterError
from ..theory.arrays import critical_length
from . import DONE, STABLE
from .fault_options import IN_STUDIES, of_parameters, told
from .options import merged, merged_parameters, planned
from .progress import Progress
from .text import to_json, wrapped
from .uncertainty import as_sure


def uncertain_of(given: Mapping[str, Any], samples: Path | None) -> dict[str, Any]:
    """The ranges and samples of a fault, by the names of its parameters in studies.

    Raises
    ------
    ParameterError
        If a parameter is given twice, or the samples have one that a simulation does not have.
    """
    found: dict[str, Any] = {k: v for k, v in given.items() if isinstance(v, Range)}
    if samples is None:
        return found
    for name, values in read_samples(samples).items():
        known = IN_STUDIES.get(name)
        if known is None:
            raise ParameterError(f"{samples}: {name} does not matter to the drop")
        if known in given:
            raise ParameterError(f"{known} is given twice: as an option and in {samples}")
        found[known] = values
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
    """Print the quantiles of L_c, L_s and the length at the drop, and return the exit code."""
    from ..patch.drop_quantiles import drop_quantiles  # with SciPy, which takes a while

    fixed = {name: value for name, value in given.items() if name not in uncertain}
    drawn = draw_in_studies(uncertain, draws)
    cases = cases_of(base, usual, fixed, drawn, paper)
    middle = {name: float(np.median(value)) for name, value in uncertain.items()}
    invalid = drawn.total - len(cases)
    found = drop_quantiles(cases, progress=Progress("draws"))
    own = completed(fixed | middle, base is not None or paper)
    said = told(merged_parameters(base, (usual if base is None else {}) | own), base, own)
    if as_json:
        click.echo(to_json(_described(said, found, uncertain, invalid)))
    else:
        click.echo("\n".join(_lines(said, found, uncertain, invalid)))
    return DONE if found["share"][0] > 0.0 else STABLE


def draw_in_studies(uncertain: Mapping[str, Any], draws: int) -> Draws:
    """Draws of uncertain parameters by their names in studies."""
    declared = study_parameters()
    return draw(uncertain, draws, known={k: x for k, x in declared.items() if not x.worded})


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
        Values of a command that belong to no option, by their names in studies.
    fixed : mapping
        Values that are given and certain, by their names in studies.
    drawn : Draws
        The draws of the others.
    paper : bool
        Whether parameters that are not given are the paper's.

    Raises
    ------
    ParameterError
        If no draw is a valid fault.
    """
    complete = base is not None or paper
    cases, refusals = [], []
    for i in range(drawn.size):
        try:
            cases.append(case_of(base, usual, {**fixed, **drawn.at(i)}, complete))
        except ParameterError as refusal:
            refusals.append(refusal)
    if not cases:
        raise refusals[0]
    return cases


def completed(values: dict[str, Any], complete: bool) -> dict[str, Any]:
    """Values with those that follow from them, unless a base has all."""
    return values if complete else values | follows_from(values)


def case_of(
    base: Parameters | None, usual: Mapping[str, Any], given: dict[str, Any], complete: bool
) -> Parameters:
    """The run of one draw; its block is as long as the theory of its own fault makes it."""
    plain = {k: float(v) if isinstance(v, np.floating) else v for k, v in given.items()}
    own = completed(plain, complete)
    values = merged(base, {**usual, **own} if base is None else own)
    parameters = merged_parameters(None, values)
    if math.isnan(float(critical_length(**of_parameters(parameters)))):
        return parameters  # a block of a stable fault has no length that follows from the theory
    return planned(values, {}, results="results").parameters


def _described(
    said: list[str], found: Any, uncertain: Mapping[str, Any], invalid: int
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
                "quantiles": _by_quantile(one["value"]),
                "errors": _by_quantile(one["error"]),
                "share": float(one["share"]),
                "why_not": str(one["why_not"].values),
            }
        )
    counts = found.attrs | {"draws": found.attrs["draws"] + invalid, "invalid": invalid}
    return {"system": said, "uncertain": list(uncertain), **counts, "lengths": lengths}


def _by_quantile(row: Any) -> dict[str, float]:
    return {f"{q:g}": x for q, x in zip(QUANTILES, row.values.tolist(), strict=True)}


def _lines(said: list[str], found: Any, uncertain: Mapping[str, Any], invalid: int) -> list[str]:
    count = found.attrs
    stable = round(count["draws"] * (1.0 - float(found["share"][0])))
    drawn = f"{count['draws'] + invalid} draws of {', '.join(uncertain)}: {invalid} left out, "
    drawn += f"{stable} of the others stable, without L_c"
    head = "".join(f"{share:>10.0%}" for share in QUANTILES)
    lines = [*wrapped(*said), "", *wrapped(drawn), "", f"{'quantiles (m)':<32}{head}   share"]
    for key in found["key"].values:
        one = found.sel(key=key)
        pairs = zip(one["value"].values, one["error"].values, strict=True)
        row = "".join(f"{as_sure(value, error):>10}" for value, error in pairs)
        lines.append(f"  {one['title'].item():<30}{row}{float(one['share']):>8.1%}")
        if one["share"] < 1.0:
            lines += wrapped(f"      in the other draws: {one['why_not'].item()}")
    if count["doubtful"]:
        doubtful = f"DO NOT RELY ON {count['doubtful']} of the draws: {count['doubts']}"
        lines += ["", *wrapped(doubtful)]
    return [
        *lines,
        "",
        "stable: no patch nucleates, or none that was searched; digits as far as the number of",
        "draws tells. The length at the drop scatters by the realisation of the perturbation too.",
    ]
