"""What deserves a warning before a study runs: allowed values that will hardly give what is wanted.

Each warning names the study, the runs concerned and the numbers. The measures are estimates from
the linear theory and the thin block's statics; docs/studies.md says what they are worth.
"""

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ..model.linearised import linearised
from ..model.parameters import Geometry, Mesh
from ..model.perturbation import ALONG_X, ELEMENTS_PER_CORRELATION
from ..theory.estimates import growth_time, process_zone
from .roles import REFINEMENTS
from .runs import Run

ELEMENTS_PER_ZONE = 3.0
"""Least elements per process zone: below, the front is not resolved (Day and others, 2005)."""

STEPS_PER_PERIOD = 8.0
"""Least time steps per period of the nucleating mode."""

QUIET_ELEMENTS = 17.0
"""Elements per process zone of the study ``converged``: good enough for strengths of 1e-5."""

COARSE_ELEMENTS, COARSE_NOISE, PER_ELEMENT = 9.5, 1e-3, 0.8
"""Elements per process zone of the paper's mesh, which moves onsets by a per cent up to strengths
of 1e-3; and how many powers of ten less it is with each element more. With 11 to 17 elements nine
of ten faults dropped within 0.1 % of the time on twice as many at 1e-4, and with 17 or more a mesh
is as quiet as 1e-9 (docs/verification.md, docs/drop.md)."""

ELEMENT_PART = 0.04
"""Part of an element that the front may pass in a step without shaking the patch as much as ..."""

STEP_NOISE = 1e-5
"""... a perturbation of this strength."""

UNSTABLE = 0.55
"""Length over the theory's critical length at which the creeping patch turns unstable."""

SHORT_BLOCK = 2.0
"""Block length over the critical length below which the far end is felt by the patch."""

CHANGE_OF_FRICTION = 0.2
"""Relative change of a or b from V to V/10, where the front slips, that is told: 0.03 with the
paper's scales; b of the regularised Dieterich-Ruina law halves with V = 10 v0."""

NAMED = 100
"""Most runs that a warning names besides the worst: maps have thousands."""


class Advice(NamedTuple):
    """One warning about one run: what it is about, how bad it is, and its text."""

    topic: str
    badness: float
    text: str


def element_sizes(mesh: Mesh, geometry: Geometry) -> tuple[float, float]:
    """Length of a block's elements, and height of those at the interface (m)."""
    growth = mesh.grading ** (1.0 / (mesh.n_y - 1))
    rows = sum(growth**row for row in range(mesh.n_y))
    return geometry.length / mesh.n_x, geometry.height / rows


def advise(runs: Iterable[Run]) -> list[str]:
    """The warnings about some runs: one for each study and topic, with the runs, the worst first.

    The numbers are those of the worst.
    """
    found: dict[tuple[str, str], list[tuple[Advice, Run]]] = {}
    for run in runs:
        for advice in _about(run):
            found.setdefault((run.study, advice.topic), []).append((advice, run))
    texts = []
    for (study, topic), cases in found.items():
        cases.sort(key=lambda case: -case[0].badness)
        worst, *ids = dict.fromkeys(run.id for _, run in cases)  # one of two blocks is there twice
        where = f"{len(ids) + 1} runs, the worst {worst}" if ids else worst
        rest = f" and {len(ids) - NAMED} more" if len(ids) > NAMED else ""
        others = f" [also {', '.join(ids[:NAMED])}{rest}]" if ids else ""
        texts.append(f"studies.{study}: {topic} ({where}): {cases[0][0].text}{others}")
    return texts


def _about(run: Run) -> Iterator[Advice]:
    yield from _mesh(run)
    interface = linearised(run.parameters.friction, run.parameters.loading)
    if math.isnan(run.theory_length):
        yield Advice(
            "nothing will nucleate", -interface.zeta,
            f"homogeneous sliding is stable at every wavelength, zeta = {interface.zeta:.3g} at V "
            f"= {run.parameters.loading.velocity:g} m/s",
        )  # fmt: skip
        return
    if interface.zeta <= 0.0:
        yield Advice(
            "friction strengthens", -interface.zeta,
            f"zeta = {interface.zeta:.3g} at V = {run.parameters.loading.velocity:g} m/s; the "
            f"theory's critical length, {run.theory_length:.3g} m, is due to the normal stress "
            "alone, which slip changes: it takes long to grow",
        )  # fmt: skip
        return
    yield from _steps(run, 2.0 * math.pi * math.sqrt(interface.a / interface.zeta))
    if run.parameters.loading.kind != "edge":
        return  # the rest is of patches that grow from an edge
    yield from _span(run)
    yield from _block(run)
    yield from _start(run)
    if run.role != "patch_theory":  # whose faults are meant to be such
        yield from changing_friction(run)
    if run.role not in (*REFINEMENTS, "patch_theory"):  # what drowns in noise is their point
        yield from _roughness(run)
        yield from _noise(run)


def changing_friction(run: Run) -> Iterator[Advice]:
    """Where the friction law's own scales, v* and v0, make a and b change along the patch."""
    friction, loading = run.parameters.friction, run.parameters.loading
    (_, a, zeta), (_, a_near, zeta_near) = (
        friction.expansion(loading.velocity * part) for part in (1.0, 0.1)
    )
    b, b_near = a + zeta, a_near + zeta_near
    change = max(abs(a_near / a - 1.0), abs(b_near - b) / max(a, abs(b)))
    if change < CHANGE_OF_FRICTION:
        return
    from ..theory.creep.lengths import stability_length_of  # with SciPy, which takes a while

    ratios = [
        stability_length_of(run.parameters, run.theory_length, constant) / run.theory_length
        for constant in (False, True)
    ]
    lengths = [f"{ratio:.2g} L_c" for ratio in ratios]
    lengths = [text if "nan" not in text else "none up to 3 L_c" for text in lengths]
    scales = ", ".join(
        f"{name} = {getattr(friction, name):g} m/s"
        for name in ("slip_rate_scale", "regularisation_slip_rate")
        if hasattr(friction, name)
    )
    yield Advice(
        "friction changes along the patch", change,
        f"{scales} beside V = {loading.velocity:g} m/s: a = {a:.3g}, b = {b:.3g} at V, "
        f"{a_near:.3g}, {b_near:.3g} at V/10. L_s is {lengths[0]}, with constant a and b "
        f"{lengths[1]}; give smaller scales unless they are meant (docs/patch_theory.md)",
    )  # fmt: skip


def _zone(run: Run) -> float:
    """Length (m) of the process zone once the patch is as long as the theory's critical length."""
    if math.isnan(run.theory_length):
        return process_zone(run.parameters)
    return process_zone(run.parameters, growth_time(run.parameters, run.theory_length))


def _mesh(run: Run) -> Iterator[Advice]:
    parameters, zone = run.parameters, _zone(run)
    mesh, below = parameters.mesh, parameters.below
    along, _ = element_sizes(mesh, parameters.geometry)
    if along > zone / ELEMENTS_PER_ZONE:
        least, best = (
            math.ceil(mesh.n_x * along / zone * n) for n in (ELEMENTS_PER_ZONE, QUIET_ELEMENTS)
        )
        yield Advice(
            "mesh too coarse along x", along / zone,
            f"n_x = {mesh.n_x} makes elements of {along:.3g} m, {zone / along:.2g} to a process "
            f"zone of {zone:.3g} m; recommended is n_x = {least} or more, and about {best} for "
            "drops that follow a declared perturbation and not the mesh",
        )  # fmt: skip
    blocks = [("", mesh, parameters.geometry)]
    blocks += [("second_", below.mesh, below.geometry)] if below else []
    for which, own, geometry in blocks:
        _, across = element_sizes(own, geometry)
        if across > zone / ELEMENTS_PER_ZONE:
            yield Advice(
                "mesh too coarse along y", across / zone,
                f"{which}n_y = {own.n_y} and {which}grading = {own.grading:g} make elements of "
                f"{across:.3g} m at the interface, {zone / across:.2g} to a process zone of "
                f"{zone:.3g} m; recommended are {zone / ELEMENTS_PER_ZONE:.3g} m or less",
            )  # fmt: skip


def _steps(run: Run, period: float) -> Iterator[Advice]:
    """`period` is that of the nucleating mode in units of D/V."""
    longest = run.parameters.stepping.longest_step
    if longest > period / STEPS_PER_PERIOD:
        yield Advice(
            "time steps too long", longest,
            f"longest_step = {longest:g} D/V makes {period / longest:.2g} steps in a period of the "
            f"nucleating mode; recommended is {period / STEPS_PER_PERIOD:.2g} or less",
        )  # fmt: skip


def _span(run: Run) -> Iterator[Advice]:
    end, critical = run.parameters.stepping.end_time, run.theory_length
    earliest = growth_time(run.parameters, UNSTABLE * critical)
    if end < earliest:
        latest = growth_time(run.parameters, critical)
        yield Advice(
            "simulated time too short", earliest / end,
            f"end_time = {end:g} s, but the patch needs about {earliest:.3g} s to become unstable "
            f"and {latest:.3g} s to reach the theory's critical length, {critical:.3g} m",
        )  # fmt: skip


def _block(run: Run) -> Iterator[Advice]:
    length = run.parameters.geometry.length
    if length < SHORT_BLOCK * run.theory_length:
        yield Advice(
            "block short", run.theory_length / length,
            f"length = {length:g} m is {length / run.theory_length:.3g} times the theory's "
            f"critical length, {run.theory_length:.3g} m; recommended are 4 to 6 times",
        )  # fmt: skip


def _start(run: Run) -> Iterator[Advice]:
    friction, loading = run.parameters.friction, run.parameters.loading
    strength = float(friction.coefficient(loading.velocity, loading.initial_state))
    strength *= loading.normal_stress
    if loading.initial_shear_stress >= strength:
        yield Advice(
            "start above the strength", loading.initial_shear_stress / strength,
            f"initial_shear_stress = {loading.initial_shear_stress:g} Pa, while the interface "
            f"slips at V under {strength:.3g} Pa: it slips everywhere from the start",
        )  # fmt: skip


def _roughness(run: Run) -> Iterator[Advice]:
    declared = run.parameters.perturbation
    along, _ = element_sizes(run.parameters.mesh, run.parameters.geometry)
    scale = declared.correlation_length
    if declared.acts and declared.kind in ALONG_X and scale < ELEMENTS_PER_CORRELATION * along:
        least = math.ceil(run.parameters.mesh.n_x * ELEMENTS_PER_CORRELATION * along / scale)
        yield Advice(
            "roughness not resolved", along / scale,
            f"correlation_length = {scale:g} m has {scale / along:.2g} elements of {along:.3g} m, "
            f"which sample some other roughness; recommended is n_x = {least} or more",
        )  # fmt: skip


def _noise(run: Run) -> Iterator[Advice]:
    """What mesh and steps do to the patch by themselves, against what is declared."""
    declared, zone = run.parameters.perturbation, _zone(run)
    if not declared.acts or run.parameters.second_body.kind == "deformable":
        return  # the measures are those of one block
    along, _ = element_sizes(run.parameters.mesh, run.parameters.geometry)
    noise = COARSE_NOISE * 10.0 ** min(PER_ELEMENT * (COARSE_ELEMENTS - zone / along), 0.0)
    if declared.strength < noise and zone < QUIET_ELEMENTS * along:
        best = math.ceil(run.parameters.mesh.n_x * along / zone * QUIET_ELEMENTS)
        yield Advice(
            "perturbation lost in the mesh's noise", along / zone,
            f"strength = {declared.strength:g} with {zone / along:.2g} elements to a process zone: "
            "the front's hops from node to node shake the patch, and move onsets by 1 % up to "
            f"strengths of about {noise:.0e}; recommended is n_x = {best} or more",
        )  # fmt: skip
    passed = _front_speed(run) * run.parameters.longest_step / along
    if passed > ELEMENT_PART and declared.strength <= STEP_NOISE:
        shorter = run.parameters.stepping.longest_step * ELEMENT_PART / passed
        yield Advice(
            "perturbation lost in the steps' noise", passed,
            f"strength = {declared.strength:g} while the front passes {100 * passed:.2g} % of an "
            "element in the longest step, which shakes the patch as much; recommended is "
            f"longest_step = {shorter:.1g} or less",
        )  # fmt: skip


def _front_speed(run: Run) -> float:
    """Speed (m/s) of the front about where the patch turns unstable, roughly."""
    length = UNSTABLE * run.theory_length
    ends = (0.95 * length, 1.05 * length)
    first, last = (growth_time(run.parameters, end) for end in ends)
    return (ends[1] - ends[0]) / (last - first)
