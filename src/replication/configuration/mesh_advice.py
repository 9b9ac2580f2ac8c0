"""Warnings about meshes and steps that do not resolve the front or the declared perturbation."""

import math
from collections.abc import Iterator

from nucleation.model.parameters import Geometry, Mesh
from nucleation.model.perturbation import ALONG_X, ELEMENTS_PER_CORRELATION
from nucleation.theory.estimates import growth_time, process_zone

from .runs import Run

Advice = tuple[str, float, str]
"""A warning about a run: its topic, its badness (larger is worse), its text."""

COARSE_X = "mesh too coarse along x"
COARSE_Y = "mesh too coarse along y"
ROUGHNESS = "roughness not resolved"
NOISE_OF_MESH = "perturbation lost in the mesh's noise"
NOISE_OF_STEPS = "perturbation lost in the steps' noise"
TOPICS = (COARSE_X, COARSE_Y, ROUGHNESS, NOISE_OF_MESH, NOISE_OF_STEPS)
"""Topics of the warnings in this module."""

UNSTABLE = 0.55
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


def element_sizes(mesh: Mesh, geometry: Geometry) -> tuple[float, float]:
    """Sizes of a block's elements at the interface.

    Parameters
    ----------
    mesh : Mesh
        Numbers of elements and grading.
    geometry : Geometry
        Length and height of the block (m).

    Returns
    -------
    along, across : float
        Length along x and height along y (m).
    """
    growth = mesh.grading ** (1.0 / (mesh.n_y - 1))
    rows = sum(growth**row for row in range(mesh.n_y))
    return geometry.length / mesh.n_x, geometry.height / rows


def _zone(run: Run) -> float:
    """Length (m) of the process zone when the patch has the theory's critical length."""
    critical = run.critical_length
    if math.isnan(critical):
        return process_zone(run.parameters)
    rest = growth_time(run.parameters, critical)
    return process_zone(run.parameters, rest)


def elements_per_zone(run: Run) -> float:
    """Number of elements along x in a process zone."""
    along, _ = element_sizes(run.parameters.mesh, run.parameters.geometry)
    return _zone(run) / along


def resolution(run: Run) -> Iterator[Advice]:
    """Meshes that do not resolve the process zone at the front."""
    parameters = run.parameters
    zone = _zone(run)
    mesh = parameters.mesh
    along, _ = element_sizes(mesh, parameters.geometry)
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
    blocks = [("", mesh, parameters.geometry)]
    below = parameters.below
    if below:
        blocks.append(("second_", below.mesh, below.geometry))
    for prefix, own, geometry in blocks:
        _, across = element_sizes(own, geometry)
        if across > zone / _ELEMENTS_PER_ZONE:
            yield (
                COARSE_Y,
                across / zone,
                f"{prefix}n_y = {own.n_y} and {prefix}grading = {own.grading:g} make elements of "
                f"{across:.3g} m at the interface, {zone / across:.2g} to a process zone of "
                f"{zone:.3g} m; recommended are {zone / _ELEMENTS_PER_ZONE:.3g} m or less",
            )


def roughness(run: Run) -> Iterator[Advice]:
    """Meshes that do not resolve the declared roughness."""
    mesh = run.parameters.mesh
    declared = run.parameters.perturbation
    along, _ = element_sizes(mesh, run.parameters.geometry)
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


def noise(run: Run) -> Iterator[Advice]:
    """Meshes and steps that perturb the patch as much as the declared perturbation."""
    declared = run.parameters.perturbation
    if not declared.acts or run.parameters.second_body.deformable:
        return  # the measures are those of one block
    yield from _noise_of_mesh(run)
    yield from _noise_of_steps(run)


def _noise_of_mesh(run: Run) -> Iterator[Advice]:
    mesh = run.parameters.mesh
    strength = run.parameters.perturbation.strength
    zone = _zone(run)
    along, _ = element_sizes(mesh, run.parameters.geometry)
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


def _noise_of_steps(run: Run) -> Iterator[Advice]:
    parameters = run.parameters
    strength = parameters.perturbation.strength
    along, _ = element_sizes(parameters.mesh, parameters.geometry)
    passed = _front_speed(run) * parameters.longest_step / along
    if passed > _ELEMENT_PART and strength <= _STEP_NOISE:
        shorter = parameters.stepping.longest_step * _ELEMENT_PART / passed
        yield (
            NOISE_OF_STEPS,
            passed,
            f"strength = {strength:g} while the front passes {100 * passed:.2g} % of an "
            "element in the longest step, which perturbs the patch as much; recommended is "
            f"longest_step = {shorter:.1g} or less",
        )


def _front_speed(run: Run) -> float:
    """Rough speed (m/s) of the front at the length where the patch turns unstable."""
    length = UNSTABLE * run.critical_length
    shorter = 0.95 * length
    longer = 1.05 * length
    start = growth_time(run.parameters, shorter)
    end = growth_time(run.parameters, longer)
    return (longer - shorter) / (end - start)
