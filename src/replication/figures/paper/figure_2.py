"""Figure 2: the critical length of bimaterial interfaces against the contrast (Eq. 9)."""

from itertools import cycle

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from nucleation.pictures import style
from nucleation.types import Array

DASHES = ("-", (0, (5, 1.5)), (0, (5, 1.5, 1, 1.5)), (0, (1.2, 1.2)), (0, (9, 1.5, 1, 1.5, 1, 1.5)))
HANDLE = 4.0  # length of the legend's lines over the font size: each pattern is shown entirely


def looks(weakenings: Array) -> dict[float, style.Options]:
    """Colour and dashes by zeta/a, from the highest to the lowest."""
    values = np.sort(np.unique(weakenings))[::-1].tolist()
    found = {}
    for value, shade, dashes in zip(
        values, style.shades(len(values), 0.82), cycle(DASHES), strict=False
    ):
        found[value] = {"color": shade, "linestyle": dashes}
    return found


@style.styled
def draw(theory: xr.Dataset) -> Figure:
    """Draw ``L_c / L_c^M`` against ``f beta``, one curve for each ``zeta / a``.

    Parameters
    ----------
    theory : Dataset
        With ``bimaterial_length_ratio(zeta_over_a, f_beta)``, dimensionless.

    Returns
    -------
    Figure
        One panel.
    """
    figure, axes = style.column(6.6)
    ratio = theory["bimaterial_length_ratio"]
    f_beta = ratio["f_beta"]
    for value, look in looks(ratio["zeta_over_a"].values).items():
        curve = ratio.sel(zeta_over_a=value).transpose("f_beta").values
        axes.plot(f_beta, curve, label=f"${value:.3g}$", **look)
    axes.set_xlabel(r"Bimaterial contrast $f\beta$")
    axes.set_ylabel(r"Critical length $L_c/L_c^{\mathcal{M}}$")
    axes.set_xlim(float(f_beta.min()), float(f_beta.max()))
    axes.set_ylim(0.0, 1.04)
    axes.minorticks_on()
    # the curves decrease from one, the highest zeta/a on top: the legend has their order
    axes.legend(
        title=r"$\zeta/a$",
        loc="lower left",
        title_fontsize=9.0,
        labelspacing=0.3,
        handlelength=HANDLE,
    )
    return figure
