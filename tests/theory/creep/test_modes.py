"""The patch's modes against sums of plane waves in a long box, and against known profiles."""

import numpy as np
import pytest
from two_bodies import RIGID, Body, Interface, system, transfer_functions

from nucleation.model.material import Material
from nucleation.theory.creep.linearised import creep
from nucleation.theory.creep.response import response

MATERIAL = Material(shear_modulus=3.1e9, poisson_ratio=1 / 3)
FAULT = Interface()
BOX, WAVES = 30.0, 8000  # box over L


def pair(height, below=RIGID):
    return Body(MATERIAL, height, "free"), below


def in_a_box(bodies, length, slip, x, even):
    """Stresses over sigma0 of a slip (m) that vanishes at the ends of the box, by quarter waves.

    It is even about 0, or odd; in both, an upper block's ``S2`` is a derivative along x.
    """
    size = BOX * length
    k = (np.arange(WAVES) + 0.5) * np.pi / size
    points = (np.arange(1000) + 0.5) / 1000 * length
    weights = slip(points) * (points[1] - points[0])
    wave, slope = (np.cos, lambda at: -np.sin(at)) if even else (np.sin, np.cos)
    amplitude = 2.0 / size * wave(np.outer(k, points)) @ weights
    shear, normal = transfer_functions(k, *bodies)
    scale = amplitude * MATERIAL.shear_modulus * k / FAULT.normal_stress
    return (
        np.array([wave(k * at) @ (scale * shear) for at in x]),
        np.array([slope(k * at) @ (scale * normal) for at in x]),
    )


@pytest.mark.parametrize(
    "bodies",
    [
        pair(0.05),
        pair(0.5),
        pair(0.05, Body(Material(shear_modulus=6.2e9, poisson_ratio=0.25), 0.1, "clamped")),
        (Body(Material(shear_modulus=3.1e9, poisson_ratio=0.1), 0.1), Body(MATERIAL)),
    ],
)
@pytest.mark.parametrize("loading", ["edge", "remote"])
def test_stress_of_slip(bodies, loading):
    """Slip of a pushed edge is odd, in the interior it is odd and even."""
    length = 0.3
    one = system(*bodies, FAULT)
    made = response(one, 2.0 * length if loading == "remote" else length, 24, loading)
    own = made.modes
    x = length * np.cos(own.theta)
    share = {"edge": (1.0, 0.0), "remote": (0.4, 1.0)}[loading]

    def part(x, even):
        slip = share[even] * (1.0 - (x / length) ** 2) ** 3 * FAULT.slip_length
        return slip if even else slip * x / length

    slip = (part(x, False) + part(x, True)) / FAULT.slip_length
    known = np.append(0.0, own.inverse @ slip)
    inner = np.append(np.arange(4, 22, 4), np.arange(28, 46, 4) if loading == "remote" else [])
    inner = inner.astype(int)
    both = [
        in_a_box(bodies, length, lambda x, e=even: part(x, e), x[inner], even)
        for even in (False, True)
    ]
    shear, normal = np.sum(both, axis=0)
    # the upper body's modulus, by which transfer functions are normalised, is the same in all
    assert (made.shear @ known)[inner] == pytest.approx(
        shear, rel=2e-3, abs=2e-3 * np.abs(shear).max()
    )
    largest = np.abs(normal).max()
    assert (made.normal @ known)[inner] == pytest.approx(normal, rel=5e-3, abs=5e-3 * largest)


def test_half_spaces_creep_as_a_crack_does():
    """Their slip rate is ``(2/pi) arccos(x/L)``, and no stress normal to them changes."""
    one = system(Body(MATERIAL), Body(MATERIAL), FAULT)
    made = creep(response(one, 0.5), FAULT.friction)
    theta = made.response.modes.theta
    assert made.slip_rate == pytest.approx(2.0 * theta / np.pi, rel=1e-9)
    assert made.normal_stress == pytest.approx(np.ones_like(theta))


def test_thin_layers_are_compressed_evenly():
    """Their slip rate is ``1 - x/L``, and the edge moves ``(1 - nu) f sigma0 L^2/(4 mu H)``."""
    length, height = 0.5, 2e-3
    one = system(*pair(height), FAULT)
    made = creep(response(one, length), FAULT.friction)
    x = np.cos(made.response.modes.theta)
    assert made.slip_rate == pytest.approx(1.0 - x, abs=0.01)
    moved = (1.0 - 1 / 3) * FAULT.friction * FAULT.normal_stress * length**2 / (4 * 3.1e9 * height)
    # the front's own resistance is some heights long
    assert made.loaded * FAULT.slip_length == pytest.approx(moved, rel=0.03)


def test_the_push_takes_compression_off_a_softer_upper_block():
    """Pushed in +x the block above thickens; the stiffer body below has f beta > 0."""
    softer = system(Body(MATERIAL), RIGID, FAULT)
    stiffer = system(RIGID, Body(MATERIAL), FAULT)
    means = [
        creep(response(one, 0.5, 32), FAULT.friction).normal_stress.mean()
        for one in (softer, stiffer)
    ]
    assert means[0] < 1.0 < means[1]
