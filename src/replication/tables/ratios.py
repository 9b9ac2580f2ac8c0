"""Tables of lengths over the theory's and over those of other runs.

They are the refinement of mesh and steps, the stability of patches, the map over height and
weakening, and two deformable bodies.
"""

from collections.abc import Iterable
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from nucleation.datasets.variables import (
    Column,
    DatasetError,
    annotate,
    columns,
    first,
    rules,
    table,
    to_csv,
)
from nucleation.extraction import definitions
from nucleation.extraction.definitions import FITTED, ExtractionSettings
from nucleation.extraction.extraction import extract
from nucleation.run.run import Run
from nucleation.theory.closed_forms import bimaterial_length_ratio

from . import columns as col
from . import lengths
from .curves import f_beta
from .lengths import description
from .rows import Row

RATIOS = columns(col.LENGTH_RATIO, col.STABILITY_RATIO, col.ZETA_OVER_A)


def ratios(columns: Any) -> Row:
    """:data:`RATIOS` of one row or of a whole table."""
    return {
        "length_ratio": columns["length"] / columns["critical_length"],
        "stability_ratio": columns["stability_length"] / columns["critical_length"],
        "zeta_over_a": columns["zeta"] / columns["a"],
    }


# -- refinement ---------------------------------------------------------------------------------

REFINED = {"n_x": False, "n_y": False, "longest_step": True, "tolerance": True}
"""Parameters that are refined, and whether a smaller value is the finer one."""

FIXED = ("grading", "block_length", "fault", "kind", "strength", "correlation_length", "seed")
"""Columns in which the runs of a sequence agree, beside the other refined parameters."""

REFINEMENT = columns(
    Column("refinement", "", "quantity that is refined from level to level"),
    col.ID,
    col.EVOLUTION,
    col.HEIGHT,
    col.INITIAL_STATE,
    col.KIND,
    col.STRENGTH,
    col.SEED,
    col.N_X,
    col.N_Y,
    col.GRADING,
    col.BLOCK_LENGTH,
    col.LONGEST_STEP,
    col.TOLERANCE,
    definitions.ONSET_TIME,
    Column("onset_difference", "1", "relative difference of the onset from the finest run"),
    definitions.LENGTH,
    Column("length_difference", "1", "relative difference of L from the finest run"),
    Column("elements_difference", "1", "the same in elements of the run along x"),
    col.CRITICAL_LENGTH,
    Column("length_over_theory", "1", "length at the drop over that of the theory", "L/L_c"),
    col.STEPS,
    col.WALL_SECONDS,
    col.FAULT,
)


def sequences(lengths: pd.DataFrame, refined: str) -> list[pd.DataFrame]:
    """The runs that differ in one numerical parameter alone, each from coarse to fine."""
    fixed = [*(name for name in REFINED if name != refined), *FIXED]
    ascending = not REFINED[refined]
    return [
        own.sort_values(refined, ascending=ascending)
        for _, own in lengths.groupby(fixed, sort=False, dropna=False)
        if len(own) > 1
    ]


def refinement_table(tables: Iterable[xr.Dataset]) -> xr.Dataset:
    """The sequences found in tables of lengths, each run beside the finest one."""
    frame = lengths.join(tables).to_dataframe()
    rows: list[Any] = []
    for refined in REFINED:
        for own in sequences(frame, refined):
            finest = own.iloc[-1]
            difference = own["length"] - finest["length"]
            found = own.assign(
                refinement=refined,
                onset_difference=own["onset_time"] / finest["onset_time"] - 1.0,
                length_difference=own["length"] / finest["length"] - 1.0,
                elements_difference=difference / (own["block_length"] / own["n_x"]),
                length_over_theory=own["length"] / own["critical_length"],
            )
            rows += found.to_dict("records")
    return table(rows, REFINEMENT)


# -- the stability of patches -------------------------------------------------------------------

STABILITY = columns(
    col.ID,
    col.STUDY,
    col.ROLE,
    col.EVOLUTION,
    col.HEIGHT,
    col.INITIAL_STATE,
    col.N_X,
    col.N_Y,
    col.GRADING,
    col.TOLERANCE,
    col.LONGEST_STEP,
    definitions.STABILITY_LENGTH,
    definitions.STABILITY_LENGTH_LOW,
    definitions.STABILITY_LENGTH_HIGH,
    definitions.STABILITY_LENGTH_ERROR,
    definitions.STABILITY_FREQUENCY,
    col.CRITICAL_LENGTH,
    col.STABILITY_RATIO,
    Column("stability_change", "1", "L_s over that of the converged run, minus one"),
    col.FAULT,
)


def gather_stability(runs: Iterable[Row], patches: Iterable[xr.Dataset]) -> xr.Dataset:
    """The lengths at which the frozen patches turn unstable."""
    rows = []
    for run, patch in zip(runs, patches, strict=True):
        rows.append(description(run) | {name: float(patch[name]) for name in FITTED})
    converged = {
        row["fault"]: row["stability_length"] for row in rows if row["role"] == "converged"
    }
    for row in rows:
        reference = converged.get(row["fault"], float("nan"))
        row["stability_ratio"] = row["stability_length"] / row["critical_length"]
        row["stability_change"] = row["stability_length"] / reference - 1.0
    return table(rows, STABILITY)


# -- the map ------------------------------------------------------------------------------------

MAP = columns(
    col.ID,
    col.HEIGHT,
    col.ZETA_OVER_A,
    col.KIND,
    col.STRENGTH,
    col.SEED,
    definitions.ONSET_TIME,
    definitions.LENGTH,
    definitions.LENGTH_LOW,
    definitions.LENGTH_HIGH,
    col.CRITICAL_LENGTH,
    col.LENGTH_RATIO,
    definitions.STABILITY_LENGTH,
    col.STABILITY_RATIO,
    col.N_X,
    col.STEPS,
    col.WALL_SECONDS,
    col.STATUS,
)

AXES = ("height", "zeta_over_a", "strength", "seed")
"""Dimensions of the map's grid."""

ON_GRID = ["length", "length_ratio", "stability_length", "stability_ratio", "onset_time"]

DIGITS = 6
"""Significant digits by which values of zeta/a are equal."""


def map_files(lengths: xr.Dataset) -> dict[str, Any]:
    """:data:`MAP` of a table of lengths with the stability of each patch as CSV, and on the grid.

    The grid has the dimensions :data:`AXES`, and NaN where the study has no run. The theory's
    length depends on height and weakening alone.
    """
    rows = lengths.assign(ratios(lengths))
    rounded = [float(f"{value:.{DIGITS}g}") for value in rows["zeta_over_a"].values]
    rows = annotate(rows.assign(zeta_over_a=("run", rounded))[list(MAP)].drop_attrs(), MAP)
    frame = rows.to_dataframe().set_index(list(AXES))
    if not frame.index.is_unique:
        raise DatasetError(f"runs of the map differ in more than {', '.join(AXES)}")
    theory = frame["critical_length"].groupby(level=AXES[:2]).first()
    grid = frame[ON_GRID].to_xarray().assign(critical_length=theory.to_xarray())
    return {".nc": annotate(grid, MAP), ".csv": to_csv(rows)}


# -- two bodies ---------------------------------------------------------------------------------

_OF_RUN = ("onset_time", "length", "length_low", "length_high")

PAIRS = columns(
    col.ID,
    col.STUDY,
    col.ROLE,
    col.EVOLUTION,
    col.FAR_SIDE,
    col.HEIGHT,
    col.SECOND_HEIGHT,
    col.SHEAR_MODULUS,
    col.SECOND_SHEAR_MODULUS,
    col.POISSON_RATIO,
    col.SECOND_POISSON_RATIO,
    col.FRICTION,
    col.F_BETA,
    col.ZETA_OVER_A,
    col.N_X,
    col.N_Y,
    Column(
        "second_n_y",
        "1",
        "number of elements along y of the second body",
        "N_y2",
        realisations=first,
    ),
    col.KIND,
    col.STRENGTH,
    col.SEED,
    definitions.ONSET_TIME,
    definitions.LENGTH,
    definitions.LENGTH_LOW,
    definitions.LENGTH_HIGH,
    col.CRITICAL_LENGTH,
    col.LENGTH_RATIO,
    definitions.STABILITY_LENGTH,
    definitions.STABILITY_LENGTH_LOW,
    definitions.STABILITY_LENGTH_HIGH,
    definitions.STABILITY_LENGTH_ERROR,
    definitions.STABILITY_FREQUENCY,
    col.STABILITY_RATIO,
    Column(
        "half_space_ratio",
        "1",
        "Eq. (9): half-spaces over those without contrast",
        "L_c/L_c^M",
        realisations=first,
    ),
    col.STEPS,
    col.WALL_SECONDS,
    col.FAULT,
    col.ENSEMBLE,
)
"""``f_beta`` is positive where the lower body is the stiffer one."""

_PAIR_RULES = rules(PAIRS) | {"length_ratio_low": np.min, "length_ratio_high": np.max}


def gather_pairs(
    runs: Iterable[Row],
    simulations: Iterable[xr.Dataset],
    patches: Iterable[xr.Dataset],
    settings: ExtractionSettings,
) -> xr.Dataset:
    """The table of runs of two bodies; `patches` are those of each fault's first run."""
    rows = []
    waiting = iter(patches)
    fitted: dict[tuple[str, str], dict[str, float]] = {}
    for run, simulation in zip(runs, simulations, strict=True):
        parameters = Run.from_dict(run["parameters"])
        own, coupling = parameters.fault, f_beta(parameters)
        row = description(run) | {
            "friction": own.friction,
            "f_beta": coupling,
            "a": own.a,
            "zeta": own.zeta,
            "second_n_y": parameters.block.second_n_y or parameters.block.n_y,
            "half_space_ratio": float(bimaterial_length_ratio(coupling, own.zeta / own.a)),
        }
        key = row["study"], row["ensemble"]
        if key not in fitted:
            patch = next(waiting)
            fitted[key] = {name: float(patch[name]) for name in FITTED}
        measured = extract(simulation, settings)
        row |= fitted[key]
        row |= {name: float(measured[name]) for name in _OF_RUN}
        row |= {name: simulation.attrs[name] for name in ("steps", "wall_seconds")}
        rows.append(row | ratios(row))
    return table(rows, PAIRS)


def pairs_over_realisations(table: xr.Dataset) -> xr.Dataset:
    """A table of pairs with one row for each fault, the mean of its ``realisations``.

    ``length_ratio_low`` and ``length_ratio_high`` are the least and the largest of them, without
    the range over definitions that ``length_low`` and ``length_high`` have.
    """
    ratio = table["length_ratio"]
    ranged = table.assign(length_ratio_low=ratio, length_ratio_high=ratio)
    return lengths.over_realisations(ranged, _PAIR_RULES)
