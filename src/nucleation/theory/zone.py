"""Stiffness of a body with a layer of another material beside the interface.

The layer ``0 < y < h``, a zone of gouge or of damaged rock, is bonded to the body behind it. Let B
be the body's stiffness over the layer's modulus, and let P and Q be the layer's own for
displacements of its near and its far face. Then the stiffness of both together is

    C = P - Q (P + B)^-1 Q .

As a quotient of determinants each entry of C is linear in ``B_xx``, ``B_yy``, ``B_xy`` and det B:
numerators and the denominator of C are the sum of those of a free layer, of layers with the far
sides ``velocity``, ``roller`` and ``clamped`` times ``(1 - nu) B_xx``, ``(1 - nu) B_yy`` and
``det B/2``, and of :func:`_mixed_terms` times ``B_xy``. Every other term is positive. So C is
accurate from ``kh -> 0``, where it is that of the body, to thick layers, which hide the body. In
antiplane shear it is the sum of a free layer and a held one times ``B_xx``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .stiffness import FAR_SIDES, Array, Layers, Stiffness, StiffnessTerms, antiplane_terms
from .waves import Waves


class Zone(NamedTuple):
    """A layer beside the interface and the body behind it; one or many, fields broadcast."""

    layer: Layers  # the zone; its far side is the body
    body: Layers

    @property
    def shear_modulus(self) -> Array:
        """mu (Pa) of the body, over which the stiffness is normalised."""
        return self.body.shear_modulus

    @property
    def height(self) -> Array:
        """Height (m) of the body, without the zone."""
        return self.body.height

    @property
    def far_side(self) -> str:
        """The body's far side."""
        return self.body.far_side

    @property
    def ratio(self) -> Array:
        """Shear modulus of the body over that of the zone."""
        return self.body.shear_modulus / self.layer.shear_modulus

    @property
    def thicknesses(self) -> list[Array]:
        """Thicknesses (m) of the zone and of the body."""
        return [self.layer.height, self.body.height]

    @property
    def contrast(self) -> Array:
        """The smaller of the two shear moduli over the larger one."""
        return np.minimum(self.ratio, 1.0 / self.ratio)

    def at(self, index: NDArray) -> Zone:
        """The zones and bodies of an index or a mask."""
        return Zone(self.layer.at(index), self.body.at(index))

    def with_heights(self, heights: Callable[[Array], Array]) -> Zone:
        """The same with other thicknesses (m), a function of the present ones."""
        return Zone(self.layer.with_heights(heights), self.body.with_heights(heights))

    def with_zone_at_least(self, thickness: float) -> Zone:
        """The body with its zone, or with one of a thickness (m) that resists long waves alike.

        A soft zone adds ``h (1/mu_zone - 1/mu)`` to the compliance, a stiff one ``h (mu_zone -
        mu)`` to the resistance against stretching. The thicker zone adds as much, and the body
        becomes lower by as much as the zone becomes thicker.
        """
        layer = self.layer
        thick = np.maximum(layer.height, thickness)
        share = layer.height / thick
        soft = 1.0 / (1.0 + share * (self.ratio - 1.0))
        stiff = 1.0 + share * (1.0 / self.ratio - 1.0)
        changed = self.body.shear_modulus * np.where(
            self.ratio > 1.0,
            soft,
            stiff,
        )
        modulus = np.where(share < 1.0, changed, layer.shear_modulus)
        added = np.minimum(thick - layer.height, 0.5 * self.body.height)
        return Zone(
            layer=layer._replace(height=thick, shear_modulus=modulus),
            body=self.body._replace(height=self.body.height - added),
        )

    def stiffness(self, wavenumber: ArrayLike) -> Stiffness:
        """Dimensionless stiffness at a wavenumber (1/m), over the body's modulus."""
        waves = Waves(self.layer.layer_number(wavenumber))
        behind = self.body.stiffness(wavenumber)
        terms = [share * np.stack(of_layer) for share, of_layer in self._terms(waves, behind)]
        below, *above = np.add.reduce(terms)
        xx, xy, yy, det = (numerator / below for numerator in above)
        scale = 1.0 / self.ratio  # from over the zone's modulus
        return Stiffness(scale * xx, scale * xy, scale * yy, scale**2 * det)

    def _terms(self, waves: Waves, behind: Stiffness) -> list[tuple[Array, StiffnessTerms]]:
        """Shares 1, B_xx, B_yy, det B and B_xy, and the terms of the layer that each multiplies."""
        nu = self.layer.poisson_ratio
        xx = self.ratio * behind.xx
        one = np.ones_like(xx)
        if self.layer.antiplane:
            held, free = 2.0 * waves.cosh_squared, waves.sinh_2q
            return [(one, antiplane_terms(free, held)), (xx, antiplane_terms(held, free))]
        shares = {
            "free": one,
            "velocity": (1.0 - nu) * xx,
            "roller": (1.0 - nu) * self.ratio * behind.yy,
            "clamped": 0.5 * self.ratio**2 * behind.det,
        }
        found = [(share, FAR_SIDES[name](waves, nu)) for name, share in shares.items()]
        return [*found, (self.ratio * behind.xy, _mixed_terms(waves, nu))]


def _mixed_terms(
    w: Waves,
    nu: Array,
) -> StiffnessTerms:
    """The factor of ``B_xy``; its entries may be negative."""
    compression = 1.0 - nu
    expansion = 1.0 - 2.0 * nu
    kappa = 3.0 - 4.0 * nu
    constant = 8.0 * compression**2 * w.decay
    return StiffnessTerms(
        denominator=2.0 * (expansion * kappa * w.sinh_squared - w.square),
        xx=4.0 * compression * (expansion * w.sinh_2q - w.linear),
        xy=constant + 4.0 * (expansion**2 * w.sinh_squared - w.square),
        yy=4.0 * compression * (expansion * w.sinh_2q + w.linear),
        det=8.0 * (expansion * w.sinh_squared + w.square),
    )
