"""The length at which the creep patch of a simulation turns linearly unstable, free of its noise.

The paper replaces the patch by homogeneous sliding. Here friction, state and the static elastic
response of the block are linearised about the fields of the simulation at one instant: the patch is
frozen. For perturbations of the displacement w and of psi = log(phi) at the slipping nodes, force
balance reads (p = -f R at each node, R the nodal normal force)

    (D + f N) dw + R (f_v dv + f_psi dpsi) = 0,      d(dw)/dt = dv,
    d(dpsi)/dt = g_v dv + g_psi dpsi,

with the condensed static operators D (tangential) and N (normal stress coupling) of the finite
elements and the evolution law ``dpsi/dt = g(v, psi)``. Eliminating dv leaves the eigenvalue problem
of :mod:`nucleation.theory.creep.linearised`, of twice the number of slipping nodes.

Growth begins where the first of the patch's modes stops decaying; that mode oscillates there
(:mod:`nucleation.theory.creep.lengths`). Each instant of a run needs the spectrum of a dense
matrix, and a run has some hundred of them. So a few instants, spaced evenly in patch length, give
the rough crossing by the fastest growing mode. A line through the oscillating mode at the instants
around it gives the length.
"""

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..datasets.variables import Column, annotate, columns
from ..model.friction import Friction
from ..run.run import Run
from ..simulation import recorded
from ..simulation.event import NEAR as NEAR_EDGE
from ..theory.creep.linearised import OSCILLATING, FrozenPatch, log_state_derivatives
from ..types import Array, ComplexArray
from .definitions import FITTED, ExtractionSettings
from .extraction import Record

if TYPE_CHECKING:
    from ..fem.operator import Operator

FEWEST_NODES = 8  # a shorter patch is not resolved
SCANNED = 40  # instants that give the rough crossing
NEAR = 60  # instants around it, at most, to which the line is fitted
AROUND = 0.08  # their range of lengths, to either side, over the crossing's length
REFITS = 2  # the second is about the crossing of the first
FEWEST_NEAR = 4  # instants for a line

FOLLOWED = {
    **columns(
        Column("growth_frequency", "1/s", "angular frequency of that mode", "|Im Lambda|"),
        recorded.X,
        Column("instant_time", "s", "time at which the patch is frozen", "t"),
        Column("patch_length", "m", "length of the creep patch", "L(t)"),
        Column("growth_rate", "1/s", "fastest growth of the frozen patch", "max Re Lambda"),
        Column("oscillation_growth", "1/s", "growth of the patch's oscillating mode", "Re Lambda"),
        Column("oscillation_frequency", "1/s", "angular frequency of that mode", "Im Lambda"),
        Column("mode_real", "1", "slip in that mode where growth begins, real part"),
        Column("mode_imaginary", "1", "slip in that mode where growth begins, imaginary part"),
    ),
    **FITTED,
}


def frozen_patch(
    operator: "Operator",
    law: Friction,
    slip_rate: Array,
    state: Array,
    normal_force: Array,
    slowest: float,
) -> FrozenPatch:
    """Linearise a patch about fields at the nodes 0..n_x, at those that slip.

    The operator is the static one; the law's parameters may vary along the interface; fields are in
    m/s, s and N/m (positive in compression); nodes below the `slowest` slip rate (m/s) are stuck.
    """
    grid = operator.body.grid
    slipping = slip_rate > slowest
    if not grid.periodic:
        slipping &= grid.x <= NEAR_EDGE * grid.length
    nodes = np.flatnonzero(slipping[1:]) + 1  # node 0 is driven, or repeats another
    v, phi, force = slip_rate[nodes], state[nodes], normal_force[nodes]
    varying = {name: value[nodes] for name, value in vars(law).items() if np.ndim(value)}
    own_law = law.along_x(**varying)
    f = own_law.coefficient(v, phi)
    f_v, f_phi = own_law.derivatives(v, phi)
    g_v, g_psi = log_state_derivatives(own_law, v, phi)
    stiffness, coupling = operator.tangent(nodes)
    by_force = (f_v * force)[:, None]
    return FrozenPatch(
        nodes=nodes,
        by_w=-(stiffness + f[:, None] * coupling) / by_force,
        by_log_state=-f_phi * phi / f_v,
        evolution_by_rate=g_v,
        evolution_by_log_state=g_psi,
    )


Freezer = Callable[[Array, Array, Array], tuple[FrozenPatch, complex]]
"""Function of slip rates, states and normal forces (m/s, s, N/m) at the nodes 0..n_x. It returns
the frozen patch and the eigenvalue (1/s) of its fastest growing oscillating mode, or NaN."""


def freezer(run: Run, threshold: float) -> Freezer:
    """The function that freezes patches of a run, nodes slower than a threshold (m/s) being stuck.

    A mode oscillates by the scale V/D of its frequency; without an edge that moves at V the scale
    is v/D of the patch itself.
    """
    from ..fem.operator import Operator
    from ..simulation.start import body_of, interface_of

    body = body_of(run)
    operator = Operator(body, 0.0)
    law = interface_of(run, body.grid).friction

    def frozen(slip_rate: Array, state: Array, normal_force: Array) -> tuple[FrozenPatch, complex]:
        patch = frozen_patch(operator, law, slip_rate, state, normal_force, threshold)
        rate_over_v = 1.0
        if run.fault.loading != "edge":
            rate_over_v = float(slip_rate.max()) / run.fault.velocity
        return patch, patch.oscillating(rate_over_v * OSCILLATING / run.memory_time)

    return frozen


def follow_patch(simulation: xr.Dataset, settings: ExtractionSettings) -> xr.Dataset:
    """Growth of the frozen patch along a run up to its onset, and the length where it begins.

    Parameters
    ----------
    simulation : Dataset
        Record of a run.
    settings : ExtractionSettings
        Definitions of the onset and of the patch's length.

    Returns
    -------
    Dataset
        The variables :data:`FOLLOWED`: patches on ``instant``, the mode where growth begins on
        ``x``. NaN where no mode oscillates, and where growth does not begin.
    """
    from ..simulation.start import grid_of

    record = Record(simulation, settings)
    creep, length = record.creep, record.lengths[record.creep]
    slip_rate, state = (simulation[name].values[creep] for name in ("slip_rate", "state"))
    frozen = freezer(record.run, record.threshold)
    grid = grid_of(record.run.upper, record.run.fault.loading == "remote")
    force = -simulation["sigma_yy"].values[creep] * grid.nodal_lengths
    known: dict[int, tuple[FrozenPatch, complex]] = {}  # with the oscillating mode, by frame

    def rates(frames: Iterable[int]) -> tuple[ComplexArray, ComplexArray]:
        found = []
        for frame in frames:
            if frame not in known:
                known[frame] = frozen(slip_rate[frame], state[frame], force[frame])
            patch, pair = known[frame]
            fastest = patch.eigenvalues[0] if patch.nodes.size else complex(np.nan, np.nan)
            found.append((fastest, pair))
        both = np.array(found, dtype=complex).reshape(-1, 2)
        return both[:, 0], both[:, 1]

    frames = np.flatnonzero(length >= FEWEST_NODES * grid.dx)
    fit, nearest = beginning_of_growth(frames, length, rates)
    mode = np.zeros(grid.n_x + 1, dtype=complex)
    if nearest is not None:
        patch, pair = known[nearest]
        mode[patch.nodes], _ = patch.mode(pair)
    instants = sorted(known)
    fastest, oscillating = rates(instants)
    found = xr.Dataset(
        {
            "instant_time": ("instant", record.time[creep][instants]),
            "patch_length": ("instant", length[instants]),
            "growth_rate": ("instant", fastest.real),
            "growth_frequency": ("instant", np.abs(fastest.imag)),
            "oscillation_growth": ("instant", oscillating.real),
            "oscillation_frequency": ("instant", oscillating.imag),
            **fit,
            "mode_real": ("x", mode.real),
            "mode_imaginary": ("x", mode.imag),
        },
        coords={"x": grid.x},
        attrs={"parameters": record.run.to_json()},
    )
    return annotate(found, FOLLOWED)


def beginning_of_growth(
    frames: NDArray[np.intp],
    length: Array,
    rates: Callable[[Iterable[int]], tuple[ComplexArray, ComplexArray]],
) -> tuple[dict[str, float], int | None]:
    """Values of :data:`FITTED`, and the frame nearest to where growth begins, None if it does not.

    `rates` gives eigenvalues (1/s) of frames: the fastest growing and the oscillating mode's.
    """
    scanned = evenly(frames, length, SCANNED)
    fastest, _ = rates(scanned)
    crossing = rough_crossing(length[scanned], fastest.real)
    fit = dict.fromkeys(FITTED, float("nan"))
    near = frames
    for _ in range(REFITS):
        if np.isfinite(crossing):
            near = frames[np.abs(length[frames] / crossing - 1.0) < AROUND]
            near = evenly(near, length, NEAR)
            _, oscillating = rates(near)
            fit = fitted_crossing(length[near], oscillating)
            crossing = fit["stability_length"]
    if not np.isfinite(crossing):
        return fit, None
    return fit, int(near[np.abs(length[near] - crossing).argmin()])


def evenly(frames: NDArray[np.intp], length: Array, number: int) -> NDArray[np.intp]:
    """At most a number of rising frames, spaced evenly in patch length (m at each frame)."""
    if frames.size <= number:
        return frames
    lengths = length[frames]
    wanted = np.linspace(lengths[0], lengths[-1], number)
    nearest = np.searchsorted(lengths, wanted)
    nearest = nearest.clip(0, frames.size - 1)
    return frames[np.unique(nearest)]


def rough_crossing(length: Array, growth: Array) -> float:
    """Patch length (m) that best divides decay from growth (1/s), NaN without either.

    The range of lengths with the wrong sign is the least possible: on a coarse mesh the growth rate
    fluctuates as the front moves from node to node.
    """
    usable = np.isfinite(growth)
    length, growth = length[usable], growth[usable]
    if length.size < FEWEST_NEAR or growth.max() <= 0.0 or growth.min() > 0.0:
        return float("nan")
    ranges = np.gradient(length) * np.sign(growth)
    wrong = np.append(0.0, np.cumsum(ranges))  # less the same constant for each division
    at = int(wrong.argmin())
    if at == 0:
        return float("nan")
    return float(length[min(at, length.size - 1)])


def fitted_crossing(length: Array, growth: ComplexArray) -> dict[str, float]:
    """Values of :data:`FITTED`: where a line through eigenvalues (1/s) over patch length (m) is 0.

    The front advances by one node at a time, and growth varies within each hop. The scatter about
    the line over its slope gives the range of lengths at which growth may begin. Values are NaN if
    the line does not cross zero within the lengths.
    """
    none = dict.fromkeys(FITTED, float("nan"))
    usable = np.isfinite(growth)
    length, growth = length[usable], growth[usable]
    if length.size < FEWEST_NEAR:
        return none
    centre = length.mean()
    offset = length - centre
    slope, level = np.polyfit(offset, growth.real, 1)
    if slope <= 0.0:
        return none
    crossing = centre - level / slope
    if not length.min() <= crossing <= length.max():
        return none
    turn, frequency = np.polyfit(offset, growth.imag, 1)
    misfit = growth.real - level - slope * offset
    scatter = np.std(misfit, ddof=2) / slope
    lever = np.hypot(1.0, (crossing - centre) / length.std())
    return {
        "stability_length": float(crossing),
        "stability_length_low": float(crossing - scatter),
        "stability_length_high": float(crossing + scatter),
        "stability_length_error": float(scatter * lever / np.sqrt(length.size)),
        "stability_frequency": float(frequency + turn * (crossing - centre)),
    }
