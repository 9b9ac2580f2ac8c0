"""The sense of a contrast matters because the push changes the normal stress under the patch.

A patch between half-spaces with zeta/a = 10 and f beta = +-0.38, by an eigenproblem of its own
that shares no code with the library: slip in sines of quarter waves, Dundurs' constants, and the
creep's own normal stress in the friction, or sigma0 throughout.
"""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from docs.prose import page
from scipy.optimize import brentq

PAIRS = Path(__file__).parents[2] / "results" / "reference" / "pairs.csv"
SOFT = 3.1e9  # Pa
STIFF = 1.209e11  # Pa
FRICTION = 0.8
A = 0.0068
WEAKENING = 10.0  # zeta/a
SIGMA0 = 1e6  # Pa
D = 5e-7  # m
V = 1e-5  # m/s
POINTS = 60  # on the patch
BOX = 4  # length of the box over that of the patch
FRONT = 6  # points next to the front for the singular stress


def modulus_and_contrast(upper, lower):
    """M and beta of two half-spaces with nu = 0, by Dundurs."""
    psi = lower / upper
    beta = (psi - 1.0) * 2.0 / ((psi + 1.0) * 4.0)
    compliance = 1.0 / upper + 1.0 / lower
    modulus = 2.0 / compliance / (1.0 - beta**2)
    return modulus, beta


def patch(length, upper, lower):
    """Response of slip on the patch, its slip rate, and its normal stress over sigma0."""
    modulus, beta = modulus_and_contrast(upper, lower)
    number = BOX * POINTS
    index = np.arange(number) + 0.5
    x = index * length / POINTS
    k = index * np.pi / (BOX * length)
    phase = np.outer(k, x)
    sines = np.sin(phase)
    slip = 0.5 * modulus * k[:, None] * sines * 2.0 / number
    shear = sines.T @ slip
    normal = beta * np.cos(phase).T @ slip
    response = shear + FRICTION * normal
    own = response[:POINTS, :POINTS]
    edge = response[:POINTS].sum(axis=1)
    creep = np.linalg.solve(own, edge)
    load = np.linalg.solve(own, -FRICTION * SIGMA0 * np.ones(POINTS))
    near = length - x[POINTS - FRONT : POINTS]
    # no singular stress at the front
    pushed = -singular(near, load) / singular(near, creep)
    on_patch = load + pushed * creep
    base = np.append(on_patch, np.zeros(number - POINTS)) - pushed
    stress = 1.0 + (normal @ base)[:POINTS] / SIGMA0
    return own, creep * V, stress


def singular(distance, slip):
    """The coefficient of the square root of the distance from the front in the slip next to it."""
    powers = np.stack([distance**0.5, distance**1.5, distance**2.5], axis=1)
    coefficients, *_ = np.linalg.lstsq(powers, slip[-FRONT:], rcond=None)
    return coefficients[0]


def growth(length, upper, lower, uniform):
    """The largest growth rate of oscillating modes of the patch."""
    own, rate, stress = patch(length, upper, lower)
    if uniform:
        stress = np.ones(POINTS)
    elastic = -(rate / (A * SIGMA0 * stress))[:, None] * own
    healing = np.diag(-rate * (1.0 + WEAKENING))
    decay = np.diag(rate) + healing
    matrix = np.block([[elastic, healing], [-elastic / D, -decay / D]])
    rates = np.linalg.eigvals(matrix)
    oscillating = np.abs(rates.imag) > 1e-3 * V / D
    return rates[oscillating].real.max()


def stability_ratio(upper, lower, uniform=False):
    """The patch length at which growth begins, over L_c^M."""
    modulus, _ = modulus_and_contrast(upper, lower)
    unit = np.pi * modulus * D / (WEAKENING * A * SIGMA0)

    def rate(ratio):
        return growth(ratio * unit, upper, lower, uniform)

    tried = np.linspace(0.35, 0.75, 9)
    rates = np.array([rate(ratio) for ratio in tried])
    after = int(np.argmax(rates > 0.0))
    assert after > 0 and (rates[:after] < 0.0).all()
    return brentq(rate, tried[after - 1], tried[after], xtol=1e-3)


def simulated(sign):
    pairs = pd.read_csv(PAIRS)
    weakening = np.isclose(pairs["zeta_over_a"], WEAKENING)
    contrast = np.isclose(sign * pairs["f_beta"], 0.38, atol=1e-3)
    own = pairs[weakening & contrast]
    ratios = own["stability_ratio"] * own["half_space_ratio"]
    return ratios.iloc[0]


@pytest.mark.parametrize(("bodies", "sign"), [((SOFT, STIFF), 1), ((STIFF, SOFT), -1)])
def test_simulated_lengths_follow_from_the_creeps_own_normal_stress(bodies, sign):
    assert stability_ratio(*bodies) == pytest.approx(simulated(sign), rel=0.025)
    stated = re.search(r"to ([\d.]+) and ([\d.]+) ..sigma_0. in the mean", page("loadings.md"))
    stress = patch(0.12, *bodies)[2]
    assert stress.mean() == pytest.approx(float(stated[1 if sign > 0 else 2]), abs=0.005)


def test_with_an_even_normal_stress_the_two_senses_are_nearly_the_same():
    below = stability_ratio(SOFT, STIFF, uniform=True)
    above = stability_ratio(STIFF, SOFT, uniform=True)
    assert below == pytest.approx(0.50, abs=0.01) and above == pytest.approx(0.525, abs=0.01)
    assert simulated(1) / simulated(-1) > 1.7
