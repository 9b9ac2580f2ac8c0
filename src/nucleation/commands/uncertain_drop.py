"""``nucleation drop`` for faults with uncertain parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..model.parameters import Parameters
from . import DONE, STABLE
from .cases import case_of, cases_of, drawn_from, medians_of, system_of_case
from .progress import progress_of
from .text import Row, show, table, wrapped
from .uncertainty import QUANTILE_COLUMNS, QUANTILE_HEAD, by_quantile, row_of_quantiles, rows_of

if TYPE_CHECKING:
    import xarray as xr


def print_drop_quantiles(
    base: Parameters | None,
    given: Mapping[str, Any],
    uncertain: Mapping[str, Any],
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
    from ..drop.drop_quantiles import drop_quantiles

    fixed = {name: value for name, value in given.items() if name not in uncertain}
    drawn = drawn_from(uncertain, draws)
    cases = cases_of(base, fixed, drawn, paper)
    invalid = drawn.total - len(cases)
    found = drop_quantiles(cases, progress=progress_of("draws"))
    middle = fixed | medians_of(uncertain)
    case = case_of(base, middle, paper)
    system = system_of_case(case, base, middle, paper, " Each draw has its own.")
    show(
        as_json,
        _described(system, found, uncertain, invalid),
        _lines(system, found, uncertain, invalid),
    )
    return DONE if found["share"][0] > 0.0 else STABLE


def _described(
    system: list[str],
    found: xr.Dataset,
    uncertain: Mapping[str, Any],
    invalid: int,
) -> dict[str, Any]:
    """The quantiles for JSON, in SI units."""
    lengths = []
    reasons = found["why_not"].values.tolist()
    for (key, title, values, errors, share), reason in zip(rows_of(found), reasons, strict=True):
        lengths.append(
            {
                "key": key,
                "title": title,
                "units": "m",
                "quantiles": by_quantile(values),
                "errors": by_quantile(errors),
                "share": share,
                "why_not": reason,
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
    rows: list[Row] = [QUANTILE_HEAD]
    reasons = found["why_not"].values.tolist()
    for row, reason in zip(rows_of(found), reasons, strict=True):
        rows.append(row_of_quantiles(row))
        if row[-1] < 1.0:
            rows.append(f"      in the other draws: {reason}")
    lines = [*wrapped(*system, "", draws, ""), *table(rows, QUANTILE_COLUMNS)]
    if count["doubtful"]:
        doubtful = f"DO NOT RELY ON {count['doubtful']} of the draws: {count['doubts']}"
        lines += wrapped("", doubtful)
    remark = (
        "stable: no patch nucleates in the range of the search; digits by the number of draws. The "
        "length at the drop varies also with the realisation of the perturbation."
    )
    return [*lines, *wrapped("", remark)]
