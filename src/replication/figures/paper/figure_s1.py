"""Figure S1: steady-state friction, the full law and its logarithmic expansion."""

import xarray as xr
from matplotlib.figure import Figure

from nucleation.pictures import style


@style.styled
def draw(theory: xr.Dataset) -> Figure:
    """Draw both steady-state friction curves and mark the driving velocity V.

    Parameters
    ----------
    theory : Dataset
        With ``steady_friction(slip_rate)`` and ``steady_friction_logarithmic(slip_rate)``,
        dimensionless, the slip rate in m/s, and ``velocity`` (m/s).

    Returns
    -------
    Figure
        One panel.
    """
    figure, axes = style.column(6.4)
    rate = theory["slip_rate"].values
    full = theory["steady_friction"].values
    logarithmic = theory["steady_friction_logarithmic"].values
    velocity = float(theory["velocity"])
    axes.semilogx(rate, full, color=style.FULL_LAW, linewidth=2.2, label="full law")
    axes.semilogx(rate, logarithmic, color=style.BLUE, linewidth=1.1, label="logarithmic law")
    style.vertical(axes, velocity)
    across = axes.get_xaxis_transform()
    axes.annotate("$V$", (velocity, 0.0), (4.0, 5.0), across, "offset points")
    axes.set_xlabel(r"Slip rate $v$ (m/s)")
    axes.set_ylabel(r"Steady-state friction coefficient $f_{\mathrm{ss}}$")
    axes.set_xlim(rate.min(), rate.max())
    axes.legend(loc="upper right")
    return figure
