"""Linear isotropic elasticity in plane strain: moduli and wave speeds."""

from __future__ import annotations

import dataclasses
import math

from .quantities import Checked, quantity


@dataclasses.dataclass(frozen=True)
class Material(Checked):
    """A linear elastic isotropic solid (SI units)."""

    shear_modulus: float = quantity(
        "shear modulus", unit="Pa", low=0.0, high=1e13, symbol="mu", default=3.1e9
    )
    poisson_ratio: float = quantity(
        "Poisson's ratio", low=-1.0, high=0.5, symbol="nu", default=1.0 / 3.0
    )
    density: float = quantity(
        "mass density; zero makes the block quasi-static, without inertia", unit="kg/m^3",
        low=0.0, high=1e6, closed="low", symbol="rho", default=1200.0,
    )  # fmt: skip

    @property
    def lame_modulus(self) -> float:
        """Lame's first parameter ``lambda = 2 mu nu / (1 - 2 nu)`` (Pa)."""
        return 2.0 * self.shear_modulus * self.poisson_ratio / (1.0 - 2.0 * self.poisson_ratio)

    @property
    def p_wave_modulus(self) -> float:
        """Modulus of uniaxial strain ``lambda + 2 mu`` (Pa)."""
        return self.lame_modulus + 2.0 * self.shear_modulus

    @property
    def shear_wave_speed(self) -> float:
        """``sqrt(mu / rho)`` (m/s), infinite without inertia."""
        return math.sqrt(self.shear_modulus / self.density) if self.density else math.inf
