"""The theory of the creeping patch against simulations: lengths, and the creep behind them."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style

BAND = 0.03  # relative error within which theory and simulation agree


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw L_s over L_c against zeta/a, both lengths against each other, slip rate and stress.

    Parameters
    ----------
    table : Dataset
        Of :func:`nucleation.patch.theory_table.gather`.

    Returns
    -------
    Figure
        Two columns wide.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 7.6 * style.CENTIMETRE)
    ratio, parity, creep = figure.subplots(1, 3)
    _draw_ratio(ratio, table)
    _draw_parity(parity, table)
    _draw_creep(creep, table)
    style.letters(ratio, parity, creep)
    for axes in (ratio, parity, creep):
        axes.minorticks_on()
    return figure


def _draw_ratio(axes: Axes, table: xr.Dataset) -> None:
    """L_s/L_c over zeta/a: the thin limit, and simulations by their height."""
    axes.semilogx(
        table["curve_ratio"], table["curve_length"], color=style.THIN_LIMIT, label="thin layers",
    )  # fmt: skip
    alike = np.flatnonzero(table["f_beta"].values == 0.0)
    own = table.isel(run=alike)
    drawn = axes.scatter(
        own["zeta_over_a"], own["stability_length"] / own["theory_length"], s=7.0,
        c=own["height"] / own["theory_length"], norm="log", cmap=style.SEQUENCE, label="simulated",
    )  # fmt: skip
    axes.figure.colorbar(drawn, ax=axes, label="$H/L_c$")
    axes.axhline(0.5, color=style.GUIDE, linewidth=0.6, linestyle=":", label="one half")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.legend(fontsize=style.SMALL)
    axes.set_xlabel(r"$\zeta/a$")
    axes.set_ylabel("$L_s/L_c$")


def _draw_parity(axes: Axes, table: xr.Dataset) -> None:
    """The theory's L_s over the simulated one, with the front and of steady creep."""
    measured = (table["stability_length"] / table["theory_length"]).values
    studies = list(dict.fromkeys(table["study"].values))
    for n, study in enumerate(studies):
        chosen = table["study"].values == study
        marker, colour = style.look(n)
        off = (table["front_length"] / table["stability_length"] - 1.0).values[chosen]
        axes.plot(
            measured[chosen], 100.0 * off, marker, color=colour, markersize=2.8,
            label=str(study).replace("_", " "),
        )  # fmt: skip
    axes.axhspan(
        -100.0 * BAND,
        100.0 * BAND,
        color=style.GUIDE,
        alpha=0.12,
        linewidth=0.0,
        label=f"within {100 * BAND:g} %",
    )
    axes.set_xlabel("$L_s/L_c$, simulated")
    axes.set_ylabel(r"$L_s$: theory / simulation $-$ 1 (%)")
    axes.figure.legend(
        *axes.get_legend_handles_labels(), loc="outside lower center", ncols=5,
        fontsize=style.SMALL, handletextpad=0.2, columnspacing=1.0, title="Studies in (b)",
    )  # fmt: skip


def _draw_creep(axes: Axes, table: xr.Dataset) -> None:
    """Slip rate (dashed) and normal stress along patches at their L_s, by the contrast."""
    if "shown_beta" not in table:
        return
    for i, colour in enumerate(style.shades(table.sizes["case"])):
        case = table.isel(case=i)
        label = rf"$f\beta = {float(case['shown_beta']):.2g}$"
        axes.plot(case["shown_x"], case["shown_stress"], color=colour, label=label)
        axes.plot(case["shown_x"], case["shown_rate"], color=colour, linestyle="--")
    axes.set_xlabel("$x/L_s$")
    axes.set_ylabel(r"$\sigma/\sigma_0$;  $v/V$ (dashed)")
    axes.set_ylim(0.0, 2.2)
    axes.legend(fontsize=style.SMALL)
