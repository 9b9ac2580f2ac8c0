"""Which weakening patches nucleate among strengthening surroundings: theory and simulations."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.pictures import style

from .. import laws

LOOKS = {
    "creep": ("creeps", "o", style.BLUE),
    "slow slip": ("slips slowly", "s", style.GREEN),
    "event": ("nucleates", "^", style.VERMILLION),
}
"""Label, marker and colour of each outcome of a run."""

THEORY = "$W_c$ by theory"
RIGID = 1.158 / np.pi  # for half-spaces with surroundings that do not slip
TICKS = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0)  # of the surroundings' strengthening


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw widths over L_c against the surroundings' strengthening, one panel for each zeta/a.

    Parameters
    ----------
    table : Dataset
        From :func:`replication.tables.weakening_patches.weakening_patches_table`.

    Returns
    -------
    Figure
        A panel for each zeta/a.
    """
    rounded = table.assign(ratio=table["zeta_over_a"].round(3)).sortby("strengthening")
    ratios = np.unique(rounded["ratio"])
    figure, panels = style.panels(1, ratios.size, 7.5)
    panels = np.ravel(panels)
    for axes, letter, ratio in zip(panels, "abcdefgh", ratios, strict=False):
        _draw_weakening(axes, laws.where(rounded, ratio=ratio))
        axes.set_title(rf"({letter}) $\zeta/a$ = {ratio:.2g}")
    panels[0].set_ylabel("Width of the patch $W/L_c$")
    entries = style.entries(panels[0])
    for label, marker, colour in LOOKS.values():
        entries[label] = style.key(label, marker, colour=colour, mfc="none")
    figure.legend(
        entries.values(),
        entries,
        loc="outside upper center",
        ncols=len(entries),
    )
    return figure


def _draw_weakening(axes: Axes, rows: xr.Dataset) -> None:
    """The theory's curve and the runs with one friction of the patch."""
    theory = laws.where(rows, outcome="theory")
    curve = theory["smallest_width"] / theory["critical_length"]
    axes.plot(theory["strengthening"], curve, color=style.BLACK, label=THEORY)
    style.level(axes, RIGID, label="asperity, rigid surroundings")
    for name, (_, marker, colour) in LOOKS.items():
        own = laws.where(rows, outcome=name)
        width = own["width"] / own["critical_length"]
        axes.plot(own["strengthening"], width, marker, color=colour, mfc="none")
    top = 1.08 * float((rows["width"] / rows["critical_length"]).max())
    axes.set(
        xscale="log",
        xlabel=r"Strengthening around $-\zeta_{out}/\zeta$",
        ylim=(0.0, top),
    )
    style.plain_numbers(axes.xaxis, TICKS)
