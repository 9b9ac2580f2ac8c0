"""Two deformable bodies: lengths over the contrast, in both senses."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.pictures import style
from nucleation.theory.closed_forms import bimaterial_length_ratio

from ..tables.ratios import pairs_over_realisations
from . import laws
from .theory import HANDLE
from .theory import looks as curve_looks

_CONTRAST = np.linspace(-0.42, 0.42, 169)
_PANELS = (("length_ratio", "(a) at the drop"), ("stability_ratio", "(b) patch turns unstable"))
_UNKNOWN = 0.14  # ordinate of runs without the length


@style.styled()
def draw(table: xr.Dataset, theory: xr.Dataset) -> Figure:
    """Draw Figure 2 with lengths over ``L_c^M``, at the drop and where the patch becomes unstable.

    The stiffer body is the upper one in the left half of each panel, and the lower one in the right
    half; bars are the range of the realisations. Crosses are runs without the length.
    """
    rows = pairs_over_realisations(laws.where(table, role="figure_2_simulated"))
    rows = rows.assign(zeta_over_a=rows["zeta_over_a"].round(3)).sortby("f_beta")
    figure, panels = style.panels(8.8, columns=2, sharey=True)
    simulated = np.unique(rows["zeta_over_a"].values)
    looks = curve_looks(np.union1d(theory["zeta_over_a"].values, simulated))
    for axes, (name, title) in zip(panels, _PANELS, strict=True):
        for ratio, marker in zip(
            simulated[::-1],
            style.MARKERS,
            strict=False,
        ):
            own = laws.where(rows, zeta_over_a=ratio)
            _draw_weakening(
                axes,
                own,
                name,
                {"marker": marker, **looks[float(ratio)]},
            )
        axes.set(title=title, xlabel=r"Bimaterial contrast $f\beta$")
        axes.set_xlim(_CONTRAST[0], _CONTRAST[-1])
        axes.axvline(0.0, ls=":", lw=0.6)
        look: style.Options = {"transform": axes.transAxes, "fontsize": style.SMALL}
        axes.text(0.02, 0.03, "stiffer body above", ha="left", **look)
        axes.text(0.98, 0.03, "stiffer body below", ha="right", **look)
    panels[0].set(ylim=(0.0, None), ylabel=r"Length over $L_c^{\mathcal{M}}$")
    below: style.Options = {"loc": "outside lower center", "handlelength": HANDLE}
    style.legend(
        figure,
        *panels,
        ncols=max(simulated.size, 1),
        **below,
    )
    return figure


def _draw_weakening(
    axes: Axes,
    own: xr.Dataset,
    name: str,
    look: style.Options,
) -> None:
    """The curve of Eq. (9) and the simulated lengths of one zeta/a."""
    ratio = float(own["zeta_over_a"][0])
    weakening = rf"$\zeta/a={ratio:.3g}$"
    curve = bimaterial_length_ratio(np.abs(_CONTRAST), ratio)
    axes.plot(
        _CONTRAST,
        curve,
        label=f"Eq. (9), {weakening}",
        lw=1.1,
        **look | {"marker": ""},
    )
    # the theory's length for blocks of this height without contrast
    unit = 1.0 / own["half_space_ratio"]
    own = own.assign({key: own[key] / unit for key in own if str(key).startswith(name)})
    marks: style.Options = look | {"linestyle": "-", "linewidth": 0.5, "capsize": 1.8}
    label = f"simulated, {weakening}"
    laws.draw(
        axes,
        "f_beta",
        own,
        name,
        label=label,
        **marks,
    )
    unknown = own["f_beta"].values[np.isnan(own[name].values)]
    if unknown.size:
        at = np.full(unknown.size, _UNKNOWN)
        label = f"{weakening}, no length found"
        axes.plot(
            unknown,
            at,
            "x",
            color=look["color"],
            label=label,
        )
