"""The simulation of a single fault."""

import math
from typing import Any

from ..model.friction.law import Friction
from ..model.parameters import Parameters
from ..model.quantities import ParameterError, plain
from ..theory.stiffness import FAR_SIDES
from ..theory.values import ZONE, FaultLike

_SECOND = ("second_shear_modulus", "second_poisson_ratio", "second_height", "second_far_side")
"""Parameters that a rigid second body does not have."""


def parameters_of_fault(fault: FaultLike, **changes: Any) -> Parameters:
    """The parameters of a simulation of a fault, with other ones by their names in studies.

    By default the block is 6 L_c long. Half-spaces become blocks that are 4 L_c high and 35 L_c
    long, which changes L_s by 2 % or less.
    """
    from replication.configuration.half_spaces import without_half_spaces
    from replication.configuration.single_run import merged, single_run

    fixed, _ = without_half_spaces(None, _by_study_names(fault) | changes)
    return single_run(merged(None, fixed)).parameters


def _by_study_names(fault: FaultLike) -> dict[str, Any]:
    """The parameters by their names in studies, also those of a law that V does not set."""
    law = fault.law()  # asks for velocity and friction
    found: dict[str, Any] = {}
    names = fault.keys()
    for name in names:
        if name in ZONE:
            raise ParameterError(f"{name} is not allowed: no simulation has a zone")
        value = getattr(fault, name)
        found[name] = value if isinstance(value, str | Friction) else fault.single(name)
    far_side = found.pop("far_side")
    if FAR_SIDES[far_side] is not FAR_SIDES["free"]:
        raise ParameterError(
            f"far_side = {far_side!r} is not allowed: the far side of a simulated block is free"
        )
    found["second_body"] = "deformable"
    if math.isinf(found.get("second_shear_modulus", 0.0)):
        found["second_body"] = "rigid"
        found = {name: x for name, x in found.items() if name not in _SECOND}
    elif found.get("second_far_side") == "traction":
        found["second_far_side"] = "free"
    for name in ("friction", "a", "zeta", "friction_law"):
        found.pop(name, None)
    own = plain(law)
    own["friction_law"] = own.pop("law")
    return found | own | {"initial_state": fault.age()}
