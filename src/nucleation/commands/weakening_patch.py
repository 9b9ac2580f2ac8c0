"""A weakening patch among strengthening surroundings, for ``nucleation length``."""

import math
from typing import Any

from ..model.quantities import ParameterError, declared
from ..theory.values import QUANTITIES, FaultLike
from .options import option, together
from .text import Row, table, wrapped
from .unit_text import in_unit

OPTIONS = ("width", "outside_zeta", "outside_a")

_WIDTH = declared("width W of a weakening patch among strengthening surroundings", "(0.0, 1e6) m")

patch_options = together(
    option(
        "--outside-zeta",
        key="outside_zeta",
        entry=QUANTITIES["zeta"],
        note="of the surroundings of a weakening patch, for W_c and --width",
    ),
    option(
        "--outside-a",
        key="outside_a",
        entry=QUANTITIES["a"],
        note="of the surroundings; that of the patch if left out",
    ),
    option("--width", key="width", entry=_WIDTH, note="needs --outside-zeta"),
)
"""The options for a patch, the arguments of :func:`patch_of`."""


def patch_of(fault: FaultLike, options: dict[str, Any]) -> dict[str, Any] | None:
    """The behaviour of the patch that :data:`patch_options` define.

    Parameters
    ----------
    fault : Fault
        One fault, with the friction of the patch.
    options : dict
        Values of the options, in SI units; None if not given.

    Returns
    -------
    dict or None
        Of :func:`~nucleation.lengths.weakening_patch.patch_answer`; None if no option is given.

    Raises
    ------
    ParameterError
        If the surroundings of a patch are not given.
    """
    width, outside_zeta, outside_a = (options[name] for name in OPTIONS)
    if outside_zeta is None:
        if width is None and outside_a is None:
            return None
        raise ParameterError(
            "outside_zeta is missing: give --outside-zeta, the velocity weakening of the patch's "
            "surroundings, negative where they strengthen"
        )
    from ..lengths.weakening_patch import patch_answer

    return patch_answer(fault, outside_zeta, outside_a, width)


def patch_lines(patch: dict[str, Any], width: float | None, critical: float) -> list[str]:
    """The smallest width W_c, the behaviour of the patch, and the cells of a mesh.

    Parameters
    ----------
    patch : dict
        The behaviour.
    width : float or None
        Width of the patch (m).
    critical : float
        L_c (m) of homogeneous sliding.

    Returns
    -------
    list of str
    """
    head = "A weakening patch among strengthening surroundings (docs/creeping_patch.md):"
    smallest = patch["smallest_width"]
    rows: list[Row] = []
    if math.isnan(smallest):
        rows.append("  no W_c: the patch is stable, or its surroundings are not")
    else:
        ratio = f"{smallest / critical:.3g} L_c"
        meaning = "smallest width at which slip is unstable; a narrower patch creeps"
        rows.append(("W_c", f"{smallest:.4g} m", ratio, meaning))
        if width is not None:
            own = f"{patch['width_ratio']:.3g} W_c"
            rows.append(("W", in_unit(width, "m"), own, patch["outcome"]))
            if patch["width_ratio"] >= 1.0:
                from ..lengths.patch_outcomes import SETTING

                rows.append(f"      simulated: {SETTING}")
    if not math.isnan(patch["cell_size"]):
        cell = f"{patch['cell_size']:.3g} m"
        rows.append(("cells", cell, "", "or less: three in a process zone (Day et al., 2005)"))
    return [*wrapped(head), *table(rows)]
