"""Blind faults: simulated L against L predicted before, with ranges."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from nucleation.pictures import style

_KINDS = {
    "rigid": ("rigid base", "o", style.BLACK),
    "equal": ("equal bodies", "s", style.BLUE),
    "different": ("different bodies", "D", style.VERMILLION),
}
_SETS = {"calibrate": "first set, even", "test": "first set, odd", "second": "second set"}


@style.styled()
def draw(blind: xr.Dataset) -> Figure:
    """Draw L/L_c simulated against predicted; bars are ranges, open marks have a doubt."""
    figure, panels = style.panels(6.5, columns=3, squeeze=False)
    for axes, (of_set, title), letter in zip(panels.flat, _SETS.items(), "abc", strict=True):
        for below, (label, marker, colour) in _KINDS.items():
            chosen = (blind["set"].values == of_set) & (blind["below"].values == below)
            own = blind.isel(run=np.flatnonzero(chosen))
            scale = own["critical_length"].values
            value, low, high = (
                own[f"expected_{name}"].values / scale for name in ("length", "low", "high")
            )
            simulated = own["length"].values / scale
            doubted = own["doubt"].values != ""
            for those, face in ((~doubted, colour), (doubted, "none")):
                errors = [value[those] - low[those], high[those] - value[those]]
                axes.errorbar(
                    value[those],
                    simulated[those],
                    xerr=errors,
                    fmt=marker,
                    ms=3.5,
                    lw=0.6,
                    color=colour,
                    markerfacecolor=face,
                    label=label if face == colour else None,
                )
        ends = (0.33, 1.8)
        axes.plot(ends, ends, color=style.GUIDE, lw=0.7)
        axes.set(xscale="log", yscale="log", xlim=ends, ylim=ends)
        axes.set(title=f"({letter}) {title}", xlabel="Predicted $L/L_c$")
        style.plain_numbers(axes.xaxis)
        style.plain_numbers(axes.yaxis)
    panels[0, 0].set_ylabel("Simulated $L/L_c$")
    panels[0, 0].legend(loc="upper left")
    return figure
