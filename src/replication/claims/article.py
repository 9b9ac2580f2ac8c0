"""The article on the replication: a template whose numbers come from the results alone."""

import json
from collections.abc import Iterable
from pathlib import Path

import jinja2
import xarray as xr

from ..tables.lengths import over_realisations
from ..tables.rows import rows_of
from .evidence import Row
from .expected import Verdict
from .phrases import caution, mesh, span
from .table import counts, escaped, number_text


def write_article(
    template: Path,
    claims: Path,
    lengths: Iterable[xr.Dataset],
    beyond: bool = False,
) -> dict[str, str]:
    """The step ``article``: its text from the template, the claims as JSON and the lengths."""
    rows = json.loads(claims.read_text("utf-8"))
    return {
        ".md": render(
            template.read_text("utf-8"),
            rows,
            lengths,
            beyond,
        )
    }


def render(
    template: str,
    claims: list[Row],
    lengths: Iterable[xr.Dataset],
    beyond: bool = False,
) -> str:
    """The article's text; `beyond` includes the figures of L_s, the drop and the map.

    The template is Markdown with Jinja2's expressions. It can use ``claim(id)``, a claim's row;
    ``ours(id)``, our number with range and unit; ``checked(id)``, whether it has a verdict;
    ``mesh``, that of the role ``paper`` in words, and the ``caution`` that a coarse one needs;
    ``verdicts``, their counts; ``verdict``, :class:`Verdict`; ``claims``, all rows; ``runs(role)``,
    the role's rows of lengths, one for each fault; ``pairs``, the faults of the paper's study, each
    with its row of the converged study; ``by_theory(role)``, the range of L_s/L_c by theory; and
    the filters ``digits(n)``, ``span(n)`` of numbers, ``percent(n)`` and ``typeset``, the last for
    texts with formulas. A name that the results lack is an error.
    """
    environment = jinja2.Environment(
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {
        "digits": digits,
        "percent": _percent,
        "span": lambda values, number: span(values, lambda value: digits(value, number)),
        "typeset": escaped,
    }
    by_id = {row["id"]: row for row in claims}
    faults = [row for table in lengths for row in rows_of(over_realisations(table))]

    def runs(role: str) -> list[Row]:
        return [row for row in faults if row["role"] == role]

    def by_theory(role: str) -> str:
        ratios = [row["stability_length"] / row["critical_length"] for row in runs(role)]
        return span(ratios, ".2f")

    converged = {row["fault"]: row for row in runs("converged")}
    return environment.from_string(template).render(
        claim=by_id.__getitem__,
        ours=lambda id: number_text(by_id[id]) or "not computed",
        checked=lambda id: by_id[id]["verdict"] != Verdict.UNCHECKED,
        mesh=mesh(runs("paper")),
        caution=caution(runs("paper")),
        verdicts=counts(claims),
        verdict=Verdict,
        claims=claims,
        runs=runs,
        pairs=[(row, converged.get(row["fault"])) for row in runs("paper")],
        by_theory=by_theory,
        beyond=beyond,
    )


def digits(value: float | None, number: int) -> str:
    """A value with some significant digits, or a dash for None."""
    if value is None:
        return "–"
    mantissa, _, power = f"{value:.{number}g}".partition("e")
    if not power:
        return mantissa
    factor = "" if mantissa == "1" else rf"{mantissa}\times "
    return f"${factor}10^{{{int(power)}}}$"


def _percent(value: float | None, places: int = 0) -> str:
    """A part in percent, or a dash for None."""
    return "–" if value is None else f"{100.0 * value:.{places}f} %"
