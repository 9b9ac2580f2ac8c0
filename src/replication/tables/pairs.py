"""The table of two deformable bodies: patch lengths over the theory with the same far sides."""

from collections.abc import Iterable

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Variable, some, table
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import extract
from nucleation.extraction.growth import FITTED
from nucleation.extraction.measures import MEASURED as EXTRACTED
from nucleation.run.run import Run
from nucleation.theory.closed_forms import bimaterial_contrast, bimaterial_length_ratio

from . import lengths
from .lengths import COLUMNS as LENGTHS
from .lengths import description
from .rows import RATIO_COLUMNS, SHARED, Row, ratios

MEASURED = some(EXTRACTED, "onset_time length length_low length_high")

COLUMNS = {
    **some(LENGTHS, "id study role evolution"),
    **some(
        SHARED,
        "far_side height second_height shear_modulus second_shear_modulus poisson_ratio "
        "second_poisson_ratio friction f_beta zeta_over_a",
    ),
    **some(LENGTHS, "n_x n_y"),
    "second_n_y": Variable("1", "number of elements along y of the second body", "N_y2"),
    **some(LENGTHS, "kind strength seed"),
    **MEASURED,
    "critical_length": LENGTHS["critical_length"],
    "length_ratio": RATIO_COLUMNS["length_ratio"],
    **FITTED,
    "stability_ratio": RATIO_COLUMNS["stability_ratio"],
    "half_space_ratio": Variable(
        "1", "Eq. (9): half-spaces over those without contrast", "L_c/L_c^M"
    ),
    **some(LENGTHS, "steps wall_seconds fault ensemble"),
}
"""``f_beta`` is positive where the lower body is the stiffer one."""


def pair_description(run: Row) -> Row:
    """The columns that describe a run's bodies, interface and perturbation.

    Raises ValueError if it has one body only.
    """
    parameters = Run.from_dict(run["parameters"])
    below = parameters.below
    if below is None:
        raise ValueError("the run has a rigid base: it is no pair")
    own = parameters.fault
    f_beta = own.friction * bimaterial_contrast(parameters.upper.material, below.material)
    zeta_over_a = own.zeta / own.a
    return description(run) | {
        "friction": own.friction,
        "f_beta": f_beta,
        "a": own.a,
        "zeta": own.zeta,
        "second_n_y": below.n_y,
        "half_space_ratio": float(bimaterial_length_ratio(f_beta, zeta_over_a)),
    }


def gather_pairs(
    runs: Iterable[Row],
    simulations: Iterable[xr.Dataset],
    patches: Iterable[xr.Dataset],
    settings: ExtractionSettings,
) -> xr.Dataset:
    """The table of runs of two bodies."""
    rows = []
    waiting = iter(patches)
    fitted: dict[tuple[str, str], dict[str, float]] = {}
    for run, simulation in zip(runs, simulations, strict=True):
        row = pair_description(run)
        fault = row["study"], row["ensemble"]
        if fault not in fitted:
            patch = next(waiting)
            fitted[fault] = {name: float(patch[name]) for name in FITTED}
        measured = extract(simulation, settings)
        row |= fitted[fault]
        row |= {name: float(measured[name]) for name in MEASURED}
        row |= {name: simulation.attrs[name] for name in ("steps", "wall_seconds")}
        rows.append(row | ratios(row))
    return table(rows, COLUMNS)


def over_realisations(table: xr.Dataset) -> xr.Dataset:
    """A table of pairs with one row for each fault, the mean of its ``realisations``.

    ``length_ratio_low`` and ``length_ratio_high`` are the least and the largest of them, without
    the range over definitions that ``length_low`` and ``length_high`` have.
    """
    ratio = table["length_ratio"].values
    faults = [ratio[rows] for rows in lengths.realisations(table)]
    columns = {
        "length_ratio": [fault.mean() for fault in faults],
        "length_ratio_low": [fault.min() for fault in faults],
        "length_ratio_high": [fault.max() for fault in faults],
    }
    on_run = {name: ("run", np.array(values)) for name, values in columns.items()}
    return lengths.over_realisations(table).assign(on_run)
