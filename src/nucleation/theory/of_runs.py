"""The linear theory's systems of simulated faults, from the parameters of runs."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..model.linearised import InterfaceState
from ..model.material import ANTIPLANE, Material
from ..model.parameters import Parameters
from .pair import LayerPair
from .spectrum import Systems
from .stiffness import Array, Layers

Case = tuple[Parameters, InterfaceState]
"""A run, and its friction linearised about steady sliding."""


def far_sides(parameters: Parameters) -> tuple[str, str]:
    """Boundary conditions on the far sides of the first and the second body of a run.

    That of the first body bears a given stress. A rigid second body is ``rigid``.
    """
    below = parameters.below
    return "free", "rigid" if below is None else below.far_side


def fault_of_run(parameters: Parameters) -> dict[str, Any]:
    """The fault of a run, as keywords of :class:`~nucleation.fault.fault.Fault`, in SI units.

    f, a and zeta are those of the friction law about V. With another loading than ``edge`` a and b
    are constant along the creeping patch, so that the law is left out.
    """
    material, loading, law = parameters.material, parameters.loading, parameters.friction
    far_side, second_far_side = far_sides(parameters)
    friction, a, zeta = law.expansion(loading.velocity)
    found: dict[str, Any] = {
        "shear_modulus": material.shear_modulus,
        "poisson_ratio": material.poisson_ratio,
        "plane": material.plane,
        "height": parameters.geometry.height,
        "far_side": far_side,
        "normal_stress": loading.normal_stress,
        "velocity": loading.velocity,
        "slip_distance": law.slip_distance,
        "friction": friction,
        "a": a,
        "zeta": zeta,
        "loading": loading.kind,
        "evolution": law.evolution,
    }
    if loading.kind == "edge":
        found["friction_law"] = law
    below = parameters.below
    if below is None:
        return found | {"second_shear_modulus": math.inf}
    return found | {
        "second_shear_modulus": below.material.shear_modulus,
        "second_poisson_ratio": below.material.poisson_ratio,
        "second_height": below.geometry.height,
        "second_far_side": second_far_side,
    }


def pair_of(runs: Sequence[Parameters]) -> LayerPair:
    """The bodies of runs, which have the same far sides and the same plane.

    Parameters
    ----------
    runs : sequence of Parameters
        At least one run.

    Returns
    -------
    LayerPair
        With fields of shape (runs,).
    """
    first, second = far_sides(runs[0])
    upper = [(run.material, run.geometry.height) for run in runs]
    lower = []
    for run in runs:
        if run.below is not None:
            lower.append((run.below.material, run.below.geometry.height))
    return LayerPair(_layers(upper, first), _layers(lower, second) if lower else None)


def _layers(
    bodies: Sequence[tuple[Material, float]],
    far_side: str,
) -> Layers:
    """Layers of materials and heights (m), with fields of shape (bodies,)."""
    materials = [material for material, _ in bodies]
    return Layers(
        shear_modulus=np.array([material.shear_modulus for material in materials]),
        poisson_ratio=np.array([material.in_plane_ratio for material in materials]),
        height=np.array([height for _, height in bodies], dtype=float),
        far_side=far_side,
        antiplane=materials[0].plane == ANTIPLANE,
    )


def systems_of(cases: Sequence[Case]) -> Systems:
    """Systems of runs with the same far sides and the same plane; fields of shape (runs,)."""
    interfaces = [interface for _, interface in cases]
    return _systems(pair_of([run for run, _ in cases]), interfaces)


def blocks_on_rigid_base(
    material: Material,
    heights: Array,
    interface: InterfaceState,
) -> Systems:
    """The paper's system: a block that is free of changes of stress on top, on a rigid base.

    Parameters
    ----------
    material : Material
        Of the block.
    heights : ndarray
        H (m) of one block or many, shape (n,); inf for a half-space.
    interface : InterfaceState
        Friction linearised about steady sliding.

    Returns
    -------
    Systems
        With fields of shape (n,).
    """
    upper = _layers([(material, height) for height in heights], "traction")
    return _systems(LayerPair(upper, None), [interface] * len(heights))


def _systems(
    pair: LayerPair,
    interfaces: Sequence[InterfaceState],
) -> Systems:
    slip_length = np.array([interface.slip_length for interface in interfaces])
    normal_stress = np.array([interface.normal_stress for interface in interfaces])
    velocity = np.array([interface.velocity for interface in interfaces])
    return Systems(
        pair=pair,
        friction=np.array([interface.friction for interface in interfaces]),
        a=np.array([interface.a for interface in interfaces]),
        zeta=np.array([interface.zeta for interface in interfaces]),
        softness=pair.modulus * slip_length / normal_stress,
        rate=velocity / slip_length,
    )
