"""The literature's lengths, each simulated in its own setting and read by its own definition.

Two tall identical bodies, or a low block on a rigid body, slide steadily under a far stress that
rises slowly (``remote``). Nucleation begins where f is lower. The formulas are limits at large slip
rates. The density is so low that the runs have hardly any inertia, and the length of a zone can be
read at slip rates that no fault reaches.
"""

import math
from collections.abc import Iterable, Iterator

import xarray as xr

from nucleation.datasets.variables import Variable, some, table
from nucleation.extraction.measures import DEFINITIONS, far_ahead, zone_length
from nucleation.fault import Fault
from nucleation.lengths.expanding_zone import expanding_length
from nucleation.lengths.formulas import (
    CRACK_LIMIT,
    LOCALISED_FACTOR,
    LOCALISED_LIMIT,
    between_localised_and_crack,
)
from nucleation.lengths.in_use import LENGTHS, values_of
from nucleation.lengths.length import TWO_MATERIALS
from nucleation.run.run import Run

from .rows import SHARED, Row

SLIP_RATES = (1e-4, 1e-2, 1.0, 1e3)  # m/s, at which lengths are read


IN_THE_GAP = (
    "width at half the largest slip rate, times 1.3774/0.7434; "
    f"formula beyond its limit a/b = {LOCALISED_LIMIT}"
)
OTHER_SHARES = {"width_at_half": 0.5, "width_at_hundredth": 0.01}
"""Shares of the largest slip rate, for widths that show how much the definition matters."""

SPRING_BLOCK = "an estimate by a spring block, which has no setting of its own"
ELSEWHERE = {
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
    "name": Variable("", "name of the length, as in Fault.lengths"),
    "evolution": Variable("", "state evolution law"),
    "a": SHARED["a"],
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
    **some(SHARED, "height n_x n_y"),
    "stress_rate": Variable("Pa/s", "rate of the far shear stress"),
    "change": Variable("1", "relative change of f where nucleation begins"),
    "width": SHARED["width"],
}


def length_of(parameters: Run) -> str:
    """Key of the literature's length that a run simulates.

    Between the limits of the aging law's two lengths it is the fixed one.
    """
    friction = parameters.law
    _, a, zeta = friction.expansion(parameters.fault.velocity)
    if friction.evolution == "slip":
        return "state_evolution"
    if parameters.below is None:
        return "thin_layer"
    expands = a > CRACK_LIMIT * (a + zeta)
    return "rubin_ampuero_crack" if expands else "rubin_ampuero_localised"


def literature_table(runs: Iterable[Row], simulations: Iterable[xr.Dataset]) -> xr.Dataset:
    """Simulated lengths beside their formulas, and the lengths that have no run here."""
    rows: list[Row] = []
    for run, simulation in zip(runs, simulations, strict=True):
        parameters = Run.from_dict(run["parameters"])
        rows += _rows(run["id"], parameters, simulation)
    simulated = {row["name"] for row in rows}
    return table([*rows, *_not_simulated(simulated)], COLUMNS)


def _rows(id: str, parameters: Run, simulation: xr.Dataset) -> Iterator[Row]:
    """A run's rows, one for each slip rate."""
    friction = parameters.law
    slip_distance = friction.slip_distance
    own = parameters.fault
    fault = Fault(  # of the formulas
        shear_modulus=own.shear_modulus,
        poisson_ratio=own.poisson_ratio,
        plane=own.plane,
        normal_stress=own.normal_stress,
        a=own.a,
        zeta=own.zeta,
        slip_distance=own.slip_distance,
        height=own.height,
    )
    _, a, zeta = friction.expansion(parameters.fault.velocity)
    b = a + zeta
    name = length_of(parameters)
    expands = name == "rubin_ampuero_crack"
    values = values_of(fault)
    formula = float(values[name])
    definition = DEFINITIONS[name]
    if name == "rubin_ampuero_localised" and between_localised_and_crack(a, b):
        formula = LOCALISED_FACTOR * float(values["state_evolution"])
        definition = definition._replace(words=IN_THE_GAP)
    given = {
        "id": id,
        "name": name,
        "evolution": friction.evolution,
        "a": a,
        "b": b,
        "a_over_b": a / b,
        "definition": definition.words,
        "formula_length": formula,
        "height": parameters.fault.height,
        "n_x": parameters.block.n_x,
        "n_y": parameters.block.n_y,
        "stress_rate": parameters.start.stress_rate,
        "change": parameters.heterogeneity.change,
        "width": parameters.heterogeneity.width,
    }
    for slip_rate in SLIP_RATES:
        found = zone_length(simulation, slip_rate, definition)
        far_slip_rate, far_state_ratio = far_ahead(simulation, slip_rate, slip_distance)
        at_this_rate = expanding_length(fault, slip_rate, far_slip_rate, far_state_ratio)
        row = {
            **given,
            "read_at": slip_rate,
            "simulated_length": found,
            "difference": found / formula - 1.0,
            "far_slip_rate": far_slip_rate,
            "far_state_ratio": far_state_ratio,
            "finite_speed_length": float(at_this_rate) if expands else math.nan,
        }
        for column, share in OTHER_SHARES.items():
            other = definition._replace(part=1.0, share=share)
            row[column] = zone_length(simulation, slip_rate, other)
        yield row


def _not_simulated(simulated: set[str]) -> Iterator[Row]:
    """A row with the reason for each length without a run."""
    empty: Row = {"n_x": 0, "n_y": 0}
    for column, variable in COLUMNS.items():
        empty.setdefault(column, math.nan if variable.units else "")
    for length in LENGTHS:
        if length.key in simulated:
            continue
        reason = ELSEWHERE.get(length.key, "no run of the study is its setting")
        if length.system == TWO_MATERIALS:
            reason = "the formula of one material, with M in the place of mu*"
        yield empty | {"name": length.key, "definition": reason}
