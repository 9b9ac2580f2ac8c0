"""Two bodies beside the interface: their stiffnesses in series, and the transfer functions.

All fields vary as ``exp(Lambda t - i k x)`` (Text S1.1). The upper body occupies ``0 < y < H1``,
the lower one, mirrored, ``-H2 < y < 0``: its ``-A_xy`` changes sign. A pair that slides without
opening by ``deps`` has ``dsigma_xy = -mu k G1 deps`` and ``dsigma_yy = i mu k G2 deps``. Both
stiffnesses act in series, for 2x2 matrices without a subtraction in the diagonal entries, also
where a free body translates as a whole:

    (A^-1 + B^-1)^-1 = (det(B) A + det(A) B) / det(A + B) .
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .stiffness import Array, Layers, Stiffness
from .zone import Zone

BOTH_RIGID = "at least one of the two bodies must be deformable"


class LayerPair(NamedTuple):
    """The bodies above and below the interface, one pair or many; None is a rigid body."""

    upper: Layers | Zone | None
    lower: Layers | Zone | None

    @property
    def deformable(self) -> list[Layers | Zone]:
        """The bodies that are not rigid.

        Raises
        ------
        ValueError
            If both are rigid.
        """
        bodies = [body for body in self if body is not None]
        if not bodies:
            raise ValueError(BOTH_RIGID)
        return bodies

    @property
    def modulus(self) -> Array:
        """Shear modulus (Pa) by which G1 and G2 are normalised, of the first deformable body."""
        return self.deformable[0].shear_modulus

    @property
    def thicknesses(self) -> list[Array]:
        """Heights (m) of the bodies that are not rigid, and thicknesses of their zones."""
        return [thickness for body in self.deformable for thickness in body.thicknesses]

    @property
    def contrast(self) -> Array | float:
        """The greatest contrast of a zone with its body, the softer over the stiffer modulus."""
        first, *second = [body.contrast for body in self.deformable]
        return np.minimum(first, second[0]) if second else first

    @property
    def ratio(self) -> Array | float:
        """``mu2/mu1``; 1 if a body is rigid."""
        if self.upper is None or self.lower is None:
            return 1.0
        return self.lower.shear_modulus / self.upper.shear_modulus

    def at(self, index: NDArray) -> LayerPair:
        """The pairs of an index or a mask."""
        return LayerPair(*(body and body.at(index) for body in self))

    def with_heights(self, heights: Callable[[Array], Array]) -> LayerPair:
        """The pair with other heights and thicknesses (m), a function of the present ones."""
        return LayerPair(*(body and body.with_heights(heights) for body in self))

    def with_zones_at_least(self, thickness: float) -> LayerPair:
        """The pair with zones of at least a thickness (m), which resist long waves alike."""
        return LayerPair(*(body and body.with_zone_at_least(thickness) for body in self))

    def stiffness(self, wavenumber: ArrayLike) -> Stiffness:
        """Stiffness of the pair in series, over :attr:`modulus`, at a wavenumber (1/m)."""
        upper, lower = (body and body.stiffness(wavenumber) for body in self)
        return _series_stiffness(upper, lower, self.ratio)

    def transfer_functions(self, wavenumber: Array) -> tuple[Array, Array]:
        """G1 and G2 at wavenumbers (1/m) of either sign."""
        found = self.stiffness(wavenumber)
        return np.sign(wavenumber) * found.xx, found.xy


def _series_stiffness(
    upper: Stiffness | None,
    lower: Stiffness | None,
    ratio: Array | float,
) -> Stiffness:
    """``(A^-1 + B^-1)^-1`` of the upper stiffness A and ``ratio`` times the lower one, mirrored.

    None is a rigid body. The result's ``xy`` has the sign of the upper body's; its subtraction
    vanishes exactly for mirror-symmetric pairs.
    """
    if lower is None:
        if upper is None:
            raise ValueError(BOTH_RIGID)
        return upper
    if upper is None:
        return lower._replace(xy=-lower.xy)
    a, b, r = upper, lower, ratio
    mixed = a.xx * b.yy + a.yy * b.xx + 2.0 * a.xy * b.xy
    joint = a.det + r * mixed + r**2 * b.det
    share_a = r**2 * b.det / joint
    share_b = r * a.det / joint
    return Stiffness(
        xx=share_a * a.xx + share_b * b.xx,
        xy=share_a * a.xy - share_b * b.xy,
        yy=share_a * a.yy + share_b * b.yy,
        det=a.det * r**2 * b.det / joint,
    )
