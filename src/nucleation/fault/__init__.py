"""A fault: its parameters, and every answer about it as a method; the paper's fault."""

import math

from ..model.friction import Friction
from .fault import Fault

__all__ = ["PAPER", "Fault"]

PAPER = Fault(
    shear_modulus=3.1e9,
    poisson_ratio=1.0 / 3.0,
    density=1200.0,
    height=0.005,
    second_shear_modulus=math.inf,
    normal_stress=1.0e6,
    velocity=1.0e-5,
    friction_law=Friction(law="product"),
    initial_state=1.0,
)
"""The fault of Aldam et al. (2017): a block of PMMA on a rigid base, with its friction law.

It has the lowest block; ``PAPER.replace(height="5cm")``.
"""
