"""The literature's lengths, each simulated in its own setting and read by its own definition.

Two tall identical bodies, or a low block on a rigid body, slide steadily under a far stress that
rises slowly (``remote``). Nucleation begins where f is lower. The formulas are limits at large slip
rates. The density is so low that the runs have hardly any inertia, and the length of a zone can be
read at slip rates that no fault reaches.
"""

import math
from collections.abc import Iterable
from typing import Any

import xarray as xr

from nucleation.datasets.variables import Column, columns, table
from nucleation.extraction.measures import DEFINITIONS, far_ahead, zone_length
from nucleation.fault import Fault
from nucleation.lengths.formulas import (
    CRACK_LIMIT,
    LOCALISED_FACTOR,
    LOCALISED_LIMIT,
    between_localised_and_crack,
)
from nucleation.lengths.in_use import expanding_length, values_of
from nucleation.run.run import Run

from . import columns as col
from .rows import Row

SLIP_RATES = (1e-4, 1e-2, 1.0, 1e3)  # m/s, at which lengths are read

_OF_FORMULAS = (
    *("shear_modulus", "poisson_ratio", "plane", "normal_stress"),
    *("a", "zeta", "slip_distance", "height"),
)

IN_THE_GAP = (
    "width at half the largest slip rate, times 1.3774/0.7434; "
    f"formula beyond its limit a/b = {LOCALISED_LIMIT}"
)
OTHER_SHARES = {"width_at_half": 0.5, "width_at_hundredth": 0.01}
"""Shares of the largest slip rate, for widths that show how much the definition matters."""

COLUMNS = columns(
    col.ID,
    Column("name", "", "name of the length, as in Fault.lengths"),
    col.EVOLUTION,
    col.A,
    Column("b", "1", "coefficient of the logarithm of the state", "b"),
    Column("a_over_b", "1", "direct effect over b", "a/b"),
    Column("definition", "", "how the simulated length is read"),
    Column("read_at", "m/s", "largest slip rate at which the length is read"),
    Column("formula_length", "m", "length by the formula"),
    Column("simulated_length", "m", "length in the simulation"),
    Column("difference", "1", "simulated length over that of the formula, less 1"),
    Column("width_at_half", "m", "width of the zone at half the largest slip rate"),
    Column("width_at_hundredth", "m", "width of the zone at a hundredth of the largest slip rate"),
    Column("far_slip_rate", "m/s", "slip rate half a period from the fastest point"),
    Column("far_state_ratio", "1", "v phi/D there, 1 in steady sliding"),
    Column("finite_speed_length", "m", "Rubin and Ampuero's expanding length at that slip rate"),
    col.HEIGHT,
    col.N_X,
    col.N_Y,
    Column("stress_rate", "Pa/s", "rate of the far shear stress"),
    Column("change", "1", "relative change of f where nucleation begins"),
    col.WIDTH,
)


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
    """Simulated lengths beside their formulas: a row for each run and slip rate."""
    rows = []
    for run, simulation in zip(runs, simulations, strict=True):
        parameters = Run.from_dict(run["parameters"])
        described, fault, definition = _described(parameters)
        is_crack = described["name"] == "rubin_ampuero_crack"
        for slip_rate in SLIP_RATES:
            found = zone_length(simulation, slip_rate, definition)
            far = far_ahead(simulation, slip_rate, parameters.law.slip_distance)
            expanding = expanding_length(fault, slip_rate, *far) if is_crack else math.nan
            row = {
                **described,
                "id": run["id"],
                "read_at": slip_rate,
                "simulated_length": found,
                "difference": found / described["formula_length"] - 1.0,
                "far_slip_rate": far[0],
                "far_state_ratio": far[1],
                "finite_speed_length": float(expanding),
            }
            for column, share in OTHER_SHARES.items():
                other = definition._replace(part=1.0, share=share)
                row[column] = zone_length(simulation, slip_rate, other)
            rows.append(row)
    return table(rows, COLUMNS)


def _described(parameters: Run) -> tuple[Row, Fault, Any]:
    """The columns of all slip rates, the fault of the formulas, and how the length is read."""
    own, law, varies = parameters.fault, parameters.law, parameters.heterogeneity
    fault = Fault(**{name: getattr(own, name) for name in _OF_FORMULAS})
    _, a, zeta = law.expansion(own.velocity)
    b = a + zeta
    name = length_of(parameters)
    values = values_of(fault)
    formula = float(values[name])
    definition = DEFINITIONS[name]
    if name == "rubin_ampuero_localised" and between_localised_and_crack(a, b):
        formula = LOCALISED_FACTOR * float(values["state_evolution"])
        definition = definition._replace(words=IN_THE_GAP)
    row = {
        "name": name,
        "evolution": law.evolution,
        "a": a,
        "b": b,
        "a_over_b": a / b,
        "definition": definition.words,
        "formula_length": formula,
        "height": own.height,
        "n_x": parameters.block.n_x,
        "n_y": parameters.block.n_y,
        "stress_rate": parameters.start.stress_rate,
        "change": varies.change,
        "width": varies.width,
    }
    return row, fault, definition
