"""The literature's lengths, each simulated in its own setting and read by its own definition.

Two tall identical bodies, or a low block on a rigid body, slide steadily under a far stress that
rises slowly (``remote``). Nucleation begins where f is lower. The formulas are asymptotes at slip
rates without bound. There is next to no inertia, so a zone's length is read up to slip rates that
no fault reaches.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..answers.formulas import (
    CRACK_LIMIT,
    LOCALISED_FACTOR,
    LOCALISED_LIMIT,
    between_localised_and_crack,
)
from ..answers.in_use import LENGTHS, TWO_MATERIALS, expanding_length, values_of
from ..datasets.shared import SHARED
from ..datasets.variables import Variable, some, table
from ..model.parameters import Parameters
from ..theory.fault import Fault
from ..types import Array
from .definitions import slipping_zone
from .rows import Row

SLIP_RATES = (1e-4, 1e-2, 1.0, 1e3)  # m/s, at which lengths are read


class Definition(NamedTuple):
    """How a simulated length is read: the zone that slips faster than a share of the fastest."""

    share: float
    part: float  # the zone's part of the whole length in the source's own solution
    words: str
    between_tips: bool = False  # slip may be slower within the zone, as in a crack


DEFINITIONS = {
    "rubin_ampuero_localised": Definition(
        0.5, 0.7434 / 1.3774, "width at half the largest slip rate, times 1.3774/0.7434"
    ),
    "rubin_ampuero_crack": Definition(
        0.1,
        1.0,
        "distance of the outermost points at a tenth of the largest slip rate",
        between_tips=True,
    ),
    "thin_layer": Definition(0.5, 0.5, "twice the width at half the largest slip rate"),
    "state_evolution": Definition(0.5, 1.0, "width at half the largest slip rate"),
}
"""Of Rubin and Ampuero's solution 0.7434 L_b either side are faster than half its maximum; of
Viesca's, ``1 + cos(x/L)``, one half."""

IN_THE_GAP = (
    "width at half the largest slip rate, times 1.3774/0.7434; "
    f"formula beyond its limit a/b = {LOCALISED_LIMIT}"
)
OTHER_SHARES = {"width_at_half": 0.5, "width_at_hundredth": 0.01}
"""Of the largest slip rate: how much the definition matters."""

SPRING_BLOCK = "an estimate by a spring block, which has no setting of its own"
ELSEWHERE = {
    "creeping_patch": "simulated with role patch_theory: patch_theory.csv",
    "homogeneous_sliding": "growth of single modes is simulated in dispersion.csv",
    "rice_ruina": SPRING_BLOCK,
    "dieterich_shortest": SPRING_BLOCK,
    "dieterich_longest": SPRING_BLOCK,
    "uenishi_rice": "the limit a -> 0 of the pinned patch; with a direct effect, which every law "
    "here has, an accelerating zone widens beyond it to the fixed length",
    "creeping_asperity": "rigid surroundings are a limit: others are in weakening_patches.csv",
    "loaded_patch": "pinned ends; equal to the theory of the creeping patch under remote",
    "thin_limit": "the limit of homogeneous sliding in low blocks",
}
"""Why a length is not among the simulated ones."""

COLUMNS = {
    "id": SHARED["id"],
    "name": Variable("", "name of the length, as in lengths_in_use"),
    "evolution": Variable("", "state evolution law"),
    "a": SHARED["direct_effect"],
    "b": Variable("1", "coefficient of the logarithm of the state", "b"),
    "a_over_b": Variable("1", "direct effect over b", "a/b"),
    "definition": Variable("", "how the simulated length is read, or why it is not simulated"),
    "read_at": Variable("m/s", "largest slip rate at which the length is read"),
    "formula_length": Variable("m", "length by the formula"),
    "simulated_length": Variable("m", "length in the simulation"),
    "difference": Variable("1", "simulated length over that of the formula, less 1"),
    "width_at_half": Variable("m", "width of the zone at half the largest slip rate"),
    "width_at_hundredth": Variable(
        "m", "width of the zone at a hundredth of the largest slip rate"
    ),
    "far_slip_rate": Variable("m/s", "slip rate half a period from the fastest point"),
    "far_state_ratio": Variable("1", "v phi/D there, 1 in steady sliding"),
    "finite_speed_length": Variable("m", "Rubin and Ampuero's expanding length at that slip rate"),
    **some(SHARED, "height", "n_x", "n_y"),
    "stress_rate": Variable("Pa/s", "rate of the far shear stress"),
    "change": Variable("1", "relative change of f where nucleation begins"),
    "width": Variable("m", "full width of that change at half its height"),
}


def length_of(parameters: Parameters) -> str:
    """The length of the literature whose setting a run is.

    Between both lengths of the aging law it is the fixed one, beyond its limit.
    """
    _, a, zeta = parameters.friction.expansion(parameters.loading.velocity)
    if parameters.friction.evolution == "slip":
        return "state_evolution"
    if parameters.second_body.kind == "rigid":
        return "thin_layer"
    expands = a > CRACK_LIMIT * (a + zeta)
    return "rubin_ampuero_crack" if expands else "rubin_ampuero_localised"


def zone_length(simulation: xr.Dataset, slip_rate: float, definition: Definition) -> float:
    """Length (m) of the accelerating zone when its largest slip rate passes a value (m/s).

    Between recorded times it is linear in the logarithm of the largest slip rate. NaN if that is
    not reached.
    """
    x = simulation["x"].values

    def width(rates: Array, states: Array) -> float:
        threshold = definition.share * float(rates.max())
        if definition.between_tips:
            rates = _filled_between_tips(rates)
        begin, end = slipping_zone(x, rates, threshold, periodic=True)
        return (end - begin) / definition.part

    return _when_passing(simulation, slip_rate, width)


def _filled_between_tips(rates: Array) -> Array:
    """Slip rates of a period, nowhere slower than both on the left and on the right of there."""
    first = _opposite(rates)
    around = np.roll(rates[:-1], -first)
    from_left = np.maximum.accumulate(around)
    from_right = np.maximum.accumulate(around[::-1])[::-1]
    filled = np.roll(np.minimum(from_left, from_right), first)
    return np.append(filled, filled[0])


def far_ahead(
    simulation: xr.Dataset, slip_rate: float, slip_distance: float
) -> tuple[float, float]:
    """Slip rate (m/s) and ``v phi/D`` half a period from the fastest point.

    Parameters
    ----------
    simulation : Dataset
        With the slip rates and states of the interface on (time, x).
    slip_rate : float
        The largest slip rate (m/s) at the instant that is meant.
    slip_distance : float
        D (m).

    Returns
    -------
    tuple of float
        NaN if that slip rate is not reached, or if the fault is stuck there.
    """

    def far_slip_rate(rates: Array, states: Array) -> float:
        return float(rates[_opposite(rates)])

    def far_state(rates: Array, states: Array) -> float:
        return float(states[_opposite(rates)])

    rate = _when_passing(simulation, slip_rate, far_slip_rate)
    if not rate > 0.0:  # slip rates of a stuck fault are not recorded
        return math.nan, math.nan
    return rate, rate * _when_passing(simulation, slip_rate, far_state) / slip_distance


def _opposite(rates: Array) -> int:
    """The node half a period from the fastest; the first and the last node are the same."""
    period = rates.size - 1
    return (int(rates.argmax()) + period // 2) % period


def _when_passing(
    simulation: xr.Dataset, slip_rate: float, measure: Callable[[Array, Array], float]
) -> float:
    """What is measured of slip rates and states when the largest rate passes a value (m/s)."""
    rates = np.abs(simulation["slip_rate"].values.astype(float))
    fastest = rates.max(axis=1)
    above = np.flatnonzero(fastest >= slip_rate)
    if not above.size or above[0] == 0:
        return math.nan
    pair = [above[0] - 1, above[0]]
    states = simulation["state"].values
    measured = [measure(rates[i], states[i]) for i in pair]
    return float(np.interp(np.log(slip_rate), np.log(fastest[pair]), measured))


def literature_table(
    runs: Iterable[dict[str, Any]], simulations: Iterable[xr.Dataset]
) -> xr.Dataset:
    """Simulated lengths beside their formulas, and the lengths that have no run here.

    Parameters
    ----------
    runs : from :meth:`nucleation.configuration.runs.Run.to_dict`.
    simulations : theirs, in the same order.

    Returns
    -------
    Dataset
        On ``run``, :data:`COLUMNS`: one row for each run and each of :data:`SLIP_RATES` (m/s),
        then one for each of the other lengths in use, with the reason in ``definition``.
    """
    rows: list[Row] = []
    for run, simulation in zip(runs, simulations, strict=True):
        rows += _rows(run["id"], Parameters.from_dict(run["parameters"]), simulation)
    return table([*rows, *_not_simulated({row["name"] for row in rows})], COLUMNS)


def _rows(id: str, parameters: Parameters, simulation: xr.Dataset) -> Iterator[Row]:
    """A run's rows, one for each slip rate."""
    name = length_of(parameters)
    friction, load, material = parameters.friction, parameters.loading, parameters.material
    _, a, zeta = friction.expansion(load.velocity)
    fault = Fault(
        shear_modulus=material.shear_modulus, poisson_ratio=material.poisson_ratio,
        plane=material.plane, normal_stress=load.normal_stress, a=a, zeta=zeta,
        slip_distance=friction.characteristic_slip_distance, height=parameters.geometry.height,
    )  # fmt: skip
    values = values_of(fault)
    formula = float(values[name])
    definition = DEFINITIONS[name]
    if name == "rubin_ampuero_localised" and between_localised_and_crack(a, a + zeta):
        formula = LOCALISED_FACTOR * float(values["state_evolution"])
        definition = definition._replace(words=IN_THE_GAP)
    for slip_rate in SLIP_RATES:
        found = zone_length(simulation, slip_rate, definition)
        far_slip_rate, far_state_ratio = far_ahead(
            simulation, slip_rate, friction.characteristic_slip_distance
        )
        at_this_rate = expanding_length(fault, slip_rate, far_slip_rate, far_state_ratio)
        expands = name == "rubin_ampuero_crack"
        whole = definition._replace(part=1.0)
        widths = {
            column: zone_length(simulation, slip_rate, whole._replace(share=share))
            for column, share in OTHER_SHARES.items()
        }
        yield {
            "id": id,
            "name": name,
            "evolution": friction.evolution,
            "a": a,
            "b": a + zeta,
            "a_over_b": a / (a + zeta),
            "definition": definition.words,
            "read_at": slip_rate,
            "formula_length": formula,
            "simulated_length": found,
            "difference": found / formula - 1.0,
            **widths,
            "far_slip_rate": far_slip_rate,
            "far_state_ratio": far_state_ratio,
            "finite_speed_length": float(at_this_rate) if expands else math.nan,
            "height": parameters.geometry.height,
            "n_x": parameters.mesh.n_x,
            "n_y": parameters.mesh.n_y,
            "stress_rate": load.stress_rate,
            "change": parameters.heterogeneity.change,
            "width": parameters.heterogeneity.width,
        }


def _not_simulated(simulated: set[str]) -> Iterator[Row]:
    """A row with the reason for each length without a run."""
    empty = {name: "" if not c.units else math.nan for name, c in COLUMNS.items()}
    empty |= {"n_x": 0, "n_y": 0}
    for length in LENGTHS:
        if length.key not in simulated:
            reason = ELSEWHERE.get(length.key, "no run of the study is its setting")
            if length.system == TWO_MATERIALS:
                reason = "the formula of one material, with M in the place of mu*"
            yield empty | {"name": length.key, "definition": reason}
