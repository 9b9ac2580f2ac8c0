"""The oscillating mode of the creeping patch along a quiet run, and how a forcing stirs it.

With the frozen patch of :mod:`.frozen`, the mode's complex amplitude A obeys

    dA/dt = Lambda A + eps g(t) xi,

scaled such that A = 1 where the slip rate swings by V. The left eigenvector gives g: linearised
force balance at the slipping nodes, ``(D + f N) dw + R (f_v dv + f_psi dpsi) + q = 0``, makes of
each kind of forcing (:mod:`nucleation.model.perturbation`)

    normal_load      q = (p_0 + f R_0) eps xi(t), of the forces by which the load acts at fixed w
    drive_velocity   q = -(D + f N) 1 eps V int xi dt, in the frame of the stuck fault
    strength         q = f R eps xi(x)
    state            eps (V/D) xi(x, t) in d(dpsi)/dt

Left out is what freezing leaves out: dl/dt, and the nodes at the front that begin to slip
(docs/patch_stability.md). Either changes growth by some 0.2 1/s, where Re Lambda comes to 3 1/s.
"""

import dataclasses

import numpy as np
import xarray as xr

from ..analysis.definitions import ExtractionSettings
from ..analysis.record import Record, parameters_of
from ..datasets.variables import Variable, annotate
from ..fem.bodies import BodyOperator
from ..model.parameters import Parameters
from ..simulation.recorded import RECORDED
from ..theory.creep.linearised import FrozenPatch
from ..types import Array, ComplexArray
from .frozen import Frames

INSTANTS = 80  # at which the patch is frozen, evenly in length
FROM = 0.6  # they begin at this part of the length at the end of the creep

Loads = tuple[tuple[Array, Array], tuple[Array, Array]]
"""Tangential and normal forces (N/m) at the nodes 0..n_x: of the load at fixed w, of w = 1 m."""


@dataclasses.dataclass(frozen=True)
class ModeHistory:
    """The oscillating mode along a quiet run, on (instant) or (instant, x).

    The weights are those of ``A`` in each kind of forcing, for a mode whose slip rate swings by V.
    """

    parameters: Parameters
    x: Array  # m
    time: Array  # s
    length: Array  # m
    rate: ComplexArray  # Lambda (1/s)
    normal_load: ComplexArray  # g (1/s) of a relative change of the load
    drive: ComplexArray  # g (1/(m s)) of a displacement of the driven edge
    strength: ComplexArray  # g (1/s) of a relative change of friction at each node
    state: ComplexArray  # g (1) of a source in d log(phi)/dt at each node


WEIGHTS = {"normal_load": "instant", "drive": "instant", "strength": "x", "state": "x"}
"""The weights of a history, by what they depend on besides the instant."""

FOLLOWED = {
    "x": RECORDED["x"],
    "mode_time": Variable("s", "time at which the patch is frozen", "t"),
    "mode_length": Variable("m", "length of the creep patch", "L(t)"),
    "mode_rate": Variable("1/s", "growth and angular frequency of the oscillating mode", "Lambda"),
    "mode_normal_load": Variable("1/s", "weight of a relative change of the load", "g"),
    "mode_drive": Variable("1/(m s)", "weight of a displacement of the driven edge", "g"),
    "mode_strength": Variable("1/s", "weight of a relative change of friction at a node", "g"),
    "mode_state": Variable("1", "weight of a source of log(phi) at a node", "g"),
}


def to_dataset(history: ModeHistory) -> xr.Dataset:
    """A history as a dataset, real and imaginary parts on ``part``."""
    data: dict[str, tuple[tuple[str, ...], Array]] = {
        "mode_time": (("instant",), history.time),
        "mode_length": (("instant",), history.length),
    }
    for name, along in {"rate": "instant", **WEIGHTS}.items():
        values = getattr(history, name)
        dims = ("part", "instant", "x") if along == "x" else ("part", "instant")
        data[f"mode_{name}"] = dims, np.array([values.real, values.imag])
    attributes = {"parameters": history.parameters.to_json()}
    found = xr.Dataset(data, coords={"x": history.x}, attrs=attributes)
    return annotate(found, FOLLOWED)


def from_dataset(dataset: xr.Dataset) -> ModeHistory:
    """The inverse of :func:`to_dataset`."""
    weights = {}
    for name in ("rate", *WEIGHTS):
        real, imaginary = dataset[f"mode_{name}"].values
        weights[name] = real + 1j * imaginary
    return ModeHistory(
        parameters_of(dataset), dataset["x"].values, dataset["mode_time"].values,
        dataset["mode_length"].values, **weights,
    )  # fmt: skip


def follow_mode(
    simulation: xr.Dataset, settings: ExtractionSettings = ExtractionSettings()
) -> ModeHistory:
    """The oscillating mode of a quiet run, and how each forcing stirs it.

    It is followed up to one period before the onset, if there is one. Then it swings as much as V,
    and a patch that is frozen in such a swing says nothing about small ones. ValueError if the
    patch has no oscillating mode at any instant.
    """
    record = Record(simulation, settings)
    record.parameters.require_edge("the law of the drop")
    run = Frames(record)
    parameters, time, length = run.parameters, run.time, run.length
    wanted = np.linspace(FROM * length[-1], length[-1], INSTANTS)
    frames = np.unique(np.searchsorted(length, wanted).clip(0, length.size - 1))
    loads = _loads(run.operator, parameters)
    rows = []
    for i in frames:
        patch, pair = run.patch(i)
        if np.isfinite(pair):
            weights = _weights(patch, pair, parameters, run.fields(i), loads)
            rows.append((time[i], length[i], pair, *weights))
    if not rows:
        raise ValueError("the creeping patch has no oscillating mode")
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    if record.onset is not None:
        small = columns[0] <= time[-1] - np.median(2.0 * np.pi / columns[2].imag)
        columns = [column[small] for column in columns]
    return ModeHistory(parameters, run.grid.x, *columns)


def _loads(operator: BodyOperator, parameters: Parameters) -> Loads:
    n, load = operator.body.grid.n_x, operator.body.top_load(parameters.loading.normal_stress)
    at_rest, (tangential, normal) = operator.respond(load, np.zeros(n)), operator.apply(np.ones(n))
    shift = np.append(0.0, tangential), normal
    return (np.append(0.0, at_rest.tangential), at_rest.normal), shift


def _weights(
    patch: FrozenPatch, rate: complex, parameters: Parameters, fields: tuple[Array, Array, Array],
    loads: Loads,
) -> tuple[complex, complex, ComplexArray, ComplexArray]:  # fmt: skip
    """The weights of a :class:`ModeHistory` at one instant, from the fields at all nodes."""
    n, nodes = patch.nodes.size, patch.nodes
    v, phi, force = (field[nodes] for field in fields)
    law = parameters.friction
    f, (f_v, _) = law.coefficient(v, phi), law.derivatives(v, phi)
    # a mode of largest displacement 1 and its conjugate swing the slip rate by 2 |Lambda|
    left = 2.0 * abs(rate) / parameters.loading.velocity * patch.amplitude(rate)
    by_rate = left[:n] + patch.evolution_by_rate * left[n:]  # of what is added to dv
    by_force = -by_rate / (force * f_v)
    along_x = np.zeros((2, parameters.mesh.n_x + 1), dtype=complex)
    along_x[0, nodes], along_x[1, nodes] = by_force * f * force, left[n:]
    load, shift = (p[nodes] + f * normal[nodes] for p, normal in loads)
    return complex(by_force @ load), complex(-by_force @ shift), along_x[0], along_x[1]


def of_run(simulation: xr.Dataset, settings: ExtractionSettings) -> xr.Dataset:
    """The step ``mode``: the history of a quiet run's mode as a dataset."""
    return to_dataset(follow_mode(simulation, settings))
