"""What a fault is beside its numbers, in words: second body, friction law, evolution."""

from __future__ import annotations

import numpy as np

from ..model.friction.constants import LAW
from ..theory.values import QUANTITIES, FaultLike


def second_body(fault: FaultLike) -> str:
    """What the first body slides on."""
    if np.all(np.isinf(fault.second_shear_modulus)):
        return "Second body: rigid."
    names = [name for name in QUANTITIES if name.startswith("second_")]
    pairs = [(getattr(fault, name), getattr(fault, name[len("second_") :])) for name in names]
    alike = all(np.array_equal(one, other) for one, other in pairs)
    return f"Second body: deformable, like the first{'' if alike else ' in all else'}."


def friction(fault: FaultLike) -> str:
    """The friction law, and the evolution of its state."""
    if fault.friction_law is not None:
        law = fault.friction_law.law
    elif fault.velocity is None or fault.friction is None:
        law = "none, a and b are constant"
    else:
        law = f"{LAW}, with the fault's a, b and f at V; L_c takes a and b alone"
    return f"Friction law: {law}; evolution: {fault.evolution}."
