"""The article on the replication: a template whose numbers come from the results alone."""

import math
from collections.abc import Iterable
from typing import Any

import jinja2
import xarray as xr

from ..analysis.lengths import over_realisations
from .claim import Verdict
from .table import counts, escaped


def render(
    template: str, claims: list[dict[str, Any]], lengths: Iterable[xr.Dataset],
    beyond: bool = False,
) -> str:  # fmt: skip
    """The article's text.

    Parameters
    ----------
    template : str
        Markdown with Jinja2's expressions. It knows ``claim(id)``, a claim's row; ``ours(id)``, our
        number with range and unit; ``verdicts``, the counts; ``claims``, all rows; ``runs(role)``,
        its rows of lengths, one for each fault; ``by_theory(role)``, the range of their L_s/L_c by
        theory; and the filters ``digits(n)``, ``percent(n)`` and
        ``typeset``, of texts with formulas.
    claims : list of dict
        Rows of :func:`nucleation.claims.table.evaluate`.
    lengths : iterable of Dataset
        Tables of lengths, one for each study.
    beyond : bool
        Whether the figures of L_s, the drop and the map are there, and belong into the text.

    Raises
    ------
    jinja2.UndefinedError
        For a name that the results do not have.
    KeyError
        For an unknown claim.
    """
    environment = jinja2.Environment(
        undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # fmt: skip
    environment.filters |= {"digits": digits, "percent": percent, "typeset": escaped}
    by_id = {row["id"]: row for row in claims}
    records = [
        row
        for table in lengths
        for row in over_realisations(table).to_dataframe().to_dict("records")
    ]

    def runs(role: str) -> list[dict[str, Any]]:
        return [row for row in records if row["role"] == role]

    def by_theory(role: str) -> str:
        ratios = [row["creep_length"] / row["theory_length"] for row in runs(role)]
        return f"{min(ratios):.2f} to {max(ratios):.2f}" if ratios else "not computed"

    def ours(id: str) -> str:
        return rounded(by_id[id])

    return environment.from_string(template).render(
        claim=by_id.__getitem__, ours=ours, verdicts=counts(claims), claims=claims, runs=runs,
        by_theory=by_theory, beyond=beyond, pairs=paired(runs("paper"), runs("converged")),
        verdict=Verdict,
    )  # fmt: skip


def paired(
    paper: list[dict[str, Any]], converged: list[dict[str, Any]]
) -> list[tuple[dict[str, Any], dict[str, Any] | None]]:
    """The rows of one study, each with that of the other study for the same fault, or None."""
    others = {row["fault"]: row for row in converged}
    return [(row, others.get(row["fault"])) for row in paper]


def digits(value: float | None, number: int) -> str:
    """A number to some significant digits, a dash for none."""
    if value is None:
        return "–"
    mantissa, _, power = f"{value:.{number}g}".partition("e")
    factor = "" if mantissa == "1" else rf"{mantissa}\times "
    return f"${factor}10^{{{int(power)}}}$" if power else mantissa


def rounded(row: dict[str, Any]) -> str:
    """Our number of a claim with range and unit, to three digits of the largest of them."""
    if row["ours"] is None:
        return "not computed"
    numbers = [row["ours"], *row["uncertainty"]]
    places = max(0, 2 - math.floor(math.log10(max(map(abs, numbers)) or 1.0)))
    value, low, high = (f"{number:.{places}f}" for number in numbers)
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    return f"{value}{unit}" if low == high else f"{value} ({low} to {high}){unit}"


def percent(value: float | None, places: int = 0) -> str:
    """A part as percent, a dash for none."""
    return "–" if value is None else f"{100.0 * value:.{places}f} %"
