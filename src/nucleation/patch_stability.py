"""Linear stability of the creeping patch itself, frozen at an instant of a simulation.

The paper replaces the patch by homogeneous sliding. Here friction, state and the static elastic
response of the block are linearised about the fields that the simulation has at one instant. For
perturbations of the displacement w and of psi = log(phi) at the slipping nodes, force balance
reads (p = -f R at each node, R the nodal normal force)

    (D + f N) dw + R (f_v dv + f_psi dpsi) = 0,      d(dw)/dt = dv,
    d(dpsi)/dt = g_v dv + g_psi dpsi,

with the condensed static operators D (tangential) and N (normal stress coupling) of the finite
elements and the evolution law ``dpsi/dt = g(v, psi)``. Eliminating dv leaves an eigenvalue
problem of twice the number of slipping nodes. Growth of the frozen patch begins where the largest
real part crosses zero: a critical length that, unlike the drop of the force, does not depend on
how strongly the run happens to be shaken.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .drop import WINDOW
from .extraction import SEARCHED, find_onset, patch_edge
from .fem.body import Body
from .fem.grid import Grid
from .fem.operator import BodyOperator
from .friction import Friction
from .lengths import description
from .parameters import Parameters
from .settings import ExtractionSettings

Array = NDArray[np.float64]

FEWEST_NODES = 8  # a shorter patch is not resolved


@dataclasses.dataclass(frozen=True)
class PatchSpectrum:
    """Eigenvalues (1/s) of the frozen patch, fastest growing first, and that mode's shape."""

    eigenvalues: NDArray[np.complex128]
    slip_mode: NDArray[np.complex128]  # displacement at `nodes`, largest modulus 1
    nodes: NDArray[np.intp]


def log_state_derivatives(law: Friction, slip_rate: Array, state: Array) -> tuple[Array, Array]:
    """Derivatives of ``dpsi/dt`` by v at fixed psi (1/m) and by psi at fixed v (1/s).

    With ``g(omega)`` the evolution law, ``dpsi/dt = g(phi w / D) / phi``.
    """
    speed, distance = law.slip_speed(slip_rate), law.characteristic_slip_distance
    omega = state * speed / distance
    evolution = law.evolution_law
    by_omega = evolution.slope(omega)
    by_rate = by_omega * slip_rate / (speed * distance)
    by_log_state = (by_omega * omega - evolution.growth(omega)) / state
    return by_rate, by_log_state


def patch_spectrum(
    operator: BodyOperator, law: Friction, slip_rate: Array, state: Array, normal_stress: Array,
    slowest: float,
) -> PatchSpectrum:  # fmt: skip
    """Spectrum of the patch whose fields along the interface (n_x + 1,) are given.

    Parameters
    ----------
    operator : the static stiffness of the block (``s = 0``).
    law : friction law.
    slip_rate, state, normal_stress : at the nodes 0..n_x (m/s, s, Pa; negative in compression).
    slowest : nodes that slip more slowly (m/s) are taken as stuck.
    """
    grid = operator.body.grid
    slipping = (slip_rate > slowest) & (grid.x <= SEARCHED * grid.length)
    nodes = np.flatnonzero(slipping[1:]) + 1
    v, phi = slip_rate[nodes], state[nodes]
    force = -normal_stress[nodes] * grid.nodal_lengths[nodes]
    f = law.coefficient(v, phi)
    f_v, f_phi = law.derivatives(v, phi)
    stiffness, coupling = operator.tangent(nodes)
    by_w = -(stiffness + f[:, None] * coupling) / (f_v * force)[:, None]  # dv by dw
    by_psi = -np.diag(f_phi * phi / f_v)  # dv by dpsi
    g_v, g_psi = log_state_derivatives(law, v, phi)
    matrix = np.block(
        [[by_w, by_psi], [g_v[:, None] * by_w, g_v[:, None] * by_psi + np.diag(g_psi)]]
    )
    values, vectors = np.linalg.eig(matrix)
    order = np.argsort(-values.real)
    mode = vectors[: nodes.size, order[0]]
    return PatchSpectrum(values[order], mode / mode[np.abs(mode).argmax()], nodes)


def follow_patch(simulation: xr.Dataset, settings: ExtractionSettings) -> xr.Dataset:
    """Fastest growth of the frozen patch at every recorded time up to the onset.

    Returns
    -------
    Dataset on ``instant``: ``instant_time`` (s), ``patch_length`` (m), ``growth_rate`` (1/s),
    ``growth_frequency`` (1/s, angular); ``stability_length`` (m) where growth begins, with
    ``stability_length_low`` and ``_high``, NaN where it does not; ``mode_position`` (m) and
    ``mode_amplitude`` of the growing mode there.
    """
    parameters = Parameters.from_json(simulation.attrs["parameters"])
    geometry, mesh, law = parameters.geometry, parameters.mesh, parameters.friction
    grid = Grid(geometry.length, geometry.height, mesh.n_x, mesh.n_y, mesh.grading)
    operator = BodyOperator(Body(grid, parameters.material), 0.0)
    threshold = settings.edge_threshold * parameters.loading.velocity
    rates, states = simulation["slip_rate"].values, simulation["state"].values
    stresses = simulation["normal_stress"].values
    rows, spectra = [], []
    for i in _frames_before_onset(simulation, parameters, settings):
        length = patch_edge(grid.x, rates[i], threshold)
        if length < FEWEST_NODES * grid.dx:
            continue
        spectrum = patch_spectrum(operator, law, rates[i], states[i], stresses[i], threshold)
        fastest = spectrum.eigenvalues[0]
        rows.append((simulation["time"].values[i], length, fastest.real, abs(fastest.imag)))
        spectra.append(spectrum)
    time, length, growth, frequency = np.array(rows).reshape(-1, 4).T
    low, middle, high = crossing(length, growth, grid.dx)
    at = int(np.argmin(np.where(growth > 0, np.abs(length - middle), np.inf))) if rows else 0
    mode = np.zeros(grid.n_x + 1)
    if np.isfinite(middle):
        mode[spectra[at].nodes] = np.abs(spectra[at].slip_mode)
    return xr.Dataset(
        {
            "instant_time": ("instant", time),
            "patch_length": ("instant", length),
            "growth_rate": ("instant", growth),
            "growth_frequency": ("instant", frequency),
            "stability_length": middle,
            "stability_length_low": low,
            "stability_length_high": high,
            "stability_frequency": frequency[at] if np.isfinite(middle) else np.nan,
            "mode_amplitude": ("x", mode),
        },
        coords={"x": grid.x},
        attrs={"parameters": parameters.to_json()},
    )


def _frames_before_onset(
    simulation: xr.Dataset, parameters: Parameters, settings: ExtractionSettings
) -> NDArray[np.intp]:
    steps, force = simulation["step_time"].values, np.abs(simulation["driving_force"].values)
    onset = find_onset(steps, force, WINDOW * parameters.memory_time, settings.drop)
    last = steps[onset.start] if onset is not None else np.inf
    return np.flatnonzero(simulation["time"].values <= last)


def crossing(length: Array, growth: Array, spacing: float) -> tuple[float, float, float]:
    """Patch length where growth turns positive: low, middle and high estimate.

    The front advances by one node at a time, and growth varies within each hop. The middle value
    is where the median over each hop (a length of `spacing`) crosses zero for the first time; the
    low one where growth is positive at all for the first time, the high one where it is positive
    throughout a hop for the first time. NaN where there is none.
    """
    hops = np.floor(length / spacing).astype(int)
    numbers = np.unique(hops)
    centre = np.array([length[hops == n].mean() for n in numbers])
    estimates = []
    for statistic in (np.max, np.median, np.min):
        values = np.array([statistic(growth[hops == n]) for n in numbers])
        first = np.flatnonzero((values[1:] > 0) & (values[:-1] <= 0))
        if first.size == 0:
            estimates.append(float("nan"))
            continue
        i = first[0]
        part = -values[i] / (values[i + 1] - values[i])
        estimates.append(float(centre[i] + part * (centre[i + 1] - centre[i])))
    return estimates[0], estimates[1], estimates[2]


COLUMNS = (
    "id", "study", "law", "height", "phi0", "n_x", "n_y", "stability_length",
    "stability_length_low", "stability_length_high", "stability_frequency", "theory_length",
)  # fmt: skip


def gather(runs: Iterable[dict[str, Any]], patches: Iterable[xr.Dataset]) -> xr.Dataset:
    """The table of runs with the lengths at which their frozen patches turn unstable."""
    rows = [
        description(run) | {name: float(patch[name]) for name in COLUMNS if name in patch}
        for run, patch in zip(runs, patches, strict=True)
    ]
    return xr.Dataset({name: ("run", [row[name] for row in rows]) for name in COLUMNS})
