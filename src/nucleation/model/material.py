"""Linear isotropic elasticity in two dimensions: moduli and wave speeds."""

import dataclasses
import math
from typing import Any

from .quantities import quantity
from .units import Checked

ANTIPLANE = "antiplane"


def in_plane_ratio(poisson_ratio: Any, plane: str) -> Any:
    """Poisson's ratio of the plane-strain material with the same in-plane response.

    Parameters
    ----------
    poisson_ratio : array_like
        nu. Beside mu, in-plane elasticity has kappa, ``3 - 4 nu`` in plane strain and ``(3 - nu)/(1
        + nu)`` in plane stress (Muskhelishvili, 1953), which is ``3 - 4 nu/(1 + nu)``.
    plane : {"strain", "stress", "antiplane"}
        In antiplane shear nu has no effect, and mu replaces ``mu/(1 - nu)``: zero.
    """
    if plane == ANTIPLANE:
        return 0.0 * poisson_ratio
    return poisson_ratio if plane == "strain" else poisson_ratio / (1.0 + poisson_ratio)


@dataclasses.dataclass(frozen=True)
class Material(Checked):
    """A linear elastic isotropic solid (SI units).

    Examples
    --------
    >>> round(Material(30e9, 0.25, 2700.0).shear_wave_speed)
    3333
    """

    shear_modulus: float = quantity("shear modulus", "(0.0, 1e13) Pa", symbol="mu")
    poisson_ratio: float = quantity("Poisson's ratio", "(-1.0, 0.5)", symbol="nu")
    density: float = quantity(
        "mass density; zero makes the block quasi-static, without inertia",
        "[0.0, 1e6) kg/m^3",
        symbol="rho",
        default=0.0,
    )
    plane: str = quantity(
        "plane of deformation, of all bodies: strain if they are thick along z, stress for plates "
        "that are thin against all lengths in the plane, antiplane for slip along z",
        choices=("strain", "stress", ANTIPLANE),
        default="strain",
    )

    @property
    def in_plane_ratio(self) -> float:
        """Poisson's ratio of the same response in plane strain (:func:`in_plane_ratio`)."""
        return in_plane_ratio(self.poisson_ratio, self.plane)

    @property
    def lame_modulus(self) -> float:
        """Lame's first parameter ``2 mu nu / (1 - 2 nu)`` (Pa), in plane stress the plate's.

        Zero in antiplane shear, where slip causes no pressure.
        """
        ratio = self.in_plane_ratio
        return 2.0 * self.shear_modulus * ratio / (1.0 - 2.0 * ratio)

    @property
    def p_wave_modulus(self) -> float:
        """Modulus ``lambda + 2 mu`` (Pa) of P waves, in plane stress ``E/(1 - nu^2)``.

        In antiplane shear it is mu, because gradients along x and y both shear the body.
        """
        if self.plane == ANTIPLANE:
            return self.shear_modulus
        return self.lame_modulus + 2.0 * self.shear_modulus

    @property
    def coupling_modulus(self) -> float:
        """Modulus (Pa) between slip gradients along y and shear stress on planes of constant x.

        It is mu in plane strain and plane stress, and zero in antiplane shear: slip along z does
        not strain the x-y plane.
        """
        return 0.0 if self.plane == ANTIPLANE else self.shear_modulus

    @property
    def shear_wave_speed(self) -> float:
        """``sqrt(mu / rho)`` (m/s), infinite without inertia."""
        return math.sqrt(self.shear_modulus / self.density) if self.density else math.inf
