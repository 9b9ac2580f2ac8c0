"""A film of one run: the slip rate at the interface and the shear stress in the block.

A simulation records the bulk at a few instants only. For a film the same run is made once more,
which gives the same steps, and the stress is taken at chosen ones of its recorded times.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..fem.condensed import Body
from ..simulation.composition import composed
from ..simulation.run import run
from ..simulation.state import State
from .moments import chosen_frames, event_interval, thinned
from .record import parameters_of

Array = NDArray[np.float64]

MOST_FRAMES = (45, 70, 5)  # before, in and after the event
MOST_COLUMNS, MOST_ROWS = 241, 31
SHOWN_LENGTHS = 2.0  # part of the block that is filmed, in critical lengths


def shear_stress(body: Body, state: State, shear_modulus: float) -> Array:
    """Shear stress (Pa) at the nodes, shape (n_y + 1, n_x + 1), by differences of neighbours."""
    grid, (along_x, along_y) = body.grid, body.nodal_values(state.displacement)
    shear = np.gradient(along_x, grid.y, axis=0) + np.gradient(along_y, grid.x, axis=1)
    return shear_modulus * shear


def film_dataset(simulation: xr.Dataset, row: xr.Dataset) -> xr.Dataset:
    """Run a simulation once more, and take the stress in its block along the way.

    Parameters
    ----------
    simulation : Dataset
        The record of :func:`nucleation.simulation.run.simulate`.
    row : Dataset
        Its entry of the table of lengths: ``onset_time`` (s) and ``length`` (m), NaN without an
        event.

    Returns
    -------
    Dataset
        ``slip_rate`` (m/s) on (time, x), ``block_shear_stress`` (Pa) on (time, y, x), at some of
        the recorded times and of the nodes, near the loaded edge; ``driving_force`` (N/m) and
        ``maximal_slip_rate`` (m/s) on (step); the run's ``parameters`` as an attribute.
    """
    parameters = parameters_of(simulation)
    dynamics = composed(parameters)
    grid = dynamics.grid
    farthest = np.fmin(SHOWN_LENGTHS * float(row["length"]), grid.length)
    columns = thinned(np.flatnonzero(grid.x <= farthest), MOST_COLUMNS)
    rows = thinned(np.arange(grid.y.size), MOST_ROWS)
    recorded = simulation["time"].values
    event = event_interval(simulation, float(row["onset_time"]))
    frames = chosen_frames(recorded, event, MOST_FRAMES)
    stresses = []  # type: ignore[var-annotated]
    for instant in run(parameters, dynamics=dynamics):
        if instant.state.time >= recorded[frames[len(stresses)]]:
            modulus = parameters.material.shear_modulus
            stress = shear_stress(dynamics.body, instant.state, modulus)
            stresses.append(stress[np.ix_(rows, columns)].astype(np.float32))
        if len(stresses) == frames.size:
            break
    names = ["slip_rate", "driving_force", "maximal_slip_rate", "step_time"]
    film = simulation[names].isel(time=frames, x=columns).assign_coords(y=grid.y[rows])
    film["block_shear_stress"] = ("time", "y", "x"), np.array(stresses)
    film.attrs = {"parameters": parameters.to_json()}
    return film
