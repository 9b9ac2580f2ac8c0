"""The law of the drop in the page: of each fault whose quiet run was followed, for every kind.

The law needs the spectrum of a patch, which a page cannot compute. It gets, from quiet runs, the
mode's amplitude per strength over the patch's length, and evaluates it for any strength by the same
formula as :meth:`nucleation.patch.delay.Growth.drop`.
"""

import dataclasses
from collections.abc import Iterable
from typing import Any

import numpy as np

from ..analysis.sensitivity import Case, variation
from ..model.friction.law import Friction
from ..model.identity import fault
from ..model.linearised import InterfaceState, linearised
from ..model.perturbation import KINDS, Perturbation
from ..patch.delay import EARLY, LATE, MEDIAN, Growth, growth
from ..patch.expected_drop import STRONGEST
from ..patch.mode_history import ModeHistory
from ..theory.critical import run_length
from .encode import float32

POINTS = 400  # of a curve in the page
STRENGTHS = (1e-12, 1e-1)  # ends of the slider
STRENGTH = 1e-3  # where it begins: how steady a good machine holds its load
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
    faults, first = [], {}  # type: ignore[var-annotated]
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
    return {
        "faults": faults,
        "parts": [MEDIAN, EARLY, LATE],
        "strongest": STRONGEST,
        "control": {
            "key": "eps", "factor": 1, "low": STRENGTHS[0], "high": STRENGTHS[1], "log": True,
            "value": STRENGTH,
        },
    }  # fmt: skip


def _fault(history: ModeHistory, theory_length: float) -> dict[str, Any]:
    parameters = history.parameters
    height, evolution = parameters.geometry.height, parameters.friction.evolution
    grown = {kind: growth(history, Perturbation(kind=kind)) for kind in KINDS[1:]}
    lines = {kind: growing.closed_form(history, 1.0) for kind, growing in grown.items()}
    kinds = {kind: thinned(growing) for kind, growing in grown.items()}
    return {
        "label": f"H = {height:g} m, {evolution} law",
        "theory_length": theory_length,
        "stability_length": _known(lines["state"].stability_length),
        "kinds": {
            kind: {
                "length": float32(growing.length),
                "log_amplitude": float32(growing.log_amplitude),
                "per_period": float32(growing.per_period),
                "effective": _known(lines[kind].effective),  # eps_eff of a strength of one
            }
            for kind, growing in kinds.items()
        },
    }


def _known(value: float) -> float | None:
    """JSON has no word for what is not a number."""
    return value if np.isfinite(value) else None


def thinned(growing: Growth) -> Growth:
    """The same with :data:`POINTS`, in the single precision of the page."""
    kept = np.linspace(0, growing.length.size - 1, POINTS).round().astype(int)
    fields = {
        field.name: getattr(growing, field.name)[kept].astype(np.float32).astype(float)
        for field in dataclasses.fields(growing)
    }
    return Growth(**fields)
