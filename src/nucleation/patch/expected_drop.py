"""The drop that a user's fault is to be expected to have: by theory alone, or from a quiet run.

The theory of the creeping patch (:mod:`.theory_history`) has all that the law of the drop asks for.
A quiet run has it too, of a block with its ends: it is made on a mesh just fine enough, without its
event, up to a patch length at which its mode has long been unstable, and its trends go on from
there.
"""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np
import xarray as xr

from ..analysis.definitions import Extent, ExtractionSettings
from ..model.parameters import Mesh, Parameters
from ..model.perturbation import Perturbation
from ..simulation.composition import composed
from ..simulation.event import FAST
from ..simulation.recording import Recorder
from ..simulation.run import run
from ..theory.creep.lengths import NoPatch
from ..theory.estimates import growth_time
from .continued import trend
from .delay import ClosedForm, Drop, growth
from .mode_history import ModeHistory, follow_mode
from .theory_history import theory_history

QUICK = Mesh(n_x=300, n_y=8, grading=20.0)
BLOCK = 3.0  # longest block of the quiet run, over the theory's length: its end is not felt
QUICK_STEP = 0.1  # longest, over D/V,
QUICK_STEPS = 4500  # or longer, in runs that would take more: the creep is smooth,
LONGEST_STEP = 0.4  # but no longer than this
REACH = 0.7  # of the theory's length, up to which the quiet run is followed
OVERDUE = 3.0  # times the time that it is expected to take
FEWEST = 8  # instants with an oscillating mode
LATEST_GROWTH = 0.85  # of the quiet run's last length, up to which L_s leaves something to trend
STRONGEST = 0.02  # eps_eff beyond which bursts that come to rest make the drop late
SLOWEST_GROWTH = 4.0  # growth in a period at the drop, below which they do so too
NEAR_END = 0.6  # part of the block's length up to which its far end is not felt


class NoDrop(ValueError):
    """The law can't say where the fault drops."""


class ExpectedDrop(NamedTuple):
    """What is to be expected of a fault under its declared perturbation; lengths in m."""

    drop: Drop
    closed_form: ClosedForm
    doubt: str  # why the law should not be relied upon here, empty if it should

    @property
    def trusted(self) -> bool:
        """Whether the law holds as far as its own numbers tell."""
        return not self.doubt


def expected_drop(
    parameters: Parameters, theory_length: float, quiet_run: bool = False,
    settings: ExtractionSettings = ExtractionSettings(), mesh: Mesh = QUICK,
) -> ExpectedDrop:  # fmt: skip
    """L_s and the length at the drop of a fault under its declared perturbation.

    Parameters
    ----------
    parameters : the fault, its loads, the block and the perturbation; its own mesh is not used.
    theory_length : the theory's critical length (m).
    quiet_run : whether the mode is followed in a quick quiet run, not by the theory of the patch.
    settings : definition of the patch's edge, in a quiet run.
    mesh : of the quiet run.

    Raises
    ------
    NoDrop
        Nothing is perturbed, or the patch has no oscillating mode that begins to grow, within the
        quiet run or at all.
    """
    parameters.require_edge("the law of the drop")
    declared = parameters.perturbation
    if not declared.acts:
        raise NoDrop("nothing is perturbed: without a strength the drop depends on round-off")
    if not quiet_run:
        try:
            history = theory_history(parameters, theory_length)
        except NoPatch as error:
            raise NoDrop(str(error)) from None
        found = _expected(history, declared)
        if not found.doubt and found.drop.high > history.length[-1]:
            return found._replace(
                doubt="the drop lies beyond the patches whose mode could be followed, "
                f"{history.length[-1] / theory_length:.2g} L_c"
            )
        return found
    length = min(parameters.geometry.length, BLOCK * theory_length)
    record = quick_run(
        parameters.replaced({"geometry.length": length}), REACH * theory_length, settings, mesh
    )
    try:
        history = follow_mode(record, settings)
    except ValueError as error:
        raise NoDrop(str(error)) from None
    if not _begins_to_grow(history):
        longest = history.length[-1] / theory_length
        raise NoDrop(
            "the creeping patch has no oscillating mode that begins to grow up to "
            f"{longest:.2g} L_c, where the quiet run ends"
        )
    return _expected(history, declared)


def _begins_to_grow(history: ModeHistory) -> bool:
    """By the trend: on a coarse mesh the front's hops take growth to and fro."""
    if history.time.size < FEWEST:
        return False
    first, last = trend(history, history.rate.real)(history.length[[0, -1]])
    return bool(first < 0.0 < last)


def _expected(history: ModeHistory, declared: Perturbation) -> ExpectedDrop:
    found = growth(history, declared)
    drop, closed = found.drop(declared.strength), found.closed_form(history, declared.strength)
    doubt = ""
    if closed.effective >= STRONGEST:
        doubt = (
            f"the perturbation is strong (eps_eff = {closed.effective:.2g}, the law holds below "
            f"{STRONGEST:g}): bursts that come to rest may make the drop later"
        )
    elif closed.stability_length > LATEST_GROWTH * history.length[-1]:
        doubt = (
            "growth begins near the end of the quiet run, at "
            f"{closed.stability_length / history.length[-1]:.2g} of its length: how it goes on is "
            "not known"
        )
    elif (grown := _growth_in_period(history, drop.length)) < SLOWEST_GROWTH:
        doubt = (
            f"the mode grows by a factor of {grown:.2g} in a period where it is as large as the "
            f"loading (the law holds from {SLOWEST_GROWTH:g} on): bursts that come to rest may "
            "make the drop later"
        )
    elif drop.high > NEAR_END * history.parameters.geometry.length:
        doubt = (
            f"the patch would be {drop.high / history.parameters.geometry.length:.2g} of the block "
            "long, whose far end it feels"
        )
    elif not np.isfinite([drop.length, drop.low, drop.high]).all():
        doubt = "the drop lies beyond the lengths that the quiet run's trends are carried on to"
    return ExpectedDrop(drop, closed, doubt)


def _growth_in_period(history: ModeHistory, length: float) -> float:
    """The mode's growth in one of its periods at a patch length (m), by the trends."""
    rate, turn = (
        float(trend(history, part)(np.array([length]))[0])
        for part in (history.rate.real, history.rate.imag)
    )
    return float(np.exp(2.0 * np.pi * rate / turn)) if turn > 0.0 else float("inf")


def quick_run(
    parameters: Parameters,
    longest: float,
    settings: ExtractionSettings = ExtractionSettings(),
    mesh: Mesh = QUICK,
) -> xr.Dataset:
    """The record of a quiet run up to a patch length (m), or to its event if that comes first.

    However long it is asked to run: it ends when it should have been there for long.
    """
    expected = growth_time(parameters, longest)
    wanted = expected / (QUICK_STEPS * parameters.memory_time)
    longest_step = min(max(QUICK_STEP, wanted), LONGEST_STEP)
    stepping = dataclasses.replace(parameters.stepping, longest_step=longest_step)
    quiet = dataclasses.replace(
        parameters, mesh=mesh, perturbation=Perturbation(), stepping=stepping
    )
    dynamics, velocity = composed(quiet), quiet.loading.velocity
    recorder = Recorder(quiet, dynamics)
    latest = OVERDUE * expected
    patch = Extent(dynamics.grid.x, settings.edge_threshold * velocity)
    for instant in run(quiet, dynamics=dynamics):
        recorder.record(instant.state, instant.report)
        rates, time = instant.report.interface.slip_rate, instant.state.time
        # a fault under a stress of its own may slip fast as it begins to be driven
        fast = rates.max() > FAST * velocity and time > quiet.memory_time
        if patch.reach(rates) >= longest or fast or time >= latest:
            break
    return recorder.dataset()
