"""Warnings about a run with allowed values that are unlikely to give the intended results.

The limits are estimates from the linear theory and the thin block's statics; docs/studies.md has
those that a user plans with.
"""

import math
from collections.abc import Iterator

from ..model.settings import ELEMENTS_PER_CORRELATION, NEAR_END
from .reach import longest_reach, reach_of
from .run import Run
from .sizing import element_height


class RunWarning(UserWarning):
    """A run has allowed values that are unlikely to give the intended results."""


Advice = tuple[str, float, str]
"""A warning about a run: its topic, its badness (larger is worse), its text."""

COARSE_X = "mesh too coarse along x"
COARSE_Y = "mesh too coarse along y"
ROUGHNESS = "roughness not resolved"
NOISE_OF_MESH = "perturbation lost in the mesh's noise"
OF_MESHES = (COARSE_X, COARSE_Y, ROUGHNESS, NOISE_OF_MESH)
"""Topics of warnings about meshes."""

TOO_EARLY = "simulated time too short"
BEFORE_DROP = "simulated time may end before the drop"
LOOSE = "tolerance too large"

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

_STEPS_PER_PERIOD = 8.0
"""Fewest time steps per period of the nucleating mode."""

_LOOSE = 0.1
"""Largest tolerance of the local error with which L is that of the default within some per cent."""


def advice(run: Run, critical: float) -> Iterator[Advice]:
    """All warnings about a run, whose fault has the critical length `critical` (m; NaN: stable)."""
    yield from _resolution(run, critical)
    zeta, velocity, own = run.fault.zeta, run.fault.velocity, run.heterogeneity
    if math.isnan(critical):
        within = zeta - run.fault.a * own.change if own.varies == "a" else zeta
        if own.varies == "zeta":
            within = zeta * (1.0 + own.change)
        if own.varies == "none" or within <= 0.0:  # no weakening patch
            yield (
                "nothing will nucleate",
                -zeta,
                f"homogeneous sliding is stable at every wavelength, zeta = {zeta:.3g} at V "
                f"= {velocity:g} m/s",
            )
        return
    if zeta <= 0.0:
        yield (
            "friction strengthens",
            -zeta,
            f"zeta = {zeta:.3g} at V = {velocity:g} m/s; the "
            f"theory's critical length, {critical:.3g} m, is due to the normal stress "
            "alone, which slip changes: the patch grows slowly",
        )
        return
    longest = run.stepping.longest_step
    period = 2.0 * math.pi * math.sqrt(run.fault.a / zeta)  # in units of D/V
    if longest > period / _STEPS_PER_PERIOD:
        yield (
            "time steps too long",
            longest,
            f"longest_step = {longest:g} D/V makes {period / longest:.2g} steps in a period of the "
            f"nucleating mode; recommended is {period / _STEPS_PER_PERIOD:.2g} or less",
        )
    tolerance = run.stepping.tolerance
    if tolerance > _LOOSE:
        yield (
            LOOSE,
            tolerance,
            f"tolerance = {tolerance:g} is the error of log slip rate and log state that a step "
            f"may have; recommended is {_LOOSE:g} or less",
        )
    if run.fault.loading == "edge":
        yield from _of_patches(run, critical)
        yield from _of_perturbation(run, critical)
    elif run.heterogeneity.varies == "none":
        yield from _of_remote_load(run, critical)


def _of_patches(run: Run, critical: float) -> Iterator[Advice]:
    """Times and blocks in which no patch grows from the edge until the force drops; L_c in m."""
    end, length = run.stepping.end_time, run.block.length
    # nothing is asked of the theory where time and block are enough for the longest patch there is
    most = longest_reach(run.fault, critical)
    if end >= run.growth_time(most) and NEAR_END * length >= most:
        return
    reach = reach_of(run.fault, run.law, run.start, run.perturbation, critical)
    stable, due = run.growth_time(reach.unstable), run.growth_time(reach.drop)
    if end < due or end < stable:
        unstable = ""
        if not math.isnan(stable):
            unstable = (
                f"about {stable:.3g} s to become unstable, at L_s = {reach.unstable:.3g} m, and "
            )
        yield (
            TOO_EARLY if end < stable else BEFORE_DROP,
            due / end,
            f"end_time = {end:g} s, but the patch needs {unstable}about {due:.3g} s until the "
            f"force drops, at L = {reach.drop:.3g} m (theory's critical length: {critical:.3g} m)",
        )
    if reach.latest > NEAR_END * length:
        yield (
            "block short",
            reach.latest / length,
            f"block_length = {length:g} m, but the patch becomes up to {reach.latest:.3g} m long "
            f"until the force drops; recommended is {reach.latest / NEAR_END:.3g} m or more. "
            "A shorter block may have an event all the same, but its far end changes it",
        )


def _of_remote_load(run: Run, critical: float) -> Iterator[Advice]:
    """Times and periods in which nothing nucleates under a remote load; L_c in m."""
    end, length, due = run.stepping.end_time, run.block.length, run.growth_time(critical)
    if end < due:
        yield (
            TOO_EARLY,
            due / end,
            f"end_time = {end:g} s, but the shear stress needs about {due:.3g} s to reach the "
            f"interface's strength, at stress_rate = {run.start.stress_rate:g} Pa/s",
        )
    if length < critical:
        yield (
            "period short",
            critical / length,
            f"block_length = {length:g} m is the period along x, and homogeneous sliding is "
            f"unstable from the theory's critical length on, {critical:.3g} m: nothing will "
            "nucleate",
        )


def _zone(run: Run, critical: float) -> float:
    """Length (m) of the process zone when the patch has the theory's critical length."""
    rest = 0.0 if math.isnan(critical) else run.growth_time(critical)
    return run.process_zone(rest)


def _element(run: Run) -> float:
    """Length (m) of an element along x."""
    return run.block.length / run.block.n_x


def elements_per_zone(run: Run, critical: float) -> float:
    """Number of elements along x in a process zone."""
    return _zone(run, critical) / _element(run)


def _resolution(run: Run, critical: float) -> Iterator[Advice]:
    """Meshes that do not resolve the process zone at the front."""
    zone, along, n_x = _zone(run, critical), _element(run), run.block.n_x
    if along > zone / _ELEMENTS_PER_ZONE:
        least = math.ceil(n_x * along / zone * _ELEMENTS_PER_ZONE)
        best = math.ceil(n_x * along / zone * _QUIET_ELEMENTS)
        yield (
            COARSE_X,
            along / zone,
            f"n_x = {n_x} makes elements of {along:.3g} m, {zone / along:.2g} to a process "
            f"zone of {zone:.3g} m; recommended is n_x = {least} or more, and about {best} for "
            "drops that follow a declared perturbation and not the mesh",
        )
    for prefix, own in {"": run.upper, "second_": run.below}.items():
        if own is None:
            continue
        across = element_height(own.height, own.n_y, own.grading)
        if across > zone / _ELEMENTS_PER_ZONE:
            yield (
                COARSE_Y,
                across / zone,
                f"{prefix}n_y = {own.n_y} and {prefix}grading = {own.grading:g} make elements of "
                f"{across:.3g} m at the interface, {zone / across:.2g} to a process zone of "
                f"{zone:.3g} m; recommended are {zone / _ELEMENTS_PER_ZONE:.3g} m or less",
            )


def _of_perturbation(run: Run, critical: float) -> Iterator[Advice]:
    """Meshes that do not resolve the roughness, or perturb the patch as much as is declared."""
    declared, along, n_x = run.perturbation, _element(run), run.block.n_x
    if not declared.acts:
        return
    scale = declared.correlation_length
    if declared.along_x and scale < ELEMENTS_PER_CORRELATION * along:
        least = math.ceil(n_x * ELEMENTS_PER_CORRELATION * along / scale)
        yield (
            ROUGHNESS,
            along / scale,
            f"correlation_length = {scale:g} m has {scale / along:.2g} elements of {along:.3g} m, "
            f"which represent another roughness; recommended is n_x = {least} or more",
        )
    zone = _zone(run, critical)
    fewer = _COARSE_ELEMENTS - zone / along
    lost = _COARSE_NOISE * 10.0 ** min(_DECADES_PER_ELEMENT * fewer, 0.0)
    measured = run.below is None  # the noise of meshes is that of one block
    if measured and declared.strength < lost and zone < _QUIET_ELEMENTS * along:
        best = math.ceil(n_x * along / zone * _QUIET_ELEMENTS)
        yield (
            NOISE_OF_MESH,
            along / zone,
            f"strength = {declared.strength:g} with {zone / along:.2g} elements to a process zone: "
            "the front's hops from node to node perturb the patch, and change onset times by 1 % "
            f"up to strengths of about {lost:.0e}; recommended is n_x = {best} or more",
        )
