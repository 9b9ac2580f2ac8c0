"""Rubin and Ampuero's expanding zone at a finite slip rate, for lengths of simulated runs."""

from __future__ import annotations

import numpy as np

from ..theory.values import FaultLike, Numbers
from .formulas import nan0, valid
from .in_use import LENGTHS, values_of
from .length import number


def expanding_length(
    fault: FaultLike,
    slip_rate: float | Numbers,
    far_slip_rate: float | Numbers,
    far_state_ratio: float | Numbers,
) -> Numbers:
    """Length (m) of Rubin and Ampuero's expanding zone at a finite slip rate.

    Takes slip_rate (m/s), far_slip_rate (m/s). Returns: The full length (m); NaN outside ``1/2 <
    a/b < 1``, where the slip rate does not exceed the one far ahead, and where the stress does not
    drop.

    Rubin and Ampuero (2005), with ``w = log(v/v_far)``:

        (2 L_b/pi) [(w + log W)/((1 - a/b) w + log W)]^2

    At the tip the strength decreases by ``b sigma0 (w + log W)`` over ``w + log W`` slip distances
    D; within the zone the stress decreases by ``sigma0 [(b - a) w + b log W]``. For ``W = 1``, and
    for any W in the limit of infinite slip rate, the length is that of ``rubin_ampuero_crack``.
    """
    (unbounded,) = (length for length in LENGTHS if length.key == "rubin_ampuero_crack")
    asymptote = values_of(fault, lengths=[unbounded])["rubin_ampuero_crack"]
    acceleration = np.log(slip_rate / far_slip_rate)
    weakening = number(fault, "zeta") / nan0(number(fault, "b"))
    strength_drop = acceleration + np.log(far_state_ratio)
    stress_drop = weakening * acceleration + np.log(far_state_ratio)
    length = asymptote * (weakening * strength_drop / nan0(stress_drop)) ** 2
    return valid((acceleration > 0.0) & (stress_drop > 0.0), length)
