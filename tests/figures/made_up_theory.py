"""A theory's curve for figures that are drawn from made-up data."""

import numpy as np


def critical_length(height):
    """A plausible ``L_c(H)``: the thin limit at first, 0.9 m for a half-space."""
    return 1.0 / np.sqrt(1.0 / (11.5 * height) + 1.0 / 0.9**2)
