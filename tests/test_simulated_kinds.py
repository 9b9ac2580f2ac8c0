"""A simulated fault of each kind does as the library answers: strong, weak, specimen.

Weakening patches do so in tables/test_weakening_patches.py.
"""

import math

import pytest

from nucleation.api import Fault, Run, extract, simulate

NOISE = {"perturbation": "normal_load", "strength": 1e-5}
STRONG = Fault(
    shear_modulus=3.1e9,
    poisson_ratio=1 / 3,
    density=1200.0,
    normal_stress=1e6,
    a=0.005,
    b=0.02,
    slip_distance=0.5e-6,
    friction=0.4,
    velocity=1e-5,
    height=0.02,
    second_shear_modulus=math.inf,
)
WEAK = STRONG.replace(zeta=0.005)
PLATES = Fault(
    shear_modulus=3.1e9,
    poisson_ratio=0.33,
    density=1200.0,
    normal_stress=1e6,
    a=0.0068,
    zeta=0.0156,
    slip_distance=0.5e-6,
    friction=0.41,
    velocity=1e-5,
    height=0.1,
    plane="stress",
)
pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore::UserWarning")]


@pytest.mark.parametrize(
    ("fault", "settings"),
    [
        pytest.param(STRONG, {"n_x": 960, "n_y": 10}, id="strong: at L_c and noise"),
        pytest.param(WEAK, {"n_x": 160, "n_y": 4, "block_length": 2.0}, id="weak: at L_run"),
    ],
)
def test_the_force_drops_where_it_is_expected(fault, settings):
    """Within three deviations: 68 % of the realisations are between `low` and `high`."""
    answer = fault.lengths(**NOISE)["drop_length"]
    found = extract(simulate(Run.sized(fault, time_after_event=0.0, **settings, **NOISE)))
    assert abs(found["length"] - answer.value) < 1.5 * (answer.high - answer.low)


@pytest.mark.parametrize("length", [0.25, 0.15])
def test_a_specimen_that_may_nucleate_does(length):
    """L_s is 0.168 m: one specimen is longer, the other shorter, and L_c longer than both."""
    verdict = PLATES.stability_length()
    assert PLATES.critical_length() > 0.25 > verdict > 0.15
    run = Run.sized(PLATES, block_length=length, n_x=60, n_y=10, time_after_event=0.1, **NOISE)
    waves = math.sqrt(PLATES.shear_modulus / PLATES.density)
    dynamic = 2.0 * PLATES.a * PLATES.normal_stress * waves / PLATES.shear_modulus
    assert float(simulate(run).maximal_slip_rate.max()) > dynamic
