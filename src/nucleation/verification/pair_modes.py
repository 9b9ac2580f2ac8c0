"""The bridge for two bodies: single modes between two sliding layers, in time and by Eq. (5).

As :mod:`.dispersion` for one layer on a rigid base. A mode's two measured rates are the roots of
Eq. (5), so each gives, without any theory of the bodies, the elastic response that it has met,

    G1 - i f G2 = -sigma0 Lambda (a Lambda ell - zeta V) / [mu k V (V + Lambda ell)] .

Between layers higher than a wavelength that is the response of half-spaces, Eqs. (7) and (8).
"""

from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..datasets.shared import SHARED
from ..datasets.variables import annotate
from ..model.friction.law import Friction
from ..model.linearised import interface_state
from ..model.material import Material
from ..model.parameters import Loading, Parameters
from ..theory.closed_forms import bimaterial_contrast
from ..theory.critical import critical_wavenumber
from ..theory.spectrum import growth_rates
from ..theory.transfer import bodies_of
from ..types import Array
from .dispersion import MODES_OF_SLIDING, by_direction, disagreement, measured_rates

RATIOS = (0.6, 0.8, 0.97, 1.03, 1.25, 2.0)  # k over the critical one
DEEP = 1.2  # heights of layers that are half-spaces to a mode, in its wavelengths: to 1e-4
ENDLESS = 1e3  # m
SOFT, STIFF = 3.1e9, 9.3e9  # Pa
SECOND_DENSITY = 2400.0  # kg/m^3


class Layers(NamedTuple):
    """Two materials and how they are held."""

    name: str
    modulus: float  # Pa, of the upper layer
    second_modulus: float
    poisson_ratio: float = 1.0 / 3.0
    second_poisson_ratio: float = 0.2
    bottom: str = "free"
    height: float | None = None  # m; a half-space's without one

    def materials(self, height: float, second_height: float) -> dict[str, Any]:
        """What is varied, by the names of parameters and of columns; heights in m."""
        return {
            "height": height,
            "second_height": second_height,
            "shear_modulus": self.modulus,
            "second_shear_modulus": self.second_modulus,
            "poisson_ratio": self.poisson_ratio,
            "second_poisson_ratio": self.second_poisson_ratio,
        }

    def parameters(self, base: Parameters, height: float, second_height: float) -> Parameters:
        """Those of the pair, with friction and loading of a base; heights in m."""
        return base.replaced(
            self.materials(height, second_height)
            | {"plane": "strain", "second_body": "deformable", "second_density": SECOND_DENSITY,
               "second_bottom": self.bottom}
        )  # fmt: skip


HELD = tuple(
    Layers(f"{stiff} {bottom}", *moduli, bottom=bottom, height=height)
    for bottom, height in (("free", 0.2), ("clamped", 0.05), ("roller", 0.05))
    for stiff, moduli in (("stiff above,", (STIFF, SOFT)), ("stiff below,", (SOFT, STIFF)))
)
"""Thin layers with each far side, either of them the stiffer one, the lower one 0.6 times as high.
Those that nothing holds bend, for which elements are to be finer."""

HALF_SPACES = (
    Layers("half-spaces, stiff below", SOFT, STIFF),
    Layers("half-spaces, stiff above", STIFF, SOFT),
    Layers("half-spaces, ten times, below", SOFT, 10.0 * SOFT, 0.0, 0.0),
    Layers("half-spaces, ten times, above", 10.0 * SOFT, SOFT, 0.0, 0.0),
)
"""Layers of a height at which their far sides do not matter."""


def sized(layers: Layers, base: Parameters, ratio: float) -> tuple[Parameters, float]:
    """The parameters of a pair for a mode of ``ratio`` k_c, and k_c (1/m)."""
    if layers.height is not None:
        found = layers.parameters(base, layers.height, 0.6 * layers.height)
        return found, critical_wavenumber(*bodies_of(found), interface_state(found)).wavenumber
    far = layers.parameters(base, ENDLESS, ENDLESS)
    critical = critical_wavenumber(*bodies_of(far), interface_state(far)).wavenumber
    height = DEEP * 2.0 * np.pi / (ratio * critical)
    return layers.parameters(base, height, height), critical


def measured_response(modes: xr.Dataset) -> tuple[Array, Array]:
    """G1 and G2 that the simulated modes have met, of :func:`pair_modes`, shape (run, branch)."""
    rates = modes["measured_growth"].values + 1j * modes["measured_frequency"].values
    sigma0, mu, k, f, a, zeta, ell, v = (
        modes[name].values[:, None]
        for name in ("applied_stress", "shear_modulus", "mode_wavenumber", "friction",
                     "direct_effect", "velocity_weakening", "slip_distance", "velocity")
    )  # fmt: skip
    weakening = rates * (a * rates * ell - zeta * v) / (v * (v + rates * ell))
    response = -sigma0 * weakening / (mu * k)
    return response.real, -response.imag / f


def mode_row(layers: Layers, base: Parameters, ratio: float) -> dict[str, Any]:
    """One mode between two layers: what they are, and its rates, measured and of Eq. (5)."""
    parameters, critical = sized(layers, base, ratio)
    interface, below, k = interface_state(parameters), parameters.below, ratio * critical
    assert below is not None
    measured = measured_rates(parameters, parameters.geometry.height, k)
    theory = growth_rates(k, *bodies_of(parameters), interface)
    contrast = bimaterial_contrast(parameters.material, below.material)
    return {
        "id": layers.name,
        "far_side": layers.bottom,
        **layers.materials(parameters.geometry.height, below.geometry.height),
        "friction": interface.friction,
        "direct_effect": interface.a,
        "velocity_weakening": interface.zeta,
        "slip_distance": interface.slip_length,
        "velocity": interface.velocity,
        "applied_stress": interface.normal_stress,
        "f_beta": interface.friction * contrast,
        "mode_wavenumber": k,
        "critical_wavenumber": critical,
        "measured": by_direction(measured),
        "theory": by_direction(theory),
    }


def pair_modes(
    base: Parameters, pairs: tuple[Layers, ...] = HELD + HALF_SPACES,
    ratios: tuple[float, ...] = RATIOS,
) -> xr.Dataset:  # fmt: skip
    """Rates of modes between two layers, measured and of Eq. (5).

    `base` has friction, density and loading, `ratios` are wavenumbers over the critical one of each
    pair. The dataset has the two bodies and friction at V on ``run``, the rates (1/s) on (run,
    branch); the branch of the larger frequency, which travels along +x, comes first.
    """
    rows = [mode_row(layers, base, ratio) for layers in pairs for ratio in ratios]
    found: dict[str, Any] = {}
    for kind in ("measured", "theory"):
        rates = np.array([row.pop(kind) for row in rows])
        found[f"{kind}_growth"] = ("run", "branch"), rates.real
        found[f"{kind}_frequency"] = ("run", "branch"), rates.imag
    columns = {name: ("run", [row[name] for row in rows]) for name in rows[0]}
    return annotate(xr.Dataset(columns | found), SHARED | MODES_OF_SLIDING)


def to_csv(dataset: xr.Dataset) -> str:
    """One line for each mode and direction, with the disagreement of the complex rates."""
    ratio = dataset["mode_wavenumber"] / dataset["critical_wavenumber"]
    table = dataset.assign(wavenumber_over_critical=ratio, disagreement=disagreement(dataset))
    frame = table.to_dataframe(["run", "branch"]).reset_index().drop(columns="run")
    return frame.to_csv(index=False, float_format="%.8g")


def files(material: Material, friction: Friction, loading: Loading) -> dict[str, Any]:
    """The step ``pair_modes``: :func:`pair_modes`, with its CSV."""
    found = pair_modes(Parameters(material=material, friction=friction, loading=loading))
    return {".nc": found, ".csv": to_csv(found)}
