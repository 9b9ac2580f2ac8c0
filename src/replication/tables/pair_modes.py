"""The bridge for two bodies: single modes between two sliding layers, in time and by Eq. (5).

As :mod:`.dispersion` for one layer on a rigid base. The two measured rates of a mode are the roots
of Eq. (5). Each of them thus gives the elastic response of the bodies without any theory of them:

    G1 - i f G2 = -sigma0 Lambda (a Lambda ell - zeta V) / [mu k V (V + Lambda ell)] .

Between layers higher than a wavelength that is the response of half-spaces, Eqs. (7) and (8).
"""

from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from nucleation.datasets.variables import annotate
from nucleation.run.run import Run
from nucleation.theory.closed_forms import bimaterial_contrast
from nucleation.theory.critical import unstable_modes
from nucleation.theory.evaluation import single_system
from nucleation.types import Array

from .dispersion import MODES_OF_SLIDING, by_direction, disagreement
from .rows import SHARED
from .sliding_modes import measured_rates

RATIOS = (0.6, 0.8, 0.97, 1.03, 1.25, 2.0)  # k over the critical one
DEEP = 1.2  # wavelengths: layers as high as this are half-spaces for a mode, to 1e-4
ENDLESS = 1e3  # m
SOFT, STIFF = 3.1e9, 9.3e9  # Pa
SECOND_DENSITY = 2400.0  # kg/m^3
LOWER_HEIGHT = 0.6  # of a thin lower layer over the upper one's


class LayerPair(NamedTuple):
    """Shear moduli (Pa) and Poisson ratios of two layers, far side of the lower one, and heights.

    Without a height (m) of the upper layer both are half-spaces.
    """

    name: str
    modulus: float
    second_modulus: float
    poisson_ratio: float = 1.0 / 3.0
    second_poisson_ratio: float = 0.2
    far_side: str = "free"
    height: float | None = None

    def bodies(self, height: float, second_height: float) -> dict[str, float]:
        """Heights (m) and materials by the names of parameters and of columns."""
        return {
            "height": height,
            "second_height": second_height,
            "shear_modulus": self.modulus,
            "second_shear_modulus": self.second_modulus,
            "poisson_ratio": self.poisson_ratio,
            "second_poisson_ratio": self.second_poisson_ratio,
        }

    def run(
        self,
        base: Run,
        height: float,
        second_height: float,
    ) -> Run:
        """Run of layers of these heights (m), with friction and loading of `base`."""
        further = {
            "plane": "strain",
            "second_body": "deformable",
            "second_density": SECOND_DENSITY,
            "second_far_side": self.far_side,
        }
        return base.replaced(**self.bodies(height, second_height) | further)


THIN_LAYERS = (
    LayerPair("stiff above, free", STIFF, SOFT, far_side="free", height=0.2),
    LayerPair("stiff below, free", SOFT, STIFF, far_side="free", height=0.2),
    LayerPair("stiff above, clamped", STIFF, SOFT, far_side="clamped", height=0.05),
    LayerPair("stiff below, clamped", SOFT, STIFF, far_side="clamped", height=0.05),
    LayerPair("stiff above, roller", STIFF, SOFT, far_side="roller", height=0.05),
    LayerPair("stiff below, roller", SOFT, STIFF, far_side="roller", height=0.05),
)
"""Layers of finite height. Free ones are higher: they bend, and bending needs finer elements."""

HALF_SPACES = (
    LayerPair("half-spaces, stiff below", SOFT, STIFF),
    LayerPair("half-spaces, stiff above", STIFF, SOFT),
    LayerPair("half-spaces, ten times, below", SOFT, 10.0 * SOFT, 0.0, 0.0),
    LayerPair("half-spaces, ten times, above", 10.0 * SOFT, SOFT, 0.0, 0.0),
)
"""Layers of a height at which their far sides do not matter."""


def _sized(layers: LayerPair, base: Run, ratio: float) -> tuple[Run, float]:
    """The parameters of a pair for a mode of ``ratio`` k_c, and k_c (1/m)."""
    if layers.height is not None:
        found = layers.run(base, layers.height, LOWER_HEIGHT * layers.height)
        return found, _critical(found)
    critical = _critical(layers.run(base, ENDLESS, ENDLESS))
    height = DEEP * 2.0 * np.pi / (ratio * critical)
    return layers.run(base, height, height), critical


def _critical(run: Run) -> float:
    """k_c (1/m)."""
    return float(unstable_modes(single_system(run.fault)).wavenumber[0])


def measured_response(modes: xr.Dataset) -> tuple[Array, Array]:
    """G1 and G2 of the bodies by the measured rates of simulated modes, (run, branch)."""

    def column(name: str) -> Array:
        return modes[name].values[:, None]

    growth = modes["measured_growth"].values
    frequency = modes["measured_frequency"].values
    rates = growth + 1j * frequency
    mu = column("shear_modulus")
    k = column("mode_wavenumber")
    f = column("friction")
    a = column("a")
    zeta = column("zeta")
    ell = column("slip_distance")
    v = column("velocity")
    weakening = rates * (a * rates * ell - zeta * v) / (v * (v + rates * ell))
    response = -column("normal_stress") * weakening / (mu * k)
    return response.real, -response.imag / f


def mode_row(layers: LayerPair, base: Run, ratio: float) -> dict[str, Any]:
    """Columns of :func:`pair_modes` of one mode, at a wavenumber over the critical one."""
    run, critical = _sized(layers, base, ratio)
    fault, below = run.fault, run.below
    assert below is not None
    height = fault.height
    k = ratio * critical
    measured = measured_rates(run, height, k)
    theory = single_system(fault).growth_rates(np.array([k]))[:, 0]
    contrast = bimaterial_contrast(run.upper.material, below.material)
    return {
        "id": layers.name,
        "far_side": layers.far_side,
        **layers.bodies(height, below.height),
        "friction": fault.friction,
        "a": fault.a,
        "zeta": fault.zeta,
        "slip_distance": fault.slip_distance,
        "velocity": fault.velocity,
        "normal_stress": fault.normal_stress,
        "f_beta": fault.friction * contrast,
        "mode_wavenumber": k,
        "critical_wavenumber": critical,
        "measured": by_direction(measured),
        "theory": by_direction(theory),
    }


def pair_modes(
    base: Run,
    pairs: tuple[LayerPair, ...] = THIN_LAYERS + HALF_SPACES,
    ratios: tuple[float, ...] = RATIOS,
) -> xr.Dataset:
    """Rates of modes between two layers on (run, branch), measured and by Eq. (5).

    The branch with the larger frequency travels along +x and comes first.
    """
    rows = [mode_row(layers, base, ratio) for layers in pairs for ratio in ratios]
    rates: dict[str, Any] = {}
    for kind in ("measured", "theory"):
        both = np.array([row.pop(kind) for row in rows])
        rates[f"{kind}_growth"] = (("run", "branch"), both.real)
        rates[f"{kind}_frequency"] = (("run", "branch"), both.imag)
    columns = {name: ("run", [row[name] for row in rows]) for name in rows[0]}
    return annotate(xr.Dataset(columns | rates), SHARED | MODES_OF_SLIDING)


def _csv(dataset: xr.Dataset) -> str:
    """A line for each mode and direction, with the disagreement of the complex rates."""
    ratio = dataset["mode_wavenumber"] / dataset["critical_wavenumber"]
    table = dataset.assign(wavenumber_over_critical=ratio, disagreement=disagreement(dataset))
    frame = table.to_dataframe(["run", "branch"]).reset_index()
    return frame.drop(columns="run").to_csv(index=False, float_format="%.8g")


def files(base: Run) -> dict[str, xr.Dataset | str]:
    """The files of the step ``pair_modes``; each pair replaces the moduli of the base."""
    found = pair_modes(base)
    return {".nc": found, ".csv": _csv(found)}
