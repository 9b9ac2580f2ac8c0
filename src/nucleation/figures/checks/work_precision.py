"""Work and precision of the time integration: a diagram of the benchmark."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from ...figures import style

LOOKS = (
    ("o", style.VERMILLION, "-"), ("s", style.BLUE, "--"), ("^", style.BLACK, "-."),
    ("D", style.GREEN, ":"),
)  # fmt: skip
"""Marker, colour and dashes by tolerance."""


@style.styled
def draw(rows: Sequence[dict[str, float]]) -> Figure:
    """Relative error of the onset time against wall time, one symbol per tolerance."""
    figure = style.new_figure(style.SINGLE_COLUMN, 6.5 * style.CENTIMETRE)
    axes = figure.add_subplot()
    for i, tolerance in enumerate(sorted({row["tolerance"] for row in rows})):
        marker, colour, dashes = LOOKS[i % len(LOOKS)]
        chosen = [row for row in rows if row["tolerance"] == tolerance]
        axes.plot(
            [row["seconds"] for row in chosen], [row["onset_error"] for row in chosen], dashes,
            marker=marker, color=colour, label=f"{tolerance:g}",
        )  # fmt: skip
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("Wall time (s)")
    axes.set_ylabel("Relative error of the onset time")
    axes.legend(title="tolerance")
    return figure
