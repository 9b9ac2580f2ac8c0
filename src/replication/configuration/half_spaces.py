"""Half-spaces in simulations and drops: blocks so high and long that their ends hardly matter."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from nucleation.fault import Fault
from nucleation.model.parameters import Geometry, Mesh, Parameters
from nucleation.theory.estimates import process_zone
from nucleation.theory.of_runs import fault_of_run

from .mesh_advice import element_sizes
from .single_run import merged_parameters

HIGH = 4.0
"""Height of the blocks over L_c: their L_s is within 2 % of that of half-spaces."""

LONG = 35.0
"""Length of the blocks over L_c, so that the far end has no effect on the drop."""

LARGEST_ERROR = 0.03
"""Relative difference of L_s above which an answer for half-spaces is doubtful."""

_ELEMENTS = 6.0  # to a process zone, twice as many as resolve the front
_ROWS = (16, 24, 32, 48, 64, 96)  # of elements, that are tried for a block's mesh
_GRADING = 300.0  # the largest of these meshes
_DIGITS = 4  # significant, of sizes

_HEIGHTS = ("height", "second_height")


class Blocks(NamedTuple):
    """The blocks in place of half-spaces, and their effect."""

    height: float  # m
    block_length: float  # m
    stability_length: float  # L_s of the half-spaces (m), NaN if there is none
    difference: float  # relative, of the blocks' L_s

    def in_words(self) -> str:
        """Size and effect in a sentence."""
        size = f"{self.height:.4g} m high and {self.block_length:.4g} m long"
        if math.isnan(self.difference):
            return f"Half-spaces: computed as blocks {size}."
        percent = f"{100.0 * self.difference:+.2g} %"
        return f"Half-spaces: computed as blocks {size}; L_s changes by {percent}."

    @property
    def doubt(self) -> str:
        """Why the blocks are no half-spaces, empty if they are."""
        if not abs(self.difference) > LARGEST_ERROR:
            return ""
        percent = f"{100.0 * self.difference:+.2g} %"
        return f"L_s of the blocks in place of half-spaces differs by {percent}"


def without_half_spaces(
    base: Parameters | None,
    given: Mapping[str, Any],
) -> tuple[dict[str, Any], Blocks | None]:
    """Values with blocks in place of half-spaces.

    Parameters
    ----------
    base : Parameters or None
        The parameters of a run or a dataset; the defaults if None.
    given : mapping
        Values by their names in studies, in SI units; heights may be infinite.

    Returns
    -------
    values : dict
        With finite heights, and with the length and the mesh of the blocks unless they are given.
    blocks : Blocks or None
        None without half-spaces.

    Raises
    ------
    ParameterError
        If a value is wrong.
    """
    infinite = [name for name in _HEIGHTS if math.isinf(given.get(name, 0.0))]
    if not infinite:
        return dict(given), None
    values = dict(given) | dict.fromkeys(infinite, 1.0)
    half_spaces = _with_infinite(fault_of_run(merged_parameters(base, values)), given)
    critical = _length(half_spaces, "critical")
    if math.isnan(critical):
        return values, Blocks(1.0, math.nan, math.nan, math.nan)
    height = _rounded(HIGH * critical)
    values |= dict.fromkeys(infinite, height)
    values.setdefault("block_length", _rounded(LONG * critical))
    parameters = merged_parameters(base, values)
    values = _mesh(parameters) | values
    parameters = merged_parameters(base, values)
    blocks = Fault(**fault_of_run(parameters))
    expected, found = _length(half_spaces, "stability"), _length(blocks, "stability")
    return values, Blocks(height, values["block_length"], expected, found / expected - 1.0)


def _with_infinite(
    fault: dict[str, Any],
    given: Mapping[str, Any],
) -> Fault:
    """A fault with infinite heights; a second height that is left out is the first one."""
    heights = {"height": given.get("height", fault["height"])}
    if "second_height" in fault:
        heights["second_height"] = given.get("second_height", heights["height"])
    return Fault(**fault | heights)


def _length(
    fault: Fault,
    which: str,
) -> float:
    """L_c or L_s (m) of one fault."""
    return float(getattr(fault, f"{which}_length")())


def _rounded(length: float) -> float:
    return float(f"{length:.{_DIGITS}g}")


def _mesh(parameters: Parameters) -> dict[str, Any]:
    """Numbers of elements and grading that resolve the process zone."""
    zone = process_zone(parameters)
    element = zone / _ELEMENTS
    length = parameters.geometry.length
    number = math.ceil(length / element)
    if (number % 2 == 1) != (parameters.loading.kind == "remote"):
        number += 1
    found: dict[str, Any] = {"n_x": number}
    blocks = {"": parameters.geometry}
    if parameters.below is not None:
        blocks["second_"] = parameters.below.geometry
    for prefix, geometry in blocks.items():
        rows, grading = _rows(geometry, element)
        found |= {f"{prefix}n_y": rows, f"{prefix}grading": grading}
    return found


def _rows(
    geometry: Geometry,
    element: float,
) -> tuple[int, float]:
    """Number of elements along y and grading, so that those at the interface have a size (m)."""
    for rows in _ROWS:
        for grading in np.geomspace(1.0, _GRADING, 60).round(1).tolist():
            mesh = Mesh(n_y=rows, grading=grading)
            if element_sizes(mesh, geometry)[1] <= element:
                return rows, grading
    return _ROWS[-1], _GRADING
