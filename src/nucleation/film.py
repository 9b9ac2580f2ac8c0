"""A film of one run: the slip rate at the interface and the shear stress in the block.

A simulation records the bulk at a few instants only. For a film the same run is made once more,
which gives the same steps, and the stress is taken at chosen ones of its recorded times.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .fem.body import Body
from .fem.dynamics import State
from .fem.grid import Grid
from .moments import chosen_frames, event_interval, thinned
from .parameters import Parameters
from .simulation import run

Array = NDArray[np.float64]

MOST_FRAMES = (45, 70, 5)  # before, in and after the event
MOST_COLUMNS, MOST_ROWS = 241, 31


def shear_stress(body: Body, grid: Grid, state: State, shear_modulus: float) -> Array:
    """Shear stress (Pa) at the nodes, shape (n_y + 1, n_x + 1), by differences of neighbours."""
    along_x, along_y = body.nodal_values(state.displacement)
    shear = np.gradient(along_x, grid.y, axis=0) + np.gradient(along_y, grid.x, axis=1)
    return shear_modulus * shear


def film_dataset(simulation: xr.Dataset, onset: float) -> xr.Dataset:
    """Run a simulation once more, and take the stress in its block along the way.

    Parameters
    ----------
    simulation : Dataset
        The record of :func:`nucleation.simulation.simulate`.
    onset : float
        Onset of its event (s), NaN if there is none.

    Returns
    -------
    Dataset
        ``slip_rate`` (m/s) on (time, x), ``block_shear_stress`` (Pa) on (time, y, x), with some of
        the recorded times and of the nodes; ``driving_force`` (N/m) on (step), every step; and the
        attributes of the simulation that say what was run.
    """
    parameters = Parameters.from_json(simulation.attrs["parameters"])
    geometry, mesh = parameters.geometry, parameters.mesh
    grid = Grid(geometry.length, geometry.height, mesh.n_x, mesh.n_y, mesh.grading)
    body = Body(grid, parameters.material)
    columns = thinned(np.arange(grid.x.size), MOST_COLUMNS)
    rows = thinned(np.arange(grid.y.size), MOST_ROWS)
    recorded = simulation["time"].values
    frames = chosen_frames(recorded, event_interval(simulation, onset), MOST_FRAMES)
    stresses = []
    for instant in run(parameters):
        if instant.state.time >= recorded[frames[len(stresses)]]:
            stress = shear_stress(body, grid, instant.state, parameters.material.shear_modulus)
            stresses.append(stress[np.ix_(rows, columns)].astype(np.float32))
        if len(stresses) == frames.size:
            break
    kept = simulation[["slip_rate", "driving_force", "step_time"]].isel(time=frames, x=columns)
    return (
        kept.assign_coords(y=grid.y[rows])
        .assign(block_shear_stress=(("time", "y", "x"), np.array(stresses)))
        .assign_attrs({"parameters": parameters.to_json()})
    )
