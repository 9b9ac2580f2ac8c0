"""The table of two deformable bodies: lengths of the patch over the theory of the own far sides."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..analysis import lengths
from ..analysis.definitions import ExtractionSettings
from ..analysis.extraction import extract
from ..analysis.lengths import description
from ..analysis.record import parameters_of
from ..analysis.rows import ratios
from ..model.linearised import linearised
from ..model.parameters import Parameters
from ..theory.closed_forms import bimaterial_contrast, bimaterial_length_ratio
from .growth import FITTED

MEASURED = ("onset_time", "length", "length_low", "length_high")

COLUMNS = (
    "id", "study", "law", "far_side", "height", "second_height", "shear_modulus",
    "second_shear_modulus", "poisson_ratio", "second_poisson_ratio", "friction", "f_beta",
    "zeta_over_a", "n_x", "n_y", "second_n_y", "kind", "strength", "seed", *MEASURED,
    "theory_length", "length_ratio", *FITTED, "stability_ratio", "half_space_ratio", "steps",
    "wall_seconds",
)  # fmt: skip
"""``f_beta`` is positive where the lower body is the stiffer one."""


def pair_description(parameters: Parameters) -> dict[str, Any]:
    """The columns that say which bodies and which perturbation a run has.

    Raises
    ------
    ValueError
        If the run has one body only.
    """
    below = parameters.below
    if below is None:
        raise ValueError("the run has a rigid base: it is no pair")
    interface = linearised(parameters.friction, parameters.loading)
    declared = parameters.perturbation
    f_beta = interface.friction * bimaterial_contrast(parameters.material, below.material)
    return {
        "far_side": below.bottom,
        "second_height": below.geometry.height,
        "shear_modulus": parameters.material.shear_modulus,
        "second_shear_modulus": below.material.shear_modulus,
        "poisson_ratio": parameters.material.poisson_ratio,
        "second_poisson_ratio": below.material.poisson_ratio,
        "friction": interface.friction,
        "f_beta": f_beta,
        "direct_effect": interface.a,
        "velocity_weakening": interface.zeta,
        "second_n_y": below.mesh.n_y,
        "kind": declared.kind,
        "strength": declared.strength,
        "seed": declared.seed,
        "half_space_ratio": float(bimaterial_length_ratio(f_beta, interface.zeta / interface.a)),
    }


def gather(
    runs: Iterable[dict[str, Any]],
    simulations: Iterable[xr.Dataset],
    patches: Iterable[xr.Dataset],
    settings: ExtractionSettings,
) -> xr.Dataset:
    """The table of runs of two bodies.

    Parameters
    ----------
    runs : from :meth:`nucleation.configuration.studies.Run.to_dict`.
    simulations : of the runs, in their order.
    patches : of :func:`.growth.follow_patch`, of each fault's first realisation in the same order;
        the others have its L_s, which the perturbation hardly moves.
    settings : how lengths are read.
    """
    rows, waiting, fitted = [], iter(patches), {}
    for run, simulation in zip(runs, simulations, strict=True):
        parameters, measured = parameters_of(simulation), extract(simulation, settings)
        fault = run["study"], parameters.replaced({"perturbation.seed": 0})
        if fault not in fitted:
            patch = next(waiting)
            fitted[fault] = {name: float(patch[name]) for name in FITTED}
        row = description(run) | pair_description(parameters) | fitted[fault]
        row |= {name: float(measured[name]) for name in MEASURED}
        row |= {name: simulation.attrs[name] for name in ("steps", "wall_seconds")}
        rows.append(row | ratios(row))
    return xr.Dataset({name: ("run", [row[name] for row in rows]) for name in COLUMNS})


def over_realisations(table: xr.Dataset) -> xr.Dataset:
    """A table of pairs with one row for each fault, the mean of its realisations.

    ``length_ratio_low`` and ``length_ratio_high`` are the least and the largest of them, without
    the range over definitions that ``length_low`` and ``length_high`` have; ``realisations`` counts
    them.
    """
    given = table.drop_vars("length_ratio")
    ratio = [table["length_ratio"].values[rows] for rows in lengths.realisations(given)]
    return lengths.over_realisations(given).assign(
        length_ratio=("run", np.array([own.mean() for own in ratio])),
        length_ratio_low=("run", np.array([own.min() for own in ratio])),
        length_ratio_high=("run", np.array([own.max() for own in ratio])),
    )


def chosen(table: xr.Dataset, rows: NDArray[np.bool_]) -> xr.Dataset:
    """Some rows of the table, True where they are wanted."""
    return table.isel(run=np.flatnonzero(rows))


def of_study(table: xr.Dataset, study: str) -> xr.Dataset:
    """The rows of one study."""
    return chosen(table, table["study"].values == study)
