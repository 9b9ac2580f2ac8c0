"""Warnings about studies with allowed values that are unlikely to give the intended results.

Each warning names the study, the runs concerned and the numbers. The limits are estimates from
the linear theory and the thin block's statics; docs/studies.md has those that a user plans with.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from nucleation.model.linearised import InterfaceState, interface_state
from nucleation.theory.estimates import growth_time

from .mesh_advice import TOPICS, UNSTABLE, Advice, elements_per_zone, noise, resolution, roughness
from .roles import REFINEMENTS
from .runs import Run

_STEPS_PER_PERIOD = 8.0
"""Fewest time steps per period of the nucleating mode."""

_SHORT_BLOCK = 2.0
"""Block length over the critical length below which the far end affects the patch."""

_CHANGE_OF_FRICTION = 0.2
"""Smallest relative change of a or b from V to V/10 that causes a warning.

Slip rates at the front are about V/10. The change is 0.03 with the paper's scales; b of the
regularised Dieterich-Ruina law halves with V = 10 v0.
"""

_MOST_NAMED = 100
"""Most runs that a warning names beside the worst; maps have thousands."""


_Case = tuple[float, str, Run]
"""Badness and text of a warning, and the run."""


class _Warned(NamedTuple):
    """A warning about the runs of a study."""

    topic: str
    text: str
    """Study, topic, the worst run and its numbers, the other runs."""
    runs: list[Run]
    """The runs, the worst first."""

    @property
    def is_of_meshes(self) -> bool:
        """Whether it is about meshes and steps that do not resolve the front."""
        return self.topic in TOPICS


def warned(runs: Iterable[Run]) -> list[_Warned]:
    """The warnings about some runs: one for each study and topic, with the numbers of the worst."""
    found: dict[tuple[str, str], list[_Case]] = {}
    for run in runs:
        for topic, badness, text in _about(run):
            found.setdefault((run.study, topic), []).append((badness, text, run))
    warnings = []
    for (study, topic), cases in found.items():
        cases.sort(key=lambda case: case[0], reverse=True)
        _, text, _ = cases[0]
        concerned = {run.id: run for _, _, run in cases}  # a run of two blocks may be repeated
        ids = list(concerned)
        full_text = f"studies.{study}: {topic} ({_worst(ids)}): {text}{_others(ids)}"
        warnings.append(_Warned(topic, full_text, list(concerned.values())))
    return warnings


def advise(runs: Iterable[Run]) -> list[str]:
    """The texts of the warnings about some runs."""
    return [warning.text for warning in warned(runs)]


def summary_of_meshes(warnings: Sequence[_Warned], place: str) -> str:
    """One sentence for all warnings about meshes and steps.

    Parameters
    ----------
    warnings : sequence of _Warned
        One or more.
    place : str
        Where the warnings are in full.

    Returns
    -------
    str
        The number of runs, and the fewest elements per process zone among them.
    """
    runs = {run.id: run for warning in warnings for run in warning.runs}
    worst = min(runs.values(), key=elements_per_zone)
    number = f"{len(runs)} runs have" if len(runs) > 1 else "1 run has"
    return (
        f"{number} a coarse mesh or long steps, with {elements_per_zone(worst):.2g} elements per "
        f"process zone at worst ({worst.id}); {place} lists them"
    )


def _worst(ids: list[str]) -> str:
    if len(ids) == 1:
        return ids[0]
    return f"{len(ids)} runs, the worst {ids[0]}"


def _others(ids: list[str]) -> str:
    others = ids[1:]
    if not others:
        return ""
    named = ", ".join(others[:_MOST_NAMED])
    unnamed = len(others) - _MOST_NAMED
    rest = f" and {unnamed} more" if unnamed > 0 else ""
    return f" [also {named}{rest}]"


def _has_weakening_patch(run: Run, zeta: float) -> bool:
    """Whether zeta, which is declared for the surroundings, is positive on a patch of the fault."""
    own = run.parameters.heterogeneity
    return own.varies == "zeta" and zeta * (1.0 + own.change) > 0.0


def _about(run: Run) -> Iterator[Advice]:
    """All warnings about a run."""
    yield from resolution(run)
    interface = interface_state(run.parameters)
    stable = math.isnan(run.critical_length)
    if stable and _has_weakening_patch(run, interface.zeta):
        return
    if stable or interface.zeta <= 0.0:
        yield _no_nucleation(run, interface)
        return
    yield from _steps(run, interface)
    if run.parameters.loading.kind != "edge":
        return  # the other warnings are about patches that grow from an edge
    yield from _span(run)
    yield from _block(run)
    yield from _start(run)
    if run.role != "patch_theory":  # its faults have such friction on purpose
        yield from changing_friction(run)
    if run.role not in (*REFINEMENTS, "patch_theory"):  # these measure the noise
        yield from roughness(run)
        yield from noise(run)


def _no_nucleation(run: Run, interface: InterfaceState) -> Advice:
    velocity = run.parameters.loading.velocity
    if math.isnan(run.critical_length):
        return (
            "nothing will nucleate",
            -interface.zeta,
            f"homogeneous sliding is stable at every wavelength, zeta = {interface.zeta:.3g} at V "
            f"= {velocity:g} m/s",
        )
    return (
        "friction strengthens",
        -interface.zeta,
        f"zeta = {interface.zeta:.3g} at V = {velocity:g} m/s; the "
        f"theory's critical length, {run.critical_length:.3g} m, is due to the normal stress "
        "alone, which slip changes: the patch grows slowly",
    )


def changing_friction(run: Run) -> Iterator[Advice]:
    """Friction laws with scales v* and v0 so large that a and b change along the patch."""
    friction = run.parameters.friction
    velocity = run.parameters.loading.velocity
    _, a, zeta = friction.expansion(velocity)
    _, a_near, zeta_near = friction.expansion(velocity * 0.1)
    b = a + zeta
    b_near = a_near + zeta_near
    change_of_a = abs(a_near / a - 1.0)
    scale = max(a, abs(b))
    change_of_b = abs(b_near - b) / scale
    change = max(change_of_a, change_of_b)
    if change < _CHANGE_OF_FRICTION:
        return
    length = _stability_length(run, constant=False)
    length_if_constant = _stability_length(run, constant=True)
    scales = ", ".join(
        f"{name} = {getattr(friction, name):g} m/s"
        for name in ("slip_rate_scale", "regularisation_slip_rate")
        if hasattr(friction, name)
    )
    yield (
        "friction changes along the patch",
        change,
        f"{scales} beside V = {velocity:g} m/s: a = {a:.3g}, b = {b:.3g} at V, "
        f"{a_near:.3g}, {b_near:.3g} at V/10. L_s is {length}, with constant a and b "
        f"{length_if_constant}; give smaller scales unless these are intended "
        "(docs/creeping_patch.md)",
    )


def _stability_length(run: Run, constant: bool) -> str:
    """L_s as text, with the friction law's own or with constant a and b."""
    from nucleation.theory.creep.lengths import stability_length_of

    critical = run.critical_length
    ratio = stability_length_of(run.parameters, critical, constant) / critical
    return "none up to 3 L_c" if math.isnan(ratio) else f"{ratio:.2g} L_c"


def _steps(run: Run, interface: InterfaceState) -> Iterator[Advice]:
    longest = run.parameters.stepping.longest_step
    ratio = interface.a / interface.zeta
    period = 2.0 * math.pi * math.sqrt(ratio)  # in units of D/V
    if longest > period / _STEPS_PER_PERIOD:
        yield (
            "time steps too long",
            longest,
            f"longest_step = {longest:g} D/V makes {period / longest:.2g} steps in a period of the "
            f"nucleating mode; recommended is {period / _STEPS_PER_PERIOD:.2g} or less",
        )


def _span(run: Run) -> Iterator[Advice]:
    end = run.parameters.stepping.end_time
    critical = run.critical_length
    earliest = growth_time(run.parameters, UNSTABLE * critical)
    if end < earliest:
        latest = growth_time(run.parameters, critical)
        yield (
            "simulated time too short",
            earliest / end,
            f"end_time = {end:g} s, but the patch needs about {earliest:.3g} s to become unstable "
            f"and {latest:.3g} s to reach the theory's critical length, {critical:.3g} m",
        )


def _block(run: Run) -> Iterator[Advice]:
    length = run.parameters.geometry.length
    critical = run.critical_length
    if length < _SHORT_BLOCK * critical:
        yield (
            "block short",
            critical / length,
            f"length = {length:g} m is {length / critical:.3g} times the theory's "
            f"critical length, {critical:.3g} m; recommended are 4 to 6 times",
        )


def _start(run: Run) -> Iterator[Advice]:
    loading = run.parameters.loading
    friction = run.parameters.friction
    coefficient = friction.coefficient(loading.velocity, loading.initial_state)
    strength = float(coefficient) * loading.normal_stress
    initial = loading.initial_shear_stress
    if initial >= strength:
        yield (
            "start above the strength",
            initial / strength,
            f"initial_shear_stress = {initial:g} Pa, while the interface "
            f"slips at V under {strength:.3g} Pa: it slips everywhere from the start",
        )
