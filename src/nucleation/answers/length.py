"""A nucleation length of the literature: in words, and as a function of a fault."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np

from ..model.material import ANTIPLANE
from ..theory.fault import FaultParameters, Values
from . import formulas
from .formulas import Setting, valid

TWO_MATERIALS = "two half-spaces of the two bodies' materials"
HALF_SPACES = "two identical half-spaces of the first body's material"
THIS_FAULT = "this fault, both bodies as they are"
RIGID_BASE = "a layer of the first body's material and height on a rigid body"


@dataclasses.dataclass(frozen=True)
class Length:
    """One length of the literature, in words and as a function."""

    key: str
    title: str
    formula: str
    source: str
    validity: str
    compute: Callable[[Any], Any]
    """The length (m) from a Setting; from the FaultParameters if the system is THIS_FAULT."""
    needs: str = "zeta > 0"
    """The condition on the parameters without which the length is NaN."""
    beyond: str = ""
    """Remark on faults that do not meet the condition."""
    system: str = HALF_SPACES

    def evaluate(self, fault: FaultParameters, weakening_rate: Values) -> Any:
        """The length of a fault.

        Parameters
        ----------
        fault : FaultParameters
            One fault, or arrays of faults.
        weakening_rate : array_like
            Slip weakening W (Pa/m).

        Returns
        -------
        array_like
            In metres, NaN outside the validity.
        """
        if self.system == THIS_FAULT:
            return self.compute(fault)
        own: dict[str, Any] = {
            "weakening_rate": weakening_rate,
            "poisson_ratio": fault.in_plane_ratios[0],
        }
        if fault.plane == ANTIPLANE and self.system == RIGID_BASE:
            own["height"] = 0.5 * fault.height  # mu H resists slip, 2 mu H/(1 - nu) in the plane
        if self.system != TWO_MATERIALS:
            return self.compute(_setting(fault, own))
        modulus, coupling = of_two_materials(fault)
        own["shear_modulus"] = modulus
        own["poisson_ratio"] = 0.0  # so that mu* = M
        length = self.compute(_setting(fault, own))
        return valid(coupling < formulas.NEGLIGIBLE, length)

    def facts(self, fault: FaultParameters) -> dict[str, Any]:
        """The quantities of a fault that decide whether the length is valid, by name; H in m."""
        with np.errstate(divide="ignore", invalid="ignore"):
            known = {
                "a/b": fault.a / fault.b,
                "zeta": fault.zeta,
                "b": fault.b,
                "f |beta|": of_two_materials(fault)[1],
                "H": fault.height,
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


def _setting(fault: FaultParameters, own: dict[str, Any]) -> Setting:
    """The parameters of a fault, some of them replaced by `own` values."""
    values = {}
    for field in dataclasses.fields(Setting):
        name = field.name
        values[name] = own[name] if name in own else getattr(fault, name)
    return Setting(**values)


def of_two_materials(fault: FaultParameters) -> tuple[Any, Any]:
    """Modulus M (Pa) of the two materials as half-spaces, and ``f |beta|``."""
    nu, second_nu = fault.in_plane_ratios
    if fault.plane == ANTIPLANE:
        softness = fault.shear_modulus / fault.second_shear_modulus
        return 2.0 * fault.shear_modulus / (1.0 + softness), 0.0 * softness
    modulus, beta = formulas.bimaterial(
        fault.shear_modulus,
        nu,
        fault.second_shear_modulus,
        second_nu,
    )
    friction = 0.0 if fault.friction is None else fault.friction
    return modulus, abs(beta) * friction
