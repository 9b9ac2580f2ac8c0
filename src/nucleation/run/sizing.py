"""The parameters of a run that follow from its fault: sizes of blocks and mesh, times, scales."""

import itertools
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..fault import Fault
from ..fault.parameters import PARTS, by_part, names_of, table, values_of
from ..model.friction import Friction
from ..model.friction.constants import AGE, CONSTANTS, roughness_length
from ..model.material import ANTIPLANE, in_plane_ratio
from ..model.quantities import ParameterError
from ..model.settings import NEAR_END, THICK_REACH, Perturbation, Start
from ..theory.critical import critical_length_of
from ..theory.evaluation import single_system
from ..theory.status import NoLength
from ..theory.stiffness import SATURATION
from ..theory.values import QUANTITIES, ZONE
from .reach import longest_reach, reach_of

HIGH = 4.0
"""Height of the blocks over L_c: their L_s is within 2 % of that of half-spaces."""

HIGHER = 1.25
"""Their least height over the length of the patch when the force drops."""

LONG = 35.0
"""Length of blocks in place of half-spaces over L_c: the far end has no effect on the drop."""

USUAL_LENGTH = 6.0
"""Length of other blocks over L_c."""

_ELEMENTS = 6.0  # to a process zone, twice as many as resolve the front
_ROWS = (16, 24, 32, 48, 64, 96)  # of elements, that are tried for the mesh of a half-space
_GRADINGS = np.geomspace(1.0, 300.0, 60).round(1).tolist()  # of these meshes

_LATEST_END = 1.5  # end of a run over the estimated time until its longest patch
_AFTER_EVENT = 10.0  # time after the event over D/V

_FIELDS = {"second_body": "second_shear_modulus", "zeta_over_a": "zeta"}
"""The fault's own names of what a run calls otherwise."""

_THIN = 1e-3  # layer number k H at which a body is thin
_FRESH = 1e-12  # Omega of an interface that has only just come to rest
_NEAR_STEADY = 1e-9  # relative, of omega: round-off of D/V is no age
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(64)  # on (-1, 1)


def values_of_fault(fault: Fault, law: Friction) -> dict[str, Any]:
    """The parameters of a single fault and its law by name, those of both bodies."""
    found = values_of("fault", fault) | values_of("law", law)
    if math.isinf(fault.second_shear_modulus):
        found = {name: x for name, x in found.items() if not name.startswith("second_")}
        return found | {"second_body": "rigid"}
    return found | {"second_body": "deformable"}


def without_followers(values: Mapping[str, Any]) -> dict[str, Any]:
    """The values without those of the second body that are the first one's, and follow it."""
    first = {"far_side": "free", **values}  # that of every run
    return {
        name: value
        for name, value in values.items()
        if not name.startswith("second_") or value != first.get(name.removeprefix("second_"))
    }


def fault_with(law: Friction, values: Mapping[str, Any]) -> Fault:
    """The fault whose f, a, zeta and D at V are those of a law; from values by name.

    Under a remote load it has these constants alone. A ParameterError refuses values of a second
    body that is rigid.
    """
    of_law = {*names_of("law"), *CONSTANTS}
    own = {name: value for name, value in values.items() if name not in of_law}
    if own["second_body"] == "rigid":
        for name, value in own.items():
            if name.startswith("second_") and name != "second_body" and value is not None:
                raise ParameterError(
                    f"{name} = {value!r} is not allowed with second_body = rigid, a base that does "
                    f"not deform: leave {name} out, or make second_body deformable"
                )
    own["far_side"] = "free"
    if own["loading"] == "edge":
        return Fault.from_dict(own | {"friction_law": law})
    f, a, zeta = law.expansion(own["velocity"])
    constants = {"friction": f, "a": a, "zeta": zeta, "slip_distance": law.slip_distance}
    return Fault.from_dict(own | constants | {"evolution": law.evolution})


def starting_values(fault: Fault) -> dict[str, Any]:
    """The parameters of runs that start from a single fault, by name; without infinite heights.

    Those of the second body that are the first one's are left out: they follow it. Raises a
    ParameterError if the fault can't be simulated.
    """
    fault = _simulable(fault)
    found = without_followers(values_of_fault(fault, fault.law()))
    return {name: x for name, x in found.items() if not (isinstance(x, float) and math.isinf(x))}


def _simulable(fault: Fault) -> Fault:
    """The fault with an age; a ParameterError if it is no single one, has a zone, or is held."""
    for name, value in dict(fault).items():
        if name in ZONE:
            raise ParameterError(f"{name} is not allowed: no simulation has a zone")
        if np.ndim(value):
            raise ParameterError(f"{name} has {np.size(value)} values: it must have one here")
    if fault.far_side != "free":
        raise ParameterError(
            f"far_side = {fault.far_side!r} is not allowed: the far side of a simulated block is "
            "free"
        )
    if fault.initial_state is not None or fault.velocity is None:
        return fault
    return fault.replace(initial_state=AGE * fault.slip_distance / fault.velocity)


def sized(fault: Fault, law: Friction | None, values: Mapping[str, Any]) -> dict[str, Any]:
    """All parts of a run of a single fault, from its law and the values that are given, by name.

    Raises a ParameterError if the fault is no single one, has a zone, or lacks what a simulation
    needs.
    """
    of_run = names_of(*PARTS)
    for name in values:
        if name not in of_run:
            raise ParameterError(f"{name} is a parameter of the fault: {_change(name)} changes it")
    law = law or fault.law()
    fault = _simulable(fault)
    found = dict(values)
    try:
        critical = critical_length_of(fault)
    except NoLength as error:
        if "block_length" not in found:
            raise ParameterError(
                f"{error}; a control run, in which nothing is to nucleate, needs its block_length "
                "(m)"
            ) from None
        critical = math.nan
    b = fault.a + fault.zeta
    if "correlation_length" not in found and b > 0.0:
        found["correlation_length"] = roughness_length(fault, b)
    given = by_part(found)
    start, declared = Start(**given["start"]), Perturbation(**given["perturbation"])
    longest = (
        math.nan if math.isnan(critical) else latest_length(fault, law, start, declared, critical)
    )
    if math.isinf(fault.height) or math.isinf(fault.second_height):
        fault, sizes = _as_blocks(fault, law, critical, longest)
        found = sizes | found
    if "block_length" not in found:
        length = max(USUAL_LENGTH * critical, longest / NEAR_END)
        found["block_length"] = rounded(length)
    if "end_time" not in found and not math.isnan(critical):
        found |= late_end(fault, start, longest) | found
    given = by_part(found)
    parts = {part: cls(**given[part]) for part, cls in PARTS.items()}
    return parts | {"fault": fault_with(law, values_of_fault(fault, law)), "law": law}


def _change(name: str) -> str:
    """The expression that gives a fault another value of a parameter which no run has."""
    if table()[name].part == "law" and name not in QUANTITIES and name != "friction_law":
        return f"fault.replace(friction_law=fault.law().changed({{{name!r}: ...}}))"
    return f"fault.replace({_FIELDS.get(name, name)}=...)"


def latest_length(
    fault: Fault, law: Friction, start: Start, declared: Perturbation, critical: float
) -> float:
    """The length (m) by which a fault with L_c (m) has dropped: the larger of L_c and the theory's.

    The theory is asked, which takes a second or two, only where friction weakens so little that its
    L can be beyond L_c.
    """
    if fault.loading != "edge" or longest_reach(fault, critical) <= critical:
        return critical
    return max(critical, reach_of(fault, law, start, declared, critical).latest)


def late_end(fault: Fault, start: Start, longest: float) -> dict[str, float]:
    """An end time after the latest event, and a short time after the event (s).

    The event is due when the patch has its longest length (m), of :func:`latest_length`.
    """
    end = float(f"{_LATEST_END * time_to_length(fault, start, longest):.2g}")
    after = _AFTER_EVENT * fault.slip_distance / fault.velocity
    return {"end_time": end, "time_after_event": min(after, end)}


def rounded(length: float) -> float:
    """A size (m) with four significant digits."""
    return float(f"{length:.4g}")


def _as_blocks(
    fault: Fault, law: Friction, critical: float, longest: float
) -> tuple[Fault, dict[str, Any]]:
    """The fault with blocks in place of half-spaces, and the length and the mesh of the blocks.

    Its L_c and its longest patch are in m.
    """
    if math.isnan(critical):
        raise ParameterError(
            "height = inf m is not allowed: sliding is stable at every wavelength, and the blocks "
            "in place of half-spaces are 4 L_c high; give their height"
        )
    deformable = math.isfinite(fault.second_shear_modulus)
    names = ("height", "second_height") if deformable else ("height",)
    high = rounded(max(HIGH * critical, HIGHER * longest))
    fault = fault.replace(**{name: high for name in names if math.isinf(getattr(fault, name))})
    length = rounded(max(LONG * critical, (high + longest) / THICK_REACH))
    element = zone_length(fault, law) / _ELEMENTS
    number = math.ceil(length / element)
    if (number % 2 == 1) != (fault.loading == "remote"):
        number += 1
    found: dict[str, Any] = {"block_length": length, "n_x": number}
    found["n_y"], found["grading"] = _rows(fault.height, element)
    if deformable:
        found["second_n_y"], found["second_grading"] = _rows(fault.second_height, element)
    return fault, found


def _rows(height: float, element: float) -> tuple[int, float]:
    """Number of elements along y and grading, so that those at the interface have a size (m)."""
    for rows, grading in itertools.product(_ROWS, _GRADINGS):
        if element_height(height, rows, grading) <= element:
            return rows, grading
    return _ROWS[-1], _GRADINGS[-1]


def stiffness_of(fault: Fault) -> tuple[float, float]:
    """How bodies resist slip of wavenumber k: ``thick k`` if they are thick, ``thin k^2`` if thin.

    For a block on a rigid base these are the customary ``mu/(1 - nu)`` (Pa) and ``2 mu H/(1 - nu)``
    (Pa m), in antiplane shear ``mu`` and ``mu H``. For two blocks they are the limits of the
    theory's ``mu k G1``, which are mainly those of the softer one. Two thin blocks also bend, which
    makes them four times as compliant.
    """
    if math.isinf(fault.second_shear_modulus):
        thick = fault.shear_modulus / (1.0 - in_plane_ratio(fault.poisson_ratio, fault.plane))
        sides = 1.0 if fault.plane == ANTIPLANE else 2.0
        return thick, sides * fault.height * thick
    pair = single_system(fault).pair
    heights = fault.height, fault.second_height
    short = SATURATION / min(heights)
    long = _THIN / max(heights)
    resistance = pair.modulus * pair.stiffness(np.array([short, long])).xx
    return float(resistance[0]), float(resistance[1]) / long


def steepness(friction: Friction, omega: float) -> float:
    """How much faster friction weakens with slip at a front than it does by its linearisation.

    `omega` is ``phi V/D`` of the interface that the front reaches; 1 for the aging law.

    Slip at a constant rate reduces Omega from its first value to 1, by ``D dOmega/d delta = g``,
    and friction by ``b log(Omega)``. The fracture energy of this drop is ``b D`` times ``E = int u
    exp(u)/(-g(exp(u))) du`` from 0 to ``U = log(Omega)``. Friction weakens on average at ``(b/D)
    U^2/(2 E)``, and near steady sliding at ``b/D``; the larger of both counts. For the slip law ``E
    = U``; for ``g = (1 - Omega^2)/2`` E is never above pi^2/4.
    """
    if omega <= 1.0 + _NEAR_STEADY:
        return 1.0
    drop = math.log(omega)
    u = 0.5 * drop * (1.0 + _POINTS)
    rates = friction.evolution_law.growth(np.exp(u))
    integrand = u * np.exp(u) / -rates
    energy = 0.5 * drop * float(_WEIGHTS @ integrand)
    return max(drop**2 / (2.0 * energy), 1.0)


def zone_length(fault: Fault, law: Friction, rest: float = 0.0) -> float:
    """Length (m) over which friction at the front weakens; infinite if it does not weaken.

    The interface has been at rest for the time `rest` (s) when the front reaches it; in many laws
    it ages meanwhile.

    The wavelength over 2 pi at which the body's stiffness equals friction's weakening with slip,
    ``s b sigma0/D``, with ``b = a + zeta`` and the :func:`steepness` s of the state evolution: in a
    thick body ``L_b/s``, ``L_b = mu D/((1 - nu) b sigma0)`` (Dieterich, 1992; Rubin and Ampuero,
    2005), in a thin block ``sqrt(2 H L_b/s)``. The smaller of both counts.
    """
    weakening = (fault.a + fault.zeta) * fault.normal_stress
    if weakening <= 0.0:
        return math.inf
    age = fault.initial_state + rest * float(law.evolution_law.growth(_FRESH))
    weakening *= steepness(law, age * fault.velocity / law.slip_distance)
    thick, thin = stiffness_of(fault)
    scale = law.slip_distance / weakening
    return min(thick * scale, math.sqrt(thin * scale))


def time_to_length(fault: Fault, start: Start, length: float) -> float:
    """Time (s) from the start until the creep patch has a length (m), roughly.

    The edge's displacement ``V t`` that moves a patch against ``f sigma0``: ``(1 - nu)/mu f sigma0
    [L^2/(4 H) + L]``. The first term compresses a thin block, the second a thick one. In the
    paper's study the force drops at 0.5 to 0.8 of the time for the theory's critical length.

    Under a remote load it is the time until the whole interface has its peak strength: that of
    sliding at V, plus that of the interface's greater age at the start.
    """
    if fault.loading != "edge":
        if not start.stress_rate > 0.0:
            raise ParameterError(
                f"stress_rate = {start.stress_rate:g} Pa/s is not allowed with loading = "
                f"{fault.loading}, which it drives: it must lie in (0, 1e15) Pa/s"
            )
        omega = fault.initial_state * fault.velocity / fault.slip_distance
        peak = fault.friction + (fault.a + fault.zeta) * np.log1p(omega)
        missing = peak * fault.normal_stress - start.initial_shear_stress
        return max(missing, 0.0) / start.stress_rate
    thick, thin = stiffness_of(fault)
    strength = fault.friction * fault.normal_stress
    moved = length**2 / (2.0 * thin) + length / thick
    return strength * moved / fault.velocity


def element_height(height: float, n_y: int, grading: float) -> float:
    """Height (m) of the elements at the interface of a body that is `height` (m) high."""
    growth = grading ** (1.0 / (n_y - 1))
    return height / sum(growth**row for row in range(n_y))
