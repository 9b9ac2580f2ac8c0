"""The law of the drop in the page: of each fault whose quiet run was followed, for every kind.

The law needs the spectrum of a patch, which a page cannot compute. It gets the lengths of
:meth:`nucleation.patch.delay.Growth.drop` at :data:`STRENGTHS`, and interpolates between them.
"""

from collections.abc import Iterable
from typing import Any

import numpy as np

from ..analysis.sensitivity import Case, variation
from ..model.friction.law import Friction
from ..model.identity import fault
from ..model.linearised import InterfaceState, linearised
from ..model.perturbation import Perturbation
from ..patch.delay import growth
from ..patch.expected_drop import STRONGEST
from ..patch.mode_history import ModeHistory
from ..theory.critical import run_length
from .encode import float32

STRENGTHS = np.geomspace(1e-12, 1e-1, 133)
STRENGTH = 1e-3  # where the slider begins: how steady a good machine holds its load
WORDS = {
    "drive_velocity": "velocity of the drive",
    "normal_load": "normal load",
    "strength": "strength along the fault",
    "state": "state of the interface",
}


def in_page(
    histories: Iterable[ModeHistory], friction: Friction, interface: InterfaceState
) -> dict[str, Any] | None:
    """What the page needs of all faults, None without any.

    Parameters
    ----------
    histories : of quiet runs; of each fault the last counts.
    friction : of the configuration.
    interface : the theory's friction in its place, for the critical lengths that stand beside.
    """
    known = {fault(history.parameters): history for history in histories}
    if not known:
        return None
    faults: list[dict[str, Any]] = []
    first: dict[str, Case] = {}
    for history in known.values():
        parameters, loading = history.parameters, history.parameters.loading
        same = parameters.friction.changed({"evolution": friction.evolution}) == friction
        same &= (loading.velocity, loading.normal_stress) == (
            interface.velocity, interface.normal_stress,
        )  # fmt: skip
        own = interface if same else linearised(parameters.friction, loading)
        shown = _fault(history, run_length(parameters, own))
        length = shown["theory_length"]  # also of the block, which is not of the fault
        case = Case("", parameters.replaced({"geometry.length": length}), length)
        base = first.setdefault(shown["label"], case)
        if base is not case:
            shown["label"] += f", {variation(case, base)[1]}"
        faults.append(shown)
    ends = {"low": STRENGTHS[0], "high": STRENGTHS[-1], "value": STRENGTH, "log": True}
    return {
        "faults": faults,
        "strengths": STRENGTHS.tolist(),
        "strongest": STRONGEST,
        "control": {"key": "eps", "label": "Relative strength", "unit": "", "factor": 1, **ends},
    }


def _fault(history: ModeHistory, theory_length: float) -> dict[str, Any]:
    """The lengths (m) of one fault: median, 16 and 84 % by kind and strength."""
    parameters = history.parameters
    height, evolution = parameters.geometry.height, parameters.friction.evolution
    grown = {kind: growth(history, Perturbation(kind=kind)) for kind in WORDS}
    lines = {kind: growing.closed_form(history, 1.0) for kind, growing in grown.items()}
    return {
        "label": f"H = {height:g} m, {evolution} law",
        "theory_length": theory_length,
        "stability_length": _known(lines["state"].stability_length),
        "kinds": {
            kind: {
                "drops": list(map(float32, np.array([*map(growing.drop, STRENGTHS)]).T[:3])),
                "effective": _known(lines[kind].effective),  # eps_eff of a strength of one
            }
            for kind, growing in grown.items()
        },
    }


def _known(value: float) -> float | None:
    """JSON has no word for what is not a number."""
    return value if np.isfinite(value) else None
