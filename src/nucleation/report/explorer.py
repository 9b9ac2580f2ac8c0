"""The sliders over the theory's curve: what they vary, in which unit and range."""

import dataclasses
from typing import Any, NamedTuple

from ..model.linearised import InterfaceState
from ..model.material import Material


class Slider(NamedTuple):
    """One slider: the library's parameter, its name in the page's code, and what is shown."""

    group: type
    parameter: str
    key: str
    label: str
    symbol: str
    unit: str
    factor: float  # SI over the unit shown
    low: float  # ends of the slider, in the unit shown
    high: float
    logarithmic: bool = True


SLIDERS = (
    Slider(Material, "shear_modulus", "mu", "Shear modulus", "μ", "GPa", 1e9, 0.1, 100.0),
    Slider(Material, "poisson_ratio", "nu", "Poisson's ratio", "ν", "", 1.0, 0.0, 0.49, False),
    Slider(InterfaceState, "normal_stress", "sigma0", "Normal stress", "σ₀", "MPa", 1e6, 0.1, 2e2),
    Slider(InterfaceState, "friction", "f", "Friction coefficient", "f", "", 1.0, 0.0, 1.0, False),
    Slider(InterfaceState, "a", "a", "Direct effect", "a", "", 1.0, 0.001, 0.05),
    Slider(InterfaceState, "zeta", "zeta", "Velocity weakening", "ζ", "", 1.0, 0.001, 0.05),
    Slider(InterfaceState, "slip_length", "ell", "Slip distance", "ℓ = D", "µm", 1e-6, 0.05, 1e3),
    Slider(InterfaceState, "velocity", "V", "Sliding velocity", "V", "µm/s", 1e-6, 1e-3, 1e4),
)


def controls(material: Material, interface: InterfaceState) -> list[dict[str, Any]]:
    """The sliders as the page needs them, at the configuration's values.

    Parameters
    ----------
    material : Material
        Of the block.
    interface : InterfaceState
        On which the theory's curve of Figure 3 stands.

    Returns
    -------
    list of dict
        ``key``, ``label``, ``symbol``, ``unit``, ``factor`` (SI over the unit), ``low``, ``high``,
        ``log`` and ``value``; the last four in the unit, the range widened to hold the value.
    """
    given = _given(material, interface)
    result = []
    for slider in SLIDERS:
        value = float(f"{given[slider.group][slider.parameter] / slider.factor:.12g}")
        shown = {
            name: getattr(slider, name) for name in ("key", "label", "symbol", "unit", "factor")
        }
        ends = {"low": min(slider.low, value), "high": max(slider.high, value)}
        result.append({**shown, **ends, "log": slider.logarithmic, "value": value})
    return result


def si_values(material: Material, interface: InterfaceState) -> dict[str, float]:
    """The parameters under the names of the page's code, in SI units."""
    given = _given(material, interface)
    return {slider.key: given[slider.group][slider.parameter] for slider in SLIDERS}


def _given(material: Material, interface: InterfaceState) -> dict[type, dict[str, Any]]:
    """The values by group; the page computes in plane strain."""
    in_strain = dataclasses.asdict(material) | {"poisson_ratio": material.in_plane_ratio}
    return {Material: in_strain, InterfaceState: dataclasses.asdict(interface)}
