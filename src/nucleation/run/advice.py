"""Warnings about a run with allowed values that are unlikely to give the intended results.

The limits are estimates from the linear theory and the thin block's statics; docs/studies.md has
those that a user plans with.
"""

import math
from collections.abc import Iterator

from ..model.settings import ALONG_X, ELEMENTS_PER_CORRELATION
from .estimates import element_height
from .run import Run

Advice = tuple[str, float, str]
"""A warning about a run: its topic, its badness (larger is worse), its text."""

COARSE_X = "mesh too coarse along x"
COARSE_Y = "mesh too coarse along y"
ROUGHNESS = "roughness not resolved"
NOISE_OF_MESH = "perturbation lost in the mesh's noise"
NOISE_OF_STEPS = "perturbation lost in the steps' noise"
OF_MESHES = (COARSE_X, COARSE_Y, ROUGHNESS, NOISE_OF_MESH, NOISE_OF_STEPS)
"""Topics of warnings about meshes and steps."""

FRICTION = "friction changes along the patch"
BELOW_CRITICAL = "block shorter than L_c"
_SHORT = "block short"

_UNSTABLE = 0.55
"""Length over the theory's critical length at which the creeping patch turns unstable."""

_ELEMENTS_PER_ZONE = 3.0
"""Fewest elements per process zone that resolve the front (Day and others, 2005)."""

_QUIET_ELEMENTS = 17.0
"""Elements per process zone of the study ``converged``, enough for strengths of 1e-5.

With so many the mesh perturbs the patch as little as a strength of 1e-9 does (docs/verification.md,
docs/drop.md).
"""

_COARSE_ELEMENTS = 9.5
"""Elements per process zone of the paper's mesh."""

_COARSE_NOISE = 1e-3
"""Strength up to which the paper's mesh changes onset times by one per cent."""

_DECADES_PER_ELEMENT = 0.8
"""Powers of ten by which each further element per process zone reduces that strength.

With 11 to 17 elements and a strength of 1e-4 nine of ten faults dropped within 0.1 % of the time
on a mesh with twice as many.
"""

_ELEMENT_PART = 0.04
"""Part of an element that the front may pass in one step.

If it passes more, the steps perturb the patch at least as much as the strength
:data:`_STEP_NOISE` does.
"""

_STEP_NOISE = 1e-5


_STEPS_PER_PERIOD = 8.0
"""Fewest time steps per period of the nucleating mode."""

_SHORT_BLOCK = 2.0
"""Block length over the critical length below which the far end affects the patch."""

_CHANGE_OF_FRICTION = 0.2
"""Smallest relative change of a or b from V to V/10 that causes a warning.

Slip rates at the front are about V/10. The change is 0.03 with the paper's scales; b of the
regularised Dieterich-Ruina law halves with V = 10 v0.
"""


def advice(run: Run, critical: float) -> Iterator[Advice]:
    """All warnings about a run, whose fault has the critical length `critical` (m; NaN: stable)."""
    yield from _resolution(run, critical)
    zeta = run.fault.zeta
    stable = math.isnan(critical)
    if stable and _has_weakening_patch(run):
        return
    if stable or zeta <= 0.0:
        yield _no_nucleation(run, critical)
        return
    yield from _steps(run)
    if run.fault.loading != "edge":
        return  # the other warnings are about patches that grow from an edge
    yield from _span(run, critical)
    yield from _block(run, critical)
    yield from _start(run)
    yield from changing_friction(run, critical)
    yield from _roughness(run)
    yield from _noise(run, critical)


def _has_weakening_patch(run: Run) -> bool:
    """Whether zeta, which is declared for the surroundings, is positive on a patch of the fault."""
    own = run.heterogeneity
    if own.varies == "a":
        return run.fault.zeta - run.fault.a * own.change > 0.0
    return own.varies == "zeta" and run.fault.zeta * (1.0 + own.change) > 0.0


def _no_nucleation(run: Run, critical: float) -> Advice:
    velocity = run.fault.velocity
    if math.isnan(critical):
        return (
            "nothing will nucleate",
            -run.fault.zeta,
            f"homogeneous sliding is stable at every wavelength, zeta = {run.fault.zeta:.3g} at V "
            f"= {velocity:g} m/s",
        )
    return (
        "friction strengthens",
        -run.fault.zeta,
        f"zeta = {run.fault.zeta:.3g} at V = {velocity:g} m/s; the "
        f"theory's critical length, {critical:.3g} m, is due to the normal stress "
        "alone, which slip changes: the patch grows slowly",
    )


def changing_friction(run: Run, critical: float) -> Iterator[Advice]:
    """Friction laws with scales v* and v0 so large that a and b change along the patch."""
    friction = run.law
    velocity = run.fault.velocity
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
    length = _stability_length(run, critical, constant=False)
    length_if_constant = _stability_length(run, critical, constant=True)
    scales = ", ".join(
        f"{name} = {getattr(friction, name):g} m/s"
        for name in ("slip_rate_scale", "regularisation_slip_rate")
        if hasattr(friction, name)
    )
    yield (
        FRICTION,
        change,
        f"{scales} beside V = {velocity:g} m/s: a = {a:.3g}, b = {b:.3g} at V, "
        f"{a_near:.3g}, {b_near:.3g} at V/10. L_s is {length}, with constant a and b "
        f"{length_if_constant}; give smaller scales unless these are intended "
        "(docs/creeping_patch.md)",
    )


def _stability_length(run: Run, critical: float, constant: bool) -> str:
    """L_s as text, with the friction law's own or with constant a and b."""
    from ..theory.creep.lengths import stability_length_of

    ratio = stability_length_of(run.patches, critical, constant) / critical
    return "none up to 3 L_c" if math.isnan(ratio) else f"{ratio:.2g} L_c"


def _steps(run: Run) -> Iterator[Advice]:
    longest = run.stepping.longest_step
    ratio = run.fault.a / run.fault.zeta
    period = 2.0 * math.pi * math.sqrt(ratio)  # in units of D/V
    if longest > period / _STEPS_PER_PERIOD:
        yield (
            "time steps too long",
            longest,
            f"longest_step = {longest:g} D/V makes {period / longest:.2g} steps in a period of the "
            f"nucleating mode; recommended is {period / _STEPS_PER_PERIOD:.2g} or less",
        )


def _span(run: Run, critical: float) -> Iterator[Advice]:
    end = run.stepping.end_time
    earliest = run.growth_time(_UNSTABLE * critical)
    if end < earliest:
        latest = run.growth_time(critical)
        yield (
            "simulated time too short",
            earliest / end,
            f"end_time = {end:g} s, but the patch needs about {earliest:.3g} s to become unstable "
            f"and {latest:.3g} s to reach the theory's critical length, {critical:.3g} m",
        )


def _block(run: Run, critical: float) -> Iterator[Advice]:
    length = run.block.length
    if length <= critical:
        yield (
            BELOW_CRITICAL,
            critical / length,
            f"block_length = {length:g} m is not above the theory's critical length, "
            f"{critical:.3g} m; it may have an event all the same, as a creeping patch turns "
            "unstable at less than that, but the block's far end changes it",
        )
    elif length < _SHORT_BLOCK * critical:
        yield (
            _SHORT,
            critical / length,
            f"block_length = {length:g} m is {length / critical:.3g} times the theory's "
            f"critical length, {critical:.3g} m; recommended are 4 to 6 times",
        )


def _start(run: Run) -> Iterator[Advice]:
    fault = run.fault
    coefficient = run.law.coefficient(fault.velocity, fault.initial_state)
    strength = float(coefficient) * fault.normal_stress
    initial = run.start.initial_shear_stress
    if initial >= strength:
        yield (
            "start above the strength",
            initial / strength,
            f"initial_shear_stress = {initial:g} Pa, while the interface "
            f"slips at V under {strength:.3g} Pa: it slips everywhere from the start",
        )


def _zone(run: Run, critical: float) -> float:
    """Length (m) of the process zone when the patch has the theory's critical length."""
    if math.isnan(critical):
        return run.process_zone()
    return run.process_zone(run.growth_time(critical))


def elements_per_zone(run: Run, critical: float) -> float:
    """Number of elements along x in a process zone."""
    return _zone(run, critical) / _element(run)


def _element(run: Run) -> float:
    """Length (m) of an element along x."""
    return run.block.length / run.block.n_x


def _resolution(run: Run, critical: float) -> Iterator[Advice]:
    """Meshes that do not resolve the process zone at the front."""
    zone = _zone(run, critical)
    mesh = run.block
    along = _element(run)
    if along > zone / _ELEMENTS_PER_ZONE:
        least = math.ceil(mesh.n_x * along / zone * _ELEMENTS_PER_ZONE)
        best = math.ceil(mesh.n_x * along / zone * _QUIET_ELEMENTS)
        yield (
            COARSE_X,
            along / zone,
            f"n_x = {mesh.n_x} makes elements of {along:.3g} m, {zone / along:.2g} to a process "
            f"zone of {zone:.3g} m; recommended is n_x = {least} or more, and about {best} for "
            "drops that follow a declared perturbation and not the mesh",
        )
    bodies = {"": run.upper}
    if run.below:
        bodies["second_"] = run.below
    for prefix, own in bodies.items():
        across = element_height(own.height, own.n_y, own.grading)
        if across > zone / _ELEMENTS_PER_ZONE:
            yield (
                COARSE_Y,
                across / zone,
                f"{prefix}n_y = {own.n_y} and {prefix}grading = {own.grading:g} make elements of "
                f"{across:.3g} m at the interface, {zone / across:.2g} to a process zone of "
                f"{zone:.3g} m; recommended are {zone / _ELEMENTS_PER_ZONE:.3g} m or less",
            )


def _roughness(run: Run) -> Iterator[Advice]:
    """Meshes that do not resolve the declared roughness."""
    mesh = run.block
    declared = run.perturbation
    along = _element(run)
    scale = declared.correlation_length
    rough = declared.acts and declared.kind in ALONG_X
    if rough and scale < ELEMENTS_PER_CORRELATION * along:
        least = math.ceil(mesh.n_x * ELEMENTS_PER_CORRELATION * along / scale)
        yield (
            ROUGHNESS,
            along / scale,
            f"correlation_length = {scale:g} m has {scale / along:.2g} elements of {along:.3g} m, "
            f"which represent another roughness; recommended is n_x = {least} or more",
        )


def _noise(run: Run, critical: float) -> Iterator[Advice]:
    """Meshes and steps that perturb the patch as much as the declared perturbation."""
    declared = run.perturbation
    if not declared.acts or run.below is not None:
        return  # the measures are those of one block
    yield from _noise_of_mesh(run, critical)
    yield from _noise_of_steps(run, critical)


def _noise_of_mesh(run: Run, critical: float) -> Iterator[Advice]:
    mesh = run.block
    strength = run.perturbation.strength
    zone = _zone(run, critical)
    along = _element(run)
    fewer = _COARSE_ELEMENTS - zone / along
    lost = _COARSE_NOISE * 10.0 ** min(_DECADES_PER_ELEMENT * fewer, 0.0)
    if strength < lost and zone < _QUIET_ELEMENTS * along:
        best = math.ceil(mesh.n_x * along / zone * _QUIET_ELEMENTS)
        yield (
            NOISE_OF_MESH,
            along / zone,
            f"strength = {strength:g} with {zone / along:.2g} elements to a process zone: "
            "the front's hops from node to node perturb the patch, and change onset times by 1 % "
            f"up to strengths of about {lost:.0e}; recommended is n_x = {best} or more",
        )


def _noise_of_steps(run: Run, critical: float) -> Iterator[Advice]:
    strength = run.perturbation.strength
    passed = _front_speed(run, critical) * run.longest_step / _element(run)
    if passed > _ELEMENT_PART and strength <= _STEP_NOISE:
        shorter = run.stepping.longest_step * _ELEMENT_PART / passed
        yield (
            NOISE_OF_STEPS,
            passed,
            f"strength = {strength:g} while the front passes {100 * passed:.2g} % of an "
            "element in the longest step, which perturbs the patch as much; recommended is "
            f"longest_step = {shorter:.1g} or less",
        )


def _front_speed(run: Run, critical: float) -> float:
    """Rough speed (m/s) of the front at the length where the patch turns unstable."""
    length = _UNSTABLE * critical
    shorter = 0.95 * length
    longer = 1.05 * length
    start = run.growth_time(shorter)
    end = run.growth_time(longer)
    return (longer - shorter) / (end - start)
