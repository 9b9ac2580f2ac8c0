"""A nucleation length of the literature, in words and as a formula; :mod:`.in_use` lists them.

All lengths are full lengths (not half-lengths) in plane strain, with ``mu* = mu/(1 - nu)`` and
``zeta = b - a``; a and b are coefficients of **natural** logarithms. Values are in SI units;
numbers, arrays or DataArrays. A length outside its range of validity is NaN. For plane stress
replace nu by ``nu/(1 + nu)``.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ..model.material import ANTIPLANE, in_plane_ratio
from ..model.units import in_metres
from ..theory.values import Conditions, FaultLike, Numbers, where

CONVENTIONAL_ETA = (2.0 / math.pi, 4.0 / 3.0)
"""Range of the prefactor eta of Eq. (3) (Dieterich, 1992, Table 1)."""

LOCALISED_LIMIT = 0.3781
"""Largest a/b at which a patch of fixed length accelerates (Rubin and Ampuero, 2005)."""

LOCALISED_FACTOR = 2.0 * 1.3774
"""The length of this patch over L_b."""

CRACK_LIMIT = 0.5
"""Least a/b at which a patch expands like a crack (Rubin and Ampuero, 2005)."""

THIN = 0.3
"""Largest ``2 pi H/L`` of a thin layer: Eq. (11) is then 8 % above the theory."""

FINITE_PATCH = 1.158
"""Shortest unstable patch over ``mu*/W``; its strength falls by W per slip (Uenishi-Rice)."""

NEGLIGIBLE = 0.1
"""Largest a/b at which the direct effect may be neglected, and largest ``f |beta|`` at which the
coupling of slip to normal stress may be: a tenth of the terms that are kept."""

TWO_MATERIALS = "two half-spaces of the two bodies' materials"
HALF_SPACES = "two identical half-spaces of the first body's material"
RIGID_BASE = "a layer of the first body's material and height on a rigid body"


@dataclasses.dataclass(frozen=True)
class Setting:
    """The parameters in the formulas: two identical half-spaces, or a layer on a rigid body.

    mu and sigma0 in Pa, D and H in m, the decrease of strength per slip W in Pa/m.
    """

    shear_modulus: Numbers
    poisson_ratio: Numbers
    normal_stress: Numbers
    a: Numbers
    b: Numbers
    zeta: Numbers
    slip_distance: Numbers
    height: Numbers
    weakening_rate: Numbers

    @property
    def modulus(self) -> Numbers:
        """``mu* = mu/(1 - nu)`` (Pa)."""
        return self.shear_modulus / (1.0 - self.poisson_ratio)

    def conventional(self, eta: float | Numbers) -> Numbers:
        """Critical length ``eta mu D/(zeta sigma0)`` (m) of a spring block (Eq. 3).

        The patch's stiffness per area ``eta mu/L`` (Eq. 2) is less than the critical one,
        ``K_c/A = zeta sigma0/D`` (Eq. 1). eta depends on the crack model.
        """
        softness = eta * self.shear_modulus * self.slip_distance
        return valid(self.zeta > 0.0, softness / (nan0(self.zeta) * self.normal_stress))

    def plane(self, factor: float) -> Numbers:
        """Critical length with mu* in place of mu: ``factor mu* D/(zeta sigma0)`` (m)."""
        return self.conventional(factor / (1.0 - self.poisson_ratio))

    def state_evolution(self) -> Numbers:
        """``L_b = mu* D/(b sigma0)`` (m): friction falls by ``b sigma0`` per slip D."""
        length = self.modulus * self.slip_distance / (nan0(self.b) * self.normal_stress)
        return valid(self.b > 0.0, length)

    def thin(self, square: Numbers) -> Numbers:
        """``2 pi sqrt(square)`` (m) where the layer is thin compared with it; square in m^2."""
        length = 2.0 * math.pi * np.sqrt(square)
        is_thin = 2.0 * math.pi * self.height < THIN * length
        return valid(is_thin, length)


def bimaterial(
    shear_modulus: Numbers,
    poisson_ratio: Numbers,
    second_shear_modulus: Numbers,
    second_poisson_ratio: Numbers,
) -> tuple[Numbers, Numbers]:
    """Modulus and contrast of two half-spaces (Eq. 8).

    Slip on their interface changes the shear stress as between two half-spaces of one material with
    ``mu* = M``, and the normal stress by beta times as much, shifted by a quarter wavelength (Eq.
    7). For identical materials M is ``mu*`` and beta vanishes.

    Takes mu in Pa, inf for a rigid second body; returns M in Pa, and beta.
    """
    softness = shear_modulus / second_shear_modulus  # 1/psi, 0 for a rigid second body
    nu, nu2 = poisson_ratio, second_poisson_ratio
    total = (1.0 - nu) + (1.0 - nu2) * softness
    beta = 0.5 * ((1.0 - 2.0 * nu) - (1.0 - 2.0 * nu2) * softness) / total
    return 2.0 * shear_modulus / ((1.0 - beta**2) * total), beta


def between_localised_and_crack(a: float | Numbers, b: float | Numbers) -> Conditions:
    """Whether a/b is in the gap between the ranges of Rubin and Ampuero's two lengths."""
    return (a >= LOCALISED_LIMIT * b) & (a <= CRACK_LIMIT * b)


def valid(condition: Conditions, values: Numbers) -> Numbers:
    """The values where a condition holds, NaN elsewhere."""
    return where(condition, values, np.nan)


def nan0(values: Numbers) -> Numbers:
    """The values with NaN in place of zero, for use as a divisor."""
    return where(values != 0.0, values, np.nan)


@dataclasses.dataclass(frozen=True)
class Length:
    """One length of the literature, in words and as a function; a full length (m)."""

    key: str
    title: str
    formula: str
    source: str
    question: str
    """What it answers."""
    setting: str
    """For which friction and creep, in words."""
    compute: Callable[[Any], Numbers]
    """The length (m) from a Setting."""
    needs: str = "zeta > 0"
    """The condition on the parameters without which the length is NaN."""
    beyond: str = ""
    """Remark on faults that do not meet the condition."""
    system: str = HALF_SPACES
    evolution: str | None = None
    """The evolution of the state for which it is; None for either."""

    def evaluate(self, fault: FaultLike, weakening_rate: Numbers) -> Numbers:
        """The length (m) of a fault, NaN outside the validity; W in Pa/m."""
        names = [field.name for field in dataclasses.fields(Setting)]
        own: dict[str, Any] = {name: getattr(fault, name, None) for name in names}
        own["weakening_rate"] = weakening_rate
        own["poisson_ratio"] = in_plane_ratio(fault.poisson_ratio, fault.plane)
        if fault.plane == ANTIPLANE and self.system == RIGID_BASE:
            own["height"] = 0.5 * fault.height  # mu H resists slip, 2 mu H/(1 - nu) in the plane
        if self.system != TWO_MATERIALS:
            return self.compute(Setting(**own))
        own["shear_modulus"], coupling = of_two_materials(fault)
        own["poisson_ratio"] = 0.0  # so that mu* = M
        return valid(coupling < NEGLIGIBLE, self.compute(Setting(**own)))

    def facts(self, fault: FaultLike) -> dict[str, Numbers]:
        """The quantities of a fault that decide whether the length is valid, by name; H in m."""
        with np.errstate(divide="ignore", invalid="ignore"):
            known = {  # by a part of `needs`
                "a/b": ("a/b", fault.a / nan0(fault.b)),
                "zeta": ("zeta", fault.zeta),
                "b > 0": ("b", fault.b),
                "beta": ("f |beta|", of_two_materials(fault)[1]),
                "H/L": ("H", fault.height),
            }
        return dict(fact for part, fact in known.items() if part in self.needs)

    def of_two(self) -> Length:
        """The same length for two materials, with M in place of mu*."""
        return dataclasses.replace(
            self,
            key=f"{self.key}_two_materials",
            formula=self.formula.replace("mu*", "M"),
            source=f"{self.source}; M of Aldam et al. (2017), Eq. (8)",
            setting=f"{self.setting}; normal stress hardly changed by slip",
            system=TWO_MATERIALS,
            needs=f"{self.needs} and f |beta| < {NEGLIGIBLE}",
        )

    def words(self) -> dict[str, str]:
        """Unit, title, formula, source, validity, system and condition, as attributes."""
        names = ("title", "formula", "source", "question", "setting", "system", "needs", "beyond")
        return {"units": "m"} | {name: getattr(self, name) for name in names}

    def unlike(self, fault: FaultLike, lowest: float, differs: bool) -> str:
        """How one fault differs from the bodies and the law for which the length is.

        The height of the lower body is in m; `differs` is whether they are of two materials.
        """
        found = []
        if fault.zone_thickness is not None:
            found.append("bodies without a zone: here there is one")
        if self.system == RIGID_BASE:
            if np.any(np.isfinite(fault.second_shear_modulus)):
                found.append("a rigid base: here the second body is deformable")
            if fault.far_side != "free":
                found.append(f"a free far side: here it is {fault.far_side}")
        elif math.isfinite(lowest):
            found.append(f"half-spaces: here H = {in_metres(lowest)}")
        if differs and self.system == HALF_SPACES:
            found.append("bodies of one material: here they differ")
        if self.evolution not in (None, fault.evolution):
            found.append(f"the {self.evolution} law: here it is the {fault.evolution} law")
        return f"for {'; for '.join(found)}" if found else ""


def of_two_materials(fault: FaultLike) -> tuple[Numbers, Numbers]:
    """Modulus M (Pa) of the two materials as half-spaces, and ``f |beta|``."""
    nu = in_plane_ratio(fault.poisson_ratio, fault.plane)
    second_nu = in_plane_ratio(fault.second_poisson_ratio, fault.plane)
    first, second = fault.shear_modulus, fault.second_shear_modulus
    if fault.plane == ANTIPLANE:
        softness = first / second
        return 2.0 * first / (1.0 + softness), 0.0 * softness
    modulus, beta = bimaterial(first, nu, second, second_nu)
    return modulus, np.abs(beta) * (0.0 if fault.friction is None else fault.friction)
