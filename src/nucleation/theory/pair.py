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

from ..types import Array
from .stiffness import SATURATION, Stiffness, Waves, layer_stiffness, stiffness_with_zone, waves

BOTH_RIGID = "at least one of the two bodies must be deformable"


def rounded(numbers: Array, bits: int) -> Array:
    """The nearest numbers with as many bits."""
    mantissa, exponent = np.frexp(numbers)
    return np.asarray(np.ldexp(np.rint(np.ldexp(mantissa, bits)), exponent - bits))


class Layers(NamedTuple):
    """One elastic body or many with the same boundary condition; fields broadcast with k.

    A zone is a layer of another material between the interface and the body.
    """

    shear_modulus: Array  # mu (Pa)
    poisson_ratio: Array
    height: Array  # H (m), inf for a half-space, without the zone
    far_side: str  # one of stiffness.FAR_SIDES
    antiplane: bool = False  # slip is along z, and Poisson's ratio does not matter
    zone: Layers | None = None

    @property
    def zone_ratio(self) -> Array:
        """Shear modulus of the body over that of its zone, or 1."""
        own = self.shear_modulus
        return own / (own if self.zone is None else self.zone.shear_modulus)

    def at(self, index: NDArray) -> Layers:
        """The bodies of an index or a mask."""
        return self._replace(
            shear_modulus=self.shear_modulus[index],
            poisson_ratio=self.poisson_ratio[index],
            height=self.height[index],
            zone=self.zone and self.zone.at(index),
        )

    def with_heights(self, heights: Callable[[Array], Array]) -> Layers:
        """The bodies with other heights and thicknesses (m), a function of the present ones."""
        zone = self.zone and self.zone.with_heights(heights)
        return self._replace(height=heights(self.height), zone=zone)

    def over(self, length: Array, modulus: Array, bits: int) -> Layers:
        """The bodies with heights over a length (m) and moduli over another (Pa), rounded."""
        with np.errstate(over="ignore"):  # of the highest bodies, which become half-spaces
            height = rounded(self.height / length, bits)
        return self._replace(
            shear_modulus=rounded(self.shear_modulus / modulus, bits),
            height=height,
            zone=self.zone and self.zone.over(length, modulus, bits),
        )

    def with_zone_at_least(self, thickness: float) -> Layers:
        """The body with its zone, or with one of a thickness (m) that resists long waves alike.

        A soft zone adds ``h (1/mu_zone - 1/mu)`` to the compliance, a stiff one ``h (mu_zone -
        mu)`` to the resistance against stretching. The thicker zone adds as much, its Poisson's
        ratio is between both likewise, and the body becomes lower by as much as the zone becomes
        thicker.
        """
        if self.zone is None:
            return self
        ratio, height = self.zone_ratio, self.zone.height
        slimmer = height < thickness
        share = np.where(slimmer, height / thickness, 1.0)
        soft = 1.0 / (1.0 - share + share * ratio)
        stiff = 1.0 - share + share / ratio
        modulus = self.shear_modulus * np.where(ratio > 1.0, soft, stiff)
        nu = self.poisson_ratio + share * (self.zone.poisson_ratio - self.poisson_ratio)
        # neither too low for the zone nor lower than the thickness itself
        room = np.maximum(self.height - thickness, 0.0)
        added = np.minimum(np.minimum(thickness - height, 0.5 * self.height), room)
        changed = self.zone._replace(
            height=np.where(slimmer, thickness, height),
            shear_modulus=np.where(slimmer, modulus, self.zone.shear_modulus),
            poisson_ratio=np.where(slimmer, nu, self.zone.poisson_ratio),
        )
        return self._replace(height=self.height - np.where(slimmer, added, 0.0), zone=changed)

    def _waves(self, wavenumber: ArrayLike) -> Waves:
        """Functions of ``q = |k| H``, cut at SATURATION, above which none of them changes."""
        k = np.abs(np.asarray(wavenumber, dtype=float))
        with np.errstate(over="ignore"):  # of the highest bodies
            return waves(np.minimum(k * self.height, SATURATION))

    def stiffness(self, wavenumber: ArrayLike) -> Stiffness:
        """Dimensionless stiffness A at a wavenumber (1/m), over the body's modulus."""
        functions, nu = self._waves(wavenumber), self.poisson_ratio
        own = layer_stiffness(functions, nu, self.far_side, self.antiplane)
        if self.zone is None:
            return own
        functions, nu = self.zone._waves(wavenumber), self.zone.poisson_ratio
        return stiffness_with_zone(functions, nu, self.antiplane, own, self.zone_ratio)


class LayerPair(NamedTuple):
    """The bodies above and below the interface, one pair or many; None is a rigid body."""

    upper: Layers | None
    lower: Layers | None

    @property
    def deformable(self) -> list[Layers]:
        """The bodies that are not rigid; a ValueError if both are."""
        bodies = [body for body in self if body is not None]
        if not bodies:
            raise ValueError(BOTH_RIGID)
        return bodies

    @property
    def modulus(self) -> Array:
        """Shear modulus (Pa) by which G1 and G2 are normalised, of the first deformable body."""
        return self.deformable[0].shear_modulus

    @property
    def mirrored(self) -> Array:
        """Whether slip changes no normal stress: bodies that are mirror images, or antiplane."""
        one = self.deformable[0]
        alike = np.full(one.height.shape, one.antiplane)
        if self.upper is None or self.lower is None:
            return alike
        if self.upper.far_side != self.lower.far_side:
            return alike
        same = [
            getattr(self.upper, name) == getattr(self.lower, name)
            for name in ("shear_modulus", "poisson_ratio", "height")
        ]
        return alike | np.logical_and.reduce(same)

    def over(self, length: Array, bits: int) -> LayerPair:
        """The pairs with heights over a length (m) and moduli over :attr:`modulus`, rounded."""
        return LayerPair(*(body and body.over(length, self.modulus, bits) for body in self))

    @property
    def without_zones(self) -> LayerPair:
        """The pair without zones beside the interface."""
        return LayerPair(*(body and body._replace(zone=None) for body in self))

    @property
    def thicknesses(self) -> list[Array]:
        """Heights (m) of the bodies that are not rigid, and thicknesses of their zones."""
        layers = [layer for body in self.deformable for layer in (body.zone, body)]
        return [layer.height for layer in layers if layer is not None]

    def at(self, index: NDArray) -> LayerPair:
        """The pairs of an index or a mask."""
        return LayerPair(*(body and body.at(index) for body in self))

    def with_heights(self, heights: Callable[[Array], Array]) -> LayerPair:
        """The pair with other heights and thicknesses (m), a function of the present ones."""
        return LayerPair(*(body and body.with_heights(heights) for body in self))

    def stiffness(self, wavenumber: ArrayLike) -> Stiffness:
        """``(A^-1 + B^-1)^-1`` over :attr:`modulus` at a wavenumber (1/m).

        B is that of the lower body, mirrored. The result's ``xy`` has the sign of the upper body's;
        its subtraction vanishes exactly for mirror-symmetric pairs.
        """
        if self.upper is None or self.lower is None:
            (body,) = self.deformable
            own = body.stiffness(wavenumber)
            return own._replace(xy=-own.xy) if self.upper is None else own
        a, b = self.upper.stiffness(wavenumber), self.lower.stiffness(wavenumber)
        r = self.lower.shear_modulus / self.upper.shear_modulus
        mixed = a.xx * b.yy + a.yy * b.xx + 2.0 * a.xy * b.xy
        joint = a.det + r * mixed + r**2 * b.det
        share_a = r**2 * b.det / joint
        share_b = r * a.det / joint
        return Stiffness(
            xx=share_a * a.xx + share_b * b.xx,
            xy=share_a * a.xy - share_b * b.xy,
            yy=share_a * a.yy + share_b * b.yy,
            det=share_b * r * b.det,
        )

    def transfer_functions(self, wavenumber: Array) -> tuple[Array, Array]:
        """G1 and G2 at wavenumbers (1/m) of either sign."""
        found = self.stiffness(wavenumber)
        return np.sign(wavenumber) * found.xx, found.xy
