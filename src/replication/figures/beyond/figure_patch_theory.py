"""The theory of the creeping patch against simulations: lengths, and the creep behind them."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.pictures import style

from .. import laws

_BAND = 0.03  # relative error within which theory and simulation agree


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw L_s over L_c against zeta/a, both lengths against each other, slip rate and stress.

    Parameters
    ----------
    table : Dataset
        From :func:`replication.tables.theory.theory_files`.

    Returns
    -------
    Figure
        Three panels.
    """
    figure, (ratio, parity, creep) = style.panels(1, 3, 7.6)
    _draw_ratio(ratio, table)
    _draw_parity(parity, table)
    if "shown_beta" in table:
        _draw_creep(creep, table)
    style.letters(ratio, parity, creep, minor=True)
    return figure


def _draw_ratio(axes: Axes, table: xr.Dataset) -> None:
    """L_s/L_c over zeta/a: the thin limit, and simulations by their height."""
    curve = table["curve_stability"]
    axes.semilogx(
        table["curve_ratio"],
        curve,
        color=style.STABILITY,
        label="thin layers",
    )
    own = laws.where(table, f_beta=0.0)
    theory = own["critical_length"]
    drawn = axes.scatter(
        own["zeta_over_a"],
        own["stability_length"] / theory,
        c=own["height"] / theory,
        s=7.0,
        norm="log",
        cmap=style.SEQUENCE,
        label="simulated",
    )
    axes.figure.colorbar(drawn, ax=axes, label="$H/L_c$")
    style.level(axes, 0.5, ":", 0.6, label="one half")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.legend(fontsize=style.SMALL)
    axes.set(xlabel=r"$\zeta/a$", ylabel="$L_s/L_c$")


def _draw_parity(axes: Axes, table: xr.Dataset) -> None:
    """Difference of the theory's L_s from the simulated one, by study."""
    for n, own in enumerate(laws.groups(table, "study")):
        marker, colour = style.look(n)
        measured = own["stability_length"] / own["critical_length"]
        difference = 100.0 * (own["front_length"] / own["stability_length"] - 1.0)
        label = str(own["study"].values[0]).replace("_", " ")
        axes.plot(
            measured,
            difference,
            marker,
            color=colour,
            markersize=2.8,
            label=label,
        )
    style.band(axes, -100.0 * _BAND, 100.0 * _BAND, f"within {100 * _BAND:g} %")
    axes.set(xlabel="$L_s/L_c$, simulated", ylabel=r"$L_s$: theory / simulation $-$ 1 (%)")
    axes.figure.legend(
        handles=axes.get_legend_handles_labels()[0],
        loc="outside lower center",
        title="Studies in (b)",
        fontsize=style.SMALL,
        handletextpad=0.2,
        columnspacing=1.0,
        ncols=5,
    )


def _draw_creep(axes: Axes, table: xr.Dataset) -> None:
    """Slip rate (dashed) and normal stress along patches at their L_s, by the contrast."""
    for i, colour in enumerate(style.shades(table.sizes["case"])):
        case = table.isel(case=i)
        label = rf"$f\beta = {float(case['shown_beta']):.2g}$"
        axes.plot(case["shown_x"], case["shown_stress"], color=colour, label=label)
        axes.plot(case["shown_x"], case["shown_rate"], color=colour, linestyle="--")
    axes.set(
        xlabel="$x/L_s$",
        ylabel=r"$\sigma/\sigma_0$;  $v/V$ (dashed)",
        ylim=(0.0, 2.2),
    )
    axes.legend(fontsize=style.SMALL)
