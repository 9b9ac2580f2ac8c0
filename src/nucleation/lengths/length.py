"""A nucleation length of the literature: in words, and as a function of a fault."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any, cast

import numpy as np

from ..model.material import ANTIPLANE, in_plane_ratio
from ..theory.values import FaultLike, Numbers
from . import formulas
from .formulas import Setting, valid

TWO_MATERIALS = "two half-spaces of the two bodies' materials"
HALF_SPACES = "two identical half-spaces of the first body's material"
RIGID_BASE = "a layer of the first body's material and height on a rigid body"


@dataclasses.dataclass(frozen=True)
class Length:
    """One length of the literature, in words and as a function."""

    key: str
    title: str
    formula: str
    source: str
    validity: str
    compute: Callable[[Any], Numbers]
    """The length (m) from a Setting."""
    needs: str = "zeta > 0"
    """The condition on the parameters without which the length is NaN."""
    beyond: str = ""
    """Remark on faults that do not meet the condition."""
    system: str = HALF_SPACES

    def evaluate(self, fault: FaultLike, weakening_rate: Numbers) -> Numbers:
        """The length of a fault.

        Takes weakening_rate (Pa/m). Returns: In metres, NaN outside the validity.
        """
        own: dict[str, Any] = {
            "weakening_rate": weakening_rate,
            "poisson_ratio": in_plane_ratio(fault.poisson_ratio, fault.plane),
        }
        if fault.plane == ANTIPLANE and self.system == RIGID_BASE:
            own["height"] = 0.5 * number(
                fault, "height"
            )  # mu H resists slip, 2 mu H/(1 - nu) in the plane
        if self.system != TWO_MATERIALS:
            return self.compute(_setting(fault, own))
        modulus, coupling = of_two_materials(fault)
        own["shear_modulus"] = modulus
        own["poisson_ratio"] = 0.0  # so that mu* = M
        length = self.compute(_setting(fault, own))
        return valid(coupling < formulas.NEGLIGIBLE, length)

    def facts(self, fault: FaultLike) -> dict[str, Numbers]:
        """The quantities of a fault that decide whether the length is valid, by name; H in m."""
        with np.errstate(divide="ignore", invalid="ignore"):
            known = {
                "a/b": number(fault, "a") / formulas.nan0(number(fault, "b")),
                "zeta": number(fault, "zeta"),
                "b": number(fault, "b"),
                "f |beta|": of_two_materials(fault)[1],
                "H": number(fault, "height"),
            }
        return {name: known[name] for mark, name in _FACTS.items() if mark in self.needs}

    def of_two(self) -> Length:
        """The same length for two materials, with M in place of mu*."""
        return dataclasses.replace(
            self,
            key=f"{self.key}_two_materials",
            formula=self.formula.replace("mu*", "M"),
            source=f"{self.source}; M of Aldam et al. (2017), Eq. (8)",
            validity=f"{self.validity}; normal stress hardly changed by slip",
            system=TWO_MATERIALS,
            needs=f"{self.needs} and f |beta| < {formulas.NEGLIGIBLE}",
        )

    def words(self) -> dict[str, str]:
        """Unit, title, formula, source, validity, system and condition, as attributes."""
        names = ("title", "formula", "source", "validity", "system", "needs", "beyond")
        found = {"units": "m"}
        for name in names:
            found[name] = getattr(self, name)
        return found


_FACTS = {"a/b": "a/b", "zeta": "zeta", "b > 0": "b", "beta": "f |beta|", "H/L": "H"}
"""The quantity in a condition, by a part of :attr:`Length.needs`."""


def _setting(fault: FaultLike, own: dict[str, Any]) -> Setting:
    """The parameters of a fault, some of them replaced by `own` values."""
    values = {}
    for field in dataclasses.fields(Setting):
        name = field.name
        values[name] = own[name] if name in own else getattr(fault, name)
    return Setting(**values)


def number(fault: FaultLike, name: str) -> Numbers:
    """A parameter of a fault, which has checked it, in SI units."""
    return cast(Numbers, getattr(fault, name))


def of_two_materials(fault: FaultLike) -> tuple[Numbers, Numbers]:
    """Modulus M (Pa) of the two materials as half-spaces, and ``f |beta|``."""
    nu = in_plane_ratio(fault.poisson_ratio, fault.plane)
    second_nu = in_plane_ratio(fault.second_poisson_ratio, fault.plane)
    first = number(fault, "shear_modulus")
    second = number(fault, "second_shear_modulus")
    if fault.plane == ANTIPLANE:
        softness = first / second
        return 2.0 * first / (1.0 + softness), 0.0 * softness
    modulus, beta = formulas.bimaterial(first, nu, second, second_nu)
    contrast = np.abs(beta)
    if fault.friction is None:
        return modulus, contrast * 0.0
    return modulus, contrast * number(fault, "friction")
