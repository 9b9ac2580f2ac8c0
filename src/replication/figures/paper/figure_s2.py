"""Figure S2: space-time image of the interfacial shear stress, and the driving force."""

import xarray as xr
from matplotlib.figure import Figure

from nucleation.pictures import run

from ...tables.lengths import row


def draw(lengths: xr.Dataset, simulation: xr.Dataset, id: str) -> Figure:
    """The picture of one run of a table of lengths; its length is L_c, as in the paper."""
    return run.draw(simulation, row(lengths, id), "$L_c$")
