"""The rounded friction of the paper's main text, with which its theory was computed."""

import math
from typing import Any

from nucleation.fault import Fault


def main_text(fault: Fault) -> Fault:
    """A fault with f, a and zeta rounded to two digits and constant, as in the main text."""
    rounded = {name: float(f"{fault.single(name):.2g}") for name in ("friction", "a", "zeta")}
    kept = {"slip_distance": fault.slip_distance, "evolution": fault.evolution}
    return fault.replace(**rounded, **kept, friction_law=None)


def on_rigid_base(fault: Fault, height: Any) -> Fault:
    """Blocks of heights (m) with a fault's material and friction, free on top, on a rigid base."""
    return fault.replace(second_shear_modulus=math.inf, far_side="traction", height=height)
