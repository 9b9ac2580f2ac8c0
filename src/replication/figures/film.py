"""A film of one run: the slip rate at the interface and the shear stress in the bodies.

A simulation records the bulk at a few instants only. For a film the run is repeated, which gives
the same steps, and the stress is computed at some of its recorded times.
"""

from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from nucleation.datasets.variables import Variable, annotate
from nucleation.extraction.record import parameters_of
from nucleation.fem.condensed import ElasticBody
from nucleation.fem.grid import Field, Grid
from nucleation.model.material import Material
from nucleation.simulation.recorded import RECORDED
from nucleation.simulation.run import composed, run
from nucleation.simulation.state import State
from nucleation.types import Array

from ..tables.lengths import row

Indices = NDArray[np.intp]

MARGIN = 1.0  # D/V by which the shown event begins before the onset and ends after its peak
LONGEST_EVENT = 20.0  # D/V from the onset to the peak
MOST_FRAMES = (45, 70, 5)  # before, in and after the event
MOST_COLUMNS = 241
MOST_ROWS = 31
SHOWN_LENGTHS = 2.0  # part of the block that is filmed, in critical lengths
FILMED = {
    **RECORDED,
    "block_shear_stress": Variable("Pa", "shear stress in the block", "sigma_xy"),
}


def film_dataset(simulation: xr.Dataset, row: xr.Dataset) -> xr.Dataset:
    """Repeat a simulation and compute the stress in its bodies along the way.

    Parameters
    ----------
    simulation : Dataset
        Record of :func:`nucleation.simulation.run.simulate`.
    row : Dataset
        Row of the table of lengths: ``onset_time`` (s) and ``length`` (m), NaN without an event.

    Returns
    -------
    Dataset
        ``slip_rate`` (m/s) on (time, x) and ``block_shear_stress`` (Pa) on (time, y, x), at some of
        the recorded times and of the nodes near the loaded edge. A second body extends from
        ``y = -H2`` to its own ``y = 0``, below that of the upper one.
    """
    parameters = parameters_of(simulation)
    dynamics = composed(parameters)
    grid = dynamics.grid
    length = float(row["length"])
    farthest = np.fmin(SHOWN_LENGTHS * length, grid.length)
    columns = _thinned(np.flatnonzero(grid.x <= farthest), MOST_COLUMNS)
    heights, rows = levels(dynamics.body)
    recorded = simulation["time"].values
    event = event_interval(simulation, float(row["onset_time"]))
    frames = _chosen_frames(recorded, event)
    materials = [parameters.material]
    if parameters.below is not None:
        materials.append(parameters.below.material)
    stresses: list[NDArray[np.float32]] = []
    for instant in run(parameters, dynamics=dynamics):
        next_frame = frames[len(stresses)]
        if instant.state.time >= recorded[next_frame]:
            stress = shear_stress(dynamics.body, instant.state, materials)
            shown = stress[np.ix_(rows, columns)]
            stresses.append(shown.astype(np.float32))
        if len(stresses) == frames.size:
            break
    names = ["slip_rate", "driving_force", "maximal_slip_rate", "step_time"]
    film = simulation[names].isel(time=frames, x=columns)
    film = film.assign_coords(y=heights[rows])
    film["block_shear_stress"] = ("time", "y", "x"), np.array(stresses)
    film.attrs = {"parameters": parameters.to_json()}
    return annotate(film, FILMED)


def of_run(
    lengths: xr.Dataset,
    simulation: xr.Dataset,
    id: str,
) -> xr.Dataset:
    """The film of a run in a table of lengths.

    Parameters
    ----------
    lengths : Dataset
        Table of lengths.
    simulation : Dataset
        Record of the run.
    id : str
        The run's id in the table.

    Returns
    -------
    Dataset
        That of :func:`film_dataset`.
    """
    return film_dataset(simulation, row(lengths, id))


def event_interval(simulation: xr.Dataset, onset: float) -> tuple[float, float]:
    """Interval that shows the event: from before the onset to after the highest slip rate.

    Parameters
    ----------
    simulation : Dataset
        Record of a run, with the attribute ``parameters``.
    onset : float
        Onset of the event (s), NaN without an event.

    Returns
    -------
    begin, end : float
        In s; without an event both are the end of the run.
    """
    time = simulation["step_time"].values
    if not np.isfinite(onset):
        end = float(time[-1])
        return end, end
    memory_time = parameters_of(simulation).memory_time
    after = (time >= onset) & (time <= onset + LONGEST_EVENT * memory_time)
    during = np.flatnonzero(after)
    rates = simulation["maximal_slip_rate"].values[during]
    peak = time[during[rates.argmax()]]
    margin = MARGIN * memory_time
    return onset - margin, float(peak) + margin


def _chosen_frames(time: Array, event: tuple[float, float]) -> Indices:
    """Indices of at most :data:`MOST_FRAMES` recorded times (s) before, in and after the event.

    The record has more frames where more happens, so every nth frame is taken in each part.
    """
    part = np.digitize(time, event)
    chosen = []
    for i, most in enumerate(MOST_FRAMES):
        own = np.flatnonzero(part == i)
        chosen.append(_thinned(own, most))
    return np.concatenate(chosen)


def _thinned(indices: Indices, most: int) -> Indices:
    """At most `most` of the indices, evenly spaced, with the first and the last."""
    if indices.size <= most:
        return indices
    chosen = np.linspace(0, indices.size - 1, most).round()
    return indices[chosen.astype(int)]


def shear_stress(
    body: ElasticBody,
    state: State,
    materials: Sequence[Material],
) -> Array:
    """Shear stress at the nodes, by differences of neighbours.

    Two bodies have a level each on the interface. Their stresses there agree as far as the meshes
    resolve them.

    Parameters
    ----------
    body : ElasticBody
        The body, or both of a pair.
    state : State
        State of the run.
    materials : sequence of Material
        Material of the upper body, and of the second one if there is one.

    Returns
    -------
    ndarray, shape (levels, n_x + 1)
        In Pa, from the lowest level to the highest.
    """

    def of_body(
        grid: Grid,
        up: float,
        values: Callable[[Field], tuple[Array, Array]],
        material: Material,
    ) -> Array:
        """The stress (Pa) in one body.

        Parameters
        ----------
        grid : Grid
            Its mesh.
        up : float
            1 if the mesh's y points upwards, else -1.
        values : callable
            Displacements (m) along x and y at the nodes.
        material : Material
            Its material.
        """
        along_x, along_y = values(state.displacement)
        along_x_by_y = np.gradient(along_x, up * grid.y, axis=0)
        along_y_by_x = np.gradient(along_y, grid.x, axis=1)
        return material.shear_modulus * (along_x_by_y + along_y_by_x)

    upper = of_body(body.grid, 1.0, body.nodal_values, materials[0])
    if body.grid_below is None:
        return upper
    below = of_body(body.grid_below, -1.0, body.nodal_values_below, materials[1])
    return np.concatenate([below[::-1], upper])


def levels(body: ElasticBody) -> tuple[Array, Indices]:
    """Heights y (m) of the nodes from the lowest to the highest, and the shown ones of them.

    With a second body, y = 0 appears twice; the second body's nodes come first.
    """
    rows = _thinned(np.arange(body.grid.y.size), MOST_ROWS)
    if body.grid_below is None:
        return body.grid.y, rows
    depths = body.grid_below.y
    number = depths.size
    rows_below = number - 1 - _thinned(np.arange(number), MOST_ROWS)
    heights = np.concatenate((-depths[::-1], body.grid.y))
    return heights, np.append(rows_below[::-1], number + rows)
