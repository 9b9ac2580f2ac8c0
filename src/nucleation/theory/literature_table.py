"""The nucleation lengths in use, each with formula, source and validity in words.

The functions are those of :mod:`nucleation.theory.literature`.
"""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ..model.quantities import Quantity
from ..theory import literature
from .fault import Fault, Values, checked, labelled, takes_fault, where

if TYPE_CHECKING:
    import xarray as xr

TWO_MATERIALS = "two half-spaces of the two bodies' materials"
HALF_SPACES = "two identical half-spaces of the first body's material"
THIS_FAULT = "this fault, both bodies as they are"
RIGID_BASE = "a layer of the first body's material and height on a rigid body"

WEAKENING_RATE = Quantity(
    "rate of linear slip weakening of the shear strength", unit="Pa/m", low=0.0, high=1e25,
    symbol="W",
)  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Length:
    """One length of the literature, in words and as a function."""

    key: str
    title: str
    formula: str
    source: str
    validity: str
    system: str
    compute: Callable[..., Any]
    needs: str  # the condition on this fault's parameters, outside which it is NaN

    def evaluate(self, fault: Fault, weakening_rate: Values) -> Any:
        """The length (m) of a fault, NaN outside its validity."""
        if self.system == THIS_FAULT:
            return self.compute(fault)
        names = inspect.signature(self.compute).parameters
        own = {"weakening_rate": weakening_rate, "poisson_ratio": fault.in_plane_ratios[0]}
        if self.system == TWO_MATERIALS:
            modulus, coupling = of_two_materials(fault)
            own |= {"shear_modulus": modulus, "poisson_ratio": 0.0}  # of which mu* = M
        value = self.compute(**{n: own[n] if n in own else getattr(fault, n) for n in names})
        if self.system == TWO_MATERIALS:
            return where(coupling < literature.NEGLIGIBLE, value, np.nan)
        return value

    def of_two(self) -> Length:
        """The same for two materials, with M in the place of mu*."""
        return dataclasses.replace(
            self,
            key=f"{self.key}_two_materials",
            formula=self.formula.replace("mu*", "M"),
            source=f"{self.source}; M of Aldam et al. (2017), Eq. (8)",
            validity=f"{self.validity}; normal stress hardly changed by slip",
            system=TWO_MATERIALS,
            needs=f"{self.needs} and f |beta| < {literature.NEGLIGIBLE}",
        )

    def words(self) -> dict[str, str]:
        """Unit, title, formula, source, validity, system and condition, as attributes."""
        names = ("title", "formula", "source", "validity", "system", "needs")
        return {"units": "m", **{name: getattr(self, name) for name in names}}


def of_two_materials(fault: Fault) -> tuple[Any, Any]:
    """The modulus M (Pa) of the pair as half-spaces and ``f |beta|``."""
    nu, second_nu = fault.in_plane_ratios
    modulus, beta = literature.bimaterial(
        fault.shear_modulus, nu, fault.second_shear_modulus, second_nu
    )
    return modulus, abs(beta) * (0.0 if fault.friction is None else fault.friction)


_WEAKENING = "velocity weakening, near steady sliding, either law"


def _stability_length(fault: Fault) -> Any:
    from .creep.lengths import stability_values  # with SciPy, which takes a while

    return stability_values(fault)[0]


_OF_FAULT = Length(
    "creeping_patch", "creeping patch, pushed", "its own eigenproblem, docs/patch_theory.md",
    "this project", "a patch that creeps as it is pushed at its edge, constant a and b, either law",
    THIS_FAULT, _stability_length, "zeta > 0 and L_s < 3 L_c",
)  # fmt: skip

_OF_ONE_MATERIAL = (
    Length(
        "homogeneous_sliding", "homogeneous sliding", "pi mu* D/(zeta sigma0)",
        "Rice and Ruina (1983); Aldam et al. (2017), Eq. (6)", _WEAKENING, HALF_SPACES,
        literature.homogeneous_sliding_length, "zeta > 0",
    ),
    Length(
        "rice_ruina", "Rice-Ruina h*", "(pi/4) mu* D/(zeta sigma0)",
        "Rice and Ruina (1983); Lapusta and Liu (2009)",
        f"{_WEAKENING}; a spring block at K_c", HALF_SPACES, literature.rice_ruina_length,
        "zeta > 0",
    ),
    Length(
        "dieterich_shortest", "conventional, eta = 2/pi", "eta mu D/(zeta sigma0)",
        "Dieterich (1992), Table 1; Aldam et al. (2017), Eqs. (1)-(3)",
        f"{_WEAKENING}; shortest of the crack models", HALF_SPACES,
        literature.dieterich_shortest_length, "zeta > 0",
    ),
    Length(
        "dieterich_longest", "conventional, eta = 4/3", "eta mu D/(zeta sigma0)",
        "Dieterich (1992), Table 1; Aldam et al. (2017), Eqs. (1)-(3)",
        f"{_WEAKENING}; longest of the crack models", HALF_SPACES,
        literature.dieterich_longest_length, "zeta > 0",
    ),
    Length(
        "state_evolution", "state evolution L_b", "mu* D/(b sigma0)",
        "Dieterich (1992); Rubin and Ampuero (2005)",
        "far above steady state; a mesh has to resolve it", HALF_SPACES,
        literature.state_evolution_length, "b > 0",
    ),
    Length(
        "rubin_ampuero_localised", "Rubin-Ampuero, fixed length", "2 x 1.3774 mu* D/(b sigma0)",
        "Rubin and Ampuero (2005), 2 L_nu", "aging law, far above steady state; a/b < 0.3781",
        HALF_SPACES, literature.rubin_ampuero_localised_length,
        f"a/b < {literature.LOCALISED_LIMIT}",
    ),
    Length(
        "rubin_ampuero_crack", "Rubin-Ampuero, expanding", "(2/pi) mu* b D/[(b - a)^2 sigma0]",
        "Rubin and Ampuero (2005), 2 L_infinity",
        "aging law, crack-like expansion; 1/2 < a/b < 1", HALF_SPACES,
        literature.rubin_ampuero_crack_length, "1/2 < a/b < 1",
    ),
    Length(
        "uenishi_rice", "Uenishi-Rice", "1.158 mu*/W, W = b sigma0/D unless given",
        "Uenishi and Rice (2003)", "strength falls linearly with slip, without direct effect",
        HALF_SPACES, literature.uenishi_rice_length,
        f"a/b < {literature.NEGLIGIBLE} unless W is given",
    ),
    Length(
        "creeping_asperity", "asperity, creep around it", "1.158 mu* D/(zeta sigma0)",
        "Viesca and Garagash (2025), first scenario, by our derivation; Uenishi and Rice (2003)",
        "velocity weakening, patch of fixed length in steady creep, either law", HALF_SPACES,
        literature.creeping_asperity_length, "zeta > 0",
    ),
    Length(
        "loaded_patch", "pinned patch, steady load", "C(a/b) mu* D/(zeta sigma0)",
        "Viesca and Garagash (2025), second scenario, by our computation of C",
        "velocity weakening, patch of fixed length under a rising load, either law", HALF_SPACES,
        literature.loaded_patch_length, f"0 < a/b < {literature.NEAREST}",
    ),
    Length(
        "thin_limit", "thin layer, Hk -> 0", "2 pi sqrt[2 mu* H D/(zeta sigma0)]",
        "Aldam et al. (2017), Eq. (11)", f"{_WEAKENING}; 2 pi H/L << 1", RIGID_BASE,
        literature.thin_limit_length, f"zeta > 0 and 2 pi H/L < {literature.THIN}",
    ),
    Length(
        "thin_layer", "thin layer, aging law", "2 pi sqrt[2 mu* H D/(b sigma0)]", "Viesca (2016)",
        "aging law, far above steady state; a/b < 1/2; 2 pi H/L << 1", RIGID_BASE,
        literature.thin_layer_length, f"a/b < 1/2 and 2 pi H/L < {literature.THIN}",
    ),
)  # fmt: skip
_OF_TWO = (
    "homogeneous_sliding", "rice_ruina", "state_evolution", "rubin_ampuero_localised",
    "rubin_ampuero_crack", "uenishi_rice", "creeping_asperity", "loaded_patch",
)  # fmt: skip

LENGTHS = (
    _OF_FAULT,
    *_OF_ONE_MATERIAL,
    *(x.of_two() for x in _OF_ONE_MATERIAL if x.key in _OF_TWO),
)
"""The lengths in use, in the order in which they are listed."""


@takes_fault
def lengths_in_use(*, weakening_rate: Values | None = None, **fault: Values) -> xr.Dataset:
    """All lengths of :data:`LENGTHS` for a fault.

    Parameters
    ----------
    weakening_rate : array_like, optional
        Slip weakening W (Pa/m) of Uenishi and Rice's length; ``b sigma0/D`` by default, where
        ``a/b < 0.1``.
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`. The system of each length is
        its attribute ``system``: the second body matters to those of two materials alone, whose
        key ends with ``_two_materials``.

    Returns
    -------
    Dataset
        One variable (m) for each, NaN outside its validity, with ``formula``, ``source``,
        ``validity``, ``system`` and ``needs`` as attributes. Arrays without named dimensions
        have the dimensions ``axis_0``, ``axis_1``, ...

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown or outside its range.
    """
    return lengths_of(Fault(**fault), weakening_rate)


def lengths_of(fault: Fault, weakening_rate: Values | None = None) -> xr.Dataset:
    """The same for a :class:`~nucleation.theory.fault.Fault`."""
    import xarray as xr

    found = values_of(fault, weakening_rate)
    plain = {k: x for k, x in found.items() if not labelled(x)}
    shape = np.broadcast_shapes(*map(np.shape, plain.values()))
    dims = [f"axis_{n}" for n in range(len(shape))]
    found |= {k: xr.DataArray(np.broadcast_to(x, shape), dims=dims) for k, x in plain.items()}
    return xr.Dataset(
        {length.key: found[length.key].assign_attrs(length.words()) for length in LENGTHS}
    )


def values_of(fault: Fault, weakening_rate: Values | None = None) -> dict[str, Any]:
    """The lengths (m) by key, as arrays or DataArrays."""
    if weakening_rate is None:
        weakening_rate = fault.b * fault.normal_stress / fault.slip_distance
        small = fault.a < literature.NEGLIGIBLE * fault.b
        weakening_rate = where(small, weakening_rate, np.nan)
    else:
        weakening_rate = checked("weakening_rate", weakening_rate, WEAKENING_RATE)
    return {length.key: length.evaluate(fault, weakening_rate) for length in LENGTHS}
