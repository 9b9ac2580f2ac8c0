"""The parameters of a run that follow from its fault: sizes of blocks and mesh, times, scales."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..fault import Fault
from ..model.friction import Friction
from ..model.friction.constants import roughness_length
from ..model.quantities import ParameterError
from ..model.settings import Start
from ..theory.critical import unstable_modes
from ..theory.evaluation import single_system
from ..theory.status import NoLength
from ..theory.values import ZONE
from .estimates import element_height, growth_time, process_zone
from .names import GROUPS, sections

HIGH = 4.0
"""Height of the blocks over L_c: their L_s is within 2 % of that of half-spaces."""

LONG = 35.0
"""Length of blocks in place of half-spaces over L_c: the far end has no effect on the drop."""

USUAL_LENGTH = 6.0
"""Length of other blocks over L_c."""

_ELEMENTS = 6.0  # to a process zone, twice as many as resolve the front
_ROWS = (16, 24, 32, 48, 64, 96)  # of elements, that are tried for the mesh of a half-space
_GRADING = 300.0  # the largest of these meshes
_DIGITS = 4  # significant, of sizes

_LATEST_END = 1.5  # end of a run over the estimated time until the critical length
_AFTER_EVENT = 10.0  # time after the event over D/V


def flat(fault: Fault, law: Friction) -> dict[str, Any]:
    """The parameters of a single fault and its law by name, in the order of a run's sections.

    Those of a second body that equal the first one's are left out.
    """
    found: dict[str, Any] = {name: getattr(fault, name) for name in sections()["material"]}
    for name, value in vars(law).items():
        found[law.called.get(name, name)] = value
    for name in ("normal_stress", "velocity", "initial_state", "loading", "height"):
        found[name] = getattr(fault, name)
    if math.isinf(fault.second_shear_modulus):
        return found | {"second_body": "rigid"}
    found["second_body"] = "deformable"
    for name in ("shear_modulus", "poisson_ratio", "density", "height"):
        second = getattr(fault, f"second_{name}")
        if second != getattr(fault, name):
            found[f"second_{name}"] = second
    if fault.second_far_side not in ("free", "traction"):
        found["second_far_side"] = fault.second_far_side
    return found


def completed(
    fault: Fault,
    values: Mapping[str, Any],
    law: Friction | None = None,
) -> dict[str, Any]:
    """All parameters of a run of a single fault, from those that are given and its friction law.

    Raises a ParameterError if the fault is no single one, has a zone, or lacks what a simulation
    needs.
    """
    _require_single(fault)
    for name in values:
        if not any(name in names for names in _of_groups()):
            raise ParameterError(
                f"{name} is a parameter of the fault: fault.replace({name}=...) changes it"
            )
    law = law or fault.law()
    if fault.initial_state is None:
        fault = fault.replace(initial_state=fault.age())
    found = dict(values)
    critical = _critical_length(fault, found)
    if math.isinf(fault.height) or math.isinf(fault.second_height):
        fault, sizes = _as_blocks(fault, law, critical)
        found = sizes | found
    found.setdefault("block_length", rounded(USUAL_LENGTH * critical))
    b = fault.a + fault.zeta
    if "correlation_length" not in found and b > 0.0:
        modulus = fault.shear_modulus / (1.0 - fault.poisson_ratio)
        strength = b * fault.normal_stress
        found["correlation_length"] = roughness_length(modulus, law.slip_distance, strength)
    of_start = {name: found[name] for name in sections()["loading"] if name in found}
    if "end_time" not in found and not math.isnan(critical):
        found |= late_end(fault, Start(**of_start), critical) | found
    return flat(fault, law) | found


def _of_groups() -> list[list[str]]:
    """Names of the parameters of a run that are not those of its fault."""
    return [
        [cls.called.get(name, name) for name in cls.__dataclass_fields__] for cls in GROUPS.values()
    ]


def _require_single(fault: Fault) -> None:
    for name in dict(fault):
        value = getattr(fault, name)
        if name in ZONE:
            raise ParameterError(f"{name} is not allowed: no simulation has a zone")
        if np.ndim(value):
            raise ParameterError(f"{name} has {np.size(value)} values: it must have one here")
    if fault.far_side not in ("free", "traction"):
        raise ParameterError(
            f"far_side = {fault.far_side!r} is not allowed: the far side of a simulated block is "
            "free"
        )


def _critical_length(fault: Fault, given: Mapping[str, Any]) -> float:
    """L_c (m); NaN for a stable fault whose block has a length."""
    try:
        return float(unstable_modes(single_system(fault)).length[0])
    except NoLength as error:
        if "block_length" in given:
            return math.nan
        raise ParameterError(
            f"{error}; a control run, in which nothing is to nucleate, needs its block_length (m)"
        ) from None


def late_end(fault: Fault, start: Start, critical: float) -> dict[str, float]:
    """An end time after the latest event, and a short time after the event (s).

    The estimated time until L_c (m) is an upper bound of the event's time.
    """
    end = float(f"{_LATEST_END * growth_time(fault, start, critical):.2g}")
    after = _AFTER_EVENT * fault.slip_distance / fault.velocity
    return {"end_time": end, "time_after_event": min(after, end)}


def rounded(length: float) -> float:
    """A size (m) with four significant digits."""
    return float(f"{length:.{_DIGITS}g}")


def _as_blocks(
    fault: Fault,
    law: Friction,
    critical: float,
) -> tuple[Fault, dict[str, Any]]:
    """The fault with blocks in place of half-spaces, and the length and the mesh of the blocks."""
    if math.isnan(critical):
        raise ParameterError(
            "height = inf m is not allowed: sliding is stable at every wavelength, and the blocks "
            "in place of half-spaces are 4 L_c high; give their height"
        )
    high = rounded(HIGH * critical)
    heights = {
        name: high for name in ("height", "second_height") if math.isinf(getattr(fault, name))
    }
    if math.isinf(fault.second_shear_modulus):
        heights.pop("second_height", None)
    fault = fault.replace(**heights)
    length = rounded(LONG * critical)
    element = process_zone(fault, law) / _ELEMENTS
    number = math.ceil(length / element)
    if (number % 2 == 1) != (fault.loading == "remote"):
        number += 1
    found: dict[str, Any] = {"block_length": length, "n_x": number}
    found["n_y"], found["grading"] = _rows(fault.height, element)
    if math.isfinite(fault.second_shear_modulus):
        found["second_n_y"], found["second_grading"] = _rows(fault.second_height, element)
    return fault, found


def _rows(height: float, element: float) -> tuple[int, float]:
    """Number of elements along y and grading, so that those at the interface have a size (m)."""
    for rows in _ROWS:
        for grading in (
            np.geomspace(
                1.0,
                _GRADING,
                60,
            )
            .round(1)
            .tolist()
        ):
            if element_height(height, rows, grading) <= element:
                return rows, grading
    return _ROWS[-1], _GRADING
