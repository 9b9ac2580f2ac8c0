"""The sense of a contrast matters because the push changes the normal stress under the patch.

A patch between half-spaces with zeta/a = 10 and f beta = +-0.38, by an eigenproblem of its own
that shares no code with the library: slip in sines of quarter waves, Dundurs' constants, and the
creep's own normal stress in the friction, or sigma0 throughout.
"""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.optimize import brentq

PAIRS = Path(__file__).parents[2] / "results" / "reference" / "pairs.csv"
SOFT, STIFF, F, A, SIGMA0, D, V = 3.1e9, 1.209e11, 0.8, 0.0068, 1e6, 5e-7, 1e-5
WEAKENING = 10.0
N, BOX = 60, 4  # points on the patch, and lengths of it in the box


def modulus_and_contrast(upper, lower):
    """M and beta of two half-spaces with nu = 0, by Dundurs."""
    psi = lower / upper
    beta = (psi - 1.0) * 2.0 / ((psi + 1.0) * 4.0)
    return 2.0 / (1.0 / upper + 1.0 / lower) / (1.0 - beta**2), beta


def patch(length, upper, lower):
    """Response of slip on the patch, its slip rate, and its normal stress over sigma0."""
    modulus, beta = modulus_and_contrast(upper, lower)
    number = BOX * N
    x = (np.arange(number) + 0.5) * length / N
    k = (np.arange(number) + 0.5) * np.pi / (BOX * length)
    sines, cosines = np.sin(np.outer(k, x)), np.cos(np.outer(k, x))
    slip = 0.5 * modulus * k[:, None] * sines * 2.0 / number
    shear, normal = sines.T @ slip, beta * cosines.T @ slip
    response = shear + F * normal
    own, edge = response[:N, :N], response[:N].sum(axis=1)
    creep, load = np.linalg.solve(own, np.stack([edge, -F * SIGMA0 * np.ones(N)], axis=1)).T
    near = length - x[N - 6 : N]
    powers = np.stack([near**0.5, near**1.5, near**2.5], axis=1)
    singular = [np.linalg.lstsq(powers, d[-6:], rcond=None)[0][0] for d in (load, creep)]
    pushed = -singular[0] / singular[1]  # no singular stress at the front
    base = np.concatenate([load + pushed * creep, np.zeros(number - N)]) - pushed
    return own, creep * V, 1.0 + (normal @ base)[:N] / SIGMA0


def growth(length, upper, lower, uniform):
    own, rate, stress = patch(length, upper, lower)
    sigma = SIGMA0 * (np.ones(N) if uniform else stress)
    elastic = -(rate / (A * sigma))[:, None] * own
    healing = np.diag(-rate * (1.0 + WEAKENING))
    matrix = np.block([[elastic, healing], [-elastic / D, -(np.diag(rate) + healing) / D]])
    found = np.linalg.eigvals(matrix)
    return found[np.abs(found.imag) > 1e-3 * V / D].real.max()


def stability_ratio(upper, lower, uniform=False):
    """The patch length at which growth begins, over L_c^M."""
    unit = np.pi * modulus_and_contrast(upper, lower)[0] * D / (WEAKENING * A * SIGMA0)
    tried = np.linspace(0.35, 0.75, 9)
    found = np.array([growth(r * unit, upper, lower, uniform) for r in tried])
    after = int(np.argmax(found > 0.0))
    assert after > 0 and (found[:after] < 0.0).all()
    return brentq(
        lambda r: growth(r * unit, upper, lower, uniform), *tried[after - 1 : after + 1], xtol=1e-3
    )


def simulated(sign):
    pairs = pd.read_csv(PAIRS)
    own = pairs[
        np.isclose(pairs["zeta_over_a"], WEAKENING)
        & np.isclose(sign * pairs["f_beta"], 0.38, atol=1e-3)
    ]
    return (own["stability_ratio"] * own["half_space_ratio"]).iloc[0]


@pytest.mark.parametrize(
    ("bodies", "sign", "mean"), [((SOFT, STIFF), 1, 0.69), ((STIFF, SOFT), -1, 1.43)]
)
def test_the_simulated_lengths_follow_with_the_creeps_own_normal_stress(bodies, sign, mean):
    assert stability_ratio(*bodies) == pytest.approx(simulated(sign), rel=0.025)
    stress = patch(0.12, *bodies)[2]
    assert stress.mean() == pytest.approx(mean, abs=0.01)


def test_with_an_even_normal_stress_the_two_senses_are_nearly_the_same():
    below = stability_ratio(SOFT, STIFF, uniform=True)
    above = stability_ratio(STIFF, SOFT, uniform=True)
    assert below == pytest.approx(0.50, abs=0.01) and above == pytest.approx(0.525, abs=0.01)
    assert simulated(1) / simulated(-1) > 1.7
