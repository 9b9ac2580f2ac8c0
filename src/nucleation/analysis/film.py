"""A film of one run: the slip rate at the interface and the shear stress in the bodies.

A simulation records the bulk at a few instants only. For a film the same run is made once more,
which gives the same steps, and the stress is taken at chosen ones of its recorded times.
"""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..datasets.variables import Variable, annotate
from ..fem.condensed import ElasticBody
from ..model.material import Material
from ..simulation.recorded import RECORDED
from ..simulation.run import composed, run
from ..simulation.state import State
from ..types import Array
from .lengths import row
from .record import parameters_of

Indices = NDArray[np.intp]

MARGIN = 0.05  # s: the event begins so long before the onset, and ends so long after its peak
LONGEST_EVENT = 1.0  # s from the onset to the peak


def thinned(indices: Indices, most: int) -> Indices:
    """At most so many of some indices, evenly spaced, with the first and the last."""
    if indices.size <= most:
        return indices
    return indices[np.linspace(0, indices.size - 1, most).round().astype(int)]


def event_interval(simulation: xr.Dataset, onset: float) -> tuple[float, float]:
    """Beginning and end (s) of the event: from the onset (s) to its highest slip rate, and more.

    Without an onset, nothing: the end of the run, twice.
    """
    time = simulation["step_time"].values
    if not np.isfinite(onset):
        return float(time[-1]), float(time[-1])
    during = np.flatnonzero((time >= onset) & (time <= onset + LONGEST_EVENT))
    peak = time[during[simulation["maximal_slip_rate"].values[during].argmax()]]
    return onset - MARGIN, float(peak) + MARGIN


def chosen_frames(time: Array, event: tuple[float, float], most: tuple[int, int, int]) -> Indices:
    """Indices of recorded times (s): at most so many before, in and after the event (s).

    The record has more frames where more happens, so that in each stretch every so many will do.
    """
    stretch = np.digitize(time, event)
    parts = [thinned(np.flatnonzero(stretch == i), count) for i, count in enumerate(most)]
    return np.concatenate(parts)


MOST_FRAMES = (45, 70, 5)  # before, in and after the event
MOST_COLUMNS, MOST_ROWS = 241, 31
FILMED = {**RECORDED, "block_shear_stress": Variable("Pa", "shear stress in the block", "sigma_xy")}
SHOWN_LENGTHS = 2.0  # part of the block that is filmed, in critical lengths


def shear_stress(body: ElasticBody, state: State, materials: Sequence[Material]) -> Array:
    """Shear stress (Pa) at the nodes by differences of neighbours, (levels, n_x + 1).

    Levels as of :func:`levels`: both bodies have one of their own on the interface, whose stresses
    are alike as far as the meshes resolve them.
    """
    sides = [(body.grid, 1.0, body.nodal_values)]
    if body.grid_below is not None:
        sides.append((body.grid_below, -1.0, body.nodal_values_below))
    found = []
    for (grid, up, values), material in zip(sides, materials, strict=True):
        along_x, along_y = values(state.displacement)
        shear = np.gradient(along_x, up * grid.y, axis=0) + np.gradient(along_y, grid.x, axis=1)
        found.append(material.shear_modulus * shear)
    return np.concatenate([*(stress[::-1] for stress in found[1:]), found[0]])


def levels(body: ElasticBody) -> tuple[Array, Indices]:
    """Heights y (m) of the nodes from the lowest to the highest, and which of them a film shows.

    The interface's ``y = 0`` is there twice if there is a second body, whose nodes come first.
    """
    rows = thinned(np.arange(body.grid.y.size), MOST_ROWS)
    if body.grid_below is None:
        return body.grid.y, rows
    below = body.grid_below.y
    rows_below = below.size - 1 - thinned(np.arange(below.size), MOST_ROWS)[::-1]
    return np.concatenate((-below[::-1], body.grid.y)), np.append(rows_below, below.size + rows)


def film_dataset(simulation: xr.Dataset, row: xr.Dataset) -> xr.Dataset:
    """Run a simulation once more, and take the stress in its bodies along the way.

    The dataset has ``slip_rate`` (m/s) on (time, x) and ``block_shear_stress`` (Pa) on (time, y, x)
    at some of the recorded times and of the nodes, near the loaded edge. A second body is in it
    from ``y = -H2`` to its own ``y = 0``, below that of the upper one.

    Parameters
    ----------
    simulation : the record of :func:`nucleation.simulation.run.simulate`.
    row : of the table of lengths: ``onset_time`` (s) and ``length`` (m), NaN without an event.
    """
    parameters = parameters_of(simulation)
    dynamics = composed(parameters)
    grid = dynamics.grid
    farthest = np.fmin(SHOWN_LENGTHS * float(row["length"]), grid.length)
    columns = thinned(np.flatnonzero(grid.x <= farthest), MOST_COLUMNS)
    heights, rows = levels(dynamics.body)
    recorded = simulation["time"].values
    event = event_interval(simulation, float(row["onset_time"]))
    frames = chosen_frames(recorded, event, MOST_FRAMES)
    below = parameters.below
    materials = [parameters.material, *([below.material] if below else [])]
    stresses = []  # type: ignore[var-annotated]
    for instant in run(parameters, dynamics=dynamics):
        if instant.state.time >= recorded[frames[len(stresses)]]:
            stress = shear_stress(dynamics.body, instant.state, materials)
            stresses.append(stress[np.ix_(rows, columns)].astype(np.float32))
        if len(stresses) == frames.size:
            break
    names = ["slip_rate", "driving_force", "maximal_slip_rate", "step_time"]
    film = simulation[names].isel(time=frames, x=columns).assign_coords(y=heights[rows])
    film["block_shear_stress"] = ("time", "y", "x"), np.array(stresses)
    film.attrs = {"parameters": parameters.to_json()}
    return annotate(film, FILMED)


def of_run(lengths: xr.Dataset, simulation: xr.Dataset, id: str) -> xr.Dataset:
    """The step ``film``: of a run of a table of lengths."""
    return film_dataset(simulation, row(lengths, id))
