"""The table of two deformable bodies: lengths of the patch over the theory of the own far sides."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..analysis import lengths
from ..analysis.definitions import ExtractionSettings
from ..analysis.extraction import MEASURED as EXTRACTED
from ..analysis.extraction import extract
from ..analysis.lengths import COLUMNS as LENGTHS
from ..analysis.lengths import description
from ..analysis.rows import RATIO_COLUMNS, ratios
from ..datasets.shared import SHARED
from ..datasets.variables import Variable, some, table
from ..model.linearised import linearised
from ..model.parameters import Parameters
from ..theory.closed_forms import bimaterial_contrast, bimaterial_length_ratio
from .growth import FITTED

MEASURED = some(EXTRACTED, "onset_time", "length", "length_low", "length_high")

COLUMNS = {
    **some(LENGTHS, "id", "study", "role", "evolution"),
    **some(
        SHARED, "far_side", "height", "second_height", "shear_modulus", "second_shear_modulus",
        "poisson_ratio", "second_poisson_ratio", "friction", "f_beta", "zeta_over_a",
    ),
    **some(LENGTHS, "n_x", "n_y"),
    "second_n_y": Variable("1", "number of elements along y of the second body", "N_y2"),
    **some(LENGTHS, "kind", "strength", "seed"),
    **MEASURED,
    "theory_length": LENGTHS["theory_length"],
    "length_ratio": RATIO_COLUMNS["length_ratio"],
    **FITTED,
    "stability_ratio": RATIO_COLUMNS["stability_ratio"],
    "half_space_ratio": Variable(
        "1", "Eq. (9): half-spaces over those without contrast", "L_c/L_c^M"
    ),
    **some(LENGTHS, "steps", "wall_seconds", "fault", "ensemble"),
}  # fmt: skip
"""``f_beta`` is positive where the lower body is the stiffer one."""


def pair_description(run: dict[str, Any]) -> dict[str, Any]:
    """The columns that say which bodies, interface and perturbation a run has.

    Raises ValueError if it has one body only.
    """
    parameters = Parameters.from_dict(run["parameters"])
    if parameters.below is None:
        raise ValueError("the run has a rigid base: it is no pair")
    interface = linearised(parameters.friction, parameters.loading)
    contrast = bimaterial_contrast(parameters.material, parameters.below.material)
    f_beta = interface.friction * contrast
    return description(run) | {
        "friction": interface.friction,
        "f_beta": f_beta,
        "direct_effect": interface.a,
        "velocity_weakening": interface.zeta,
        "second_n_y": parameters.below.mesh.n_y,
        "half_space_ratio": float(bimaterial_length_ratio(f_beta, interface.zeta / interface.a)),
    }


def gather(
    runs: Iterable[dict[str, Any]],
    simulations: Iterable[xr.Dataset],
    patches: Iterable[xr.Dataset],
    settings: ExtractionSettings,
) -> xr.Dataset:
    """The table of runs of two bodies, with their simulations in the same order.

    `patches` are those of each fault's first realisation (:func:`.growth.follow_patch`); the others
    have its L_s, which the perturbation hardly moves.
    """
    rows, waiting, fitted = [], iter(patches), {}
    for run, simulation in zip(runs, simulations, strict=True):
        row, measured = pair_description(run), extract(simulation, settings)
        own = row["study"], row["ensemble"]
        if own not in fitted:
            patch = next(waiting)
            fitted[own] = {name: float(patch[name]) for name in FITTED}
        row |= fitted[own] | {name: float(measured[name]) for name in MEASURED}
        row |= {name: simulation.attrs[name] for name in ("steps", "wall_seconds")}
        rows.append(row | ratios(row))
    return table(rows, COLUMNS)


def over_realisations(table: xr.Dataset) -> xr.Dataset:
    """A table of pairs with one row for each fault, the mean of its ``realisations``.

    ``length_ratio_low`` and ``length_ratio_high`` are the least and the largest of them, without
    the range over definitions that ``length_low`` and ``length_high`` have.
    """
    ratio = [table["length_ratio"].values[rows] for rows in lengths.realisations(table)]
    return lengths.over_realisations(table).assign(
        length_ratio=("run", np.array([own.mean() for own in ratio])),
        length_ratio_low=("run", np.array([own.min() for own in ratio])),
        length_ratio_high=("run", np.array([own.max() for own in ratio])),
    )


def chosen(table: xr.Dataset, rows: NDArray[np.bool_]) -> xr.Dataset:
    """Some rows of the table, True where they are wanted."""
    return table.isel(run=np.flatnonzero(rows))


def of_role(table: xr.Dataset, role: str) -> xr.Dataset:
    """The rows of the studies with one role."""
    return chosen(table, table["role"].values == role)
