"""Runs: one name for each parameter, copies with other values, what follows from the fault."""

import math

import pytest

from nucleation.fault import PAPER, Fault
from nucleation.model.quantities import ParameterError
from nucleation.run.derived import ensemble, fault
from nucleation.run.run import PAPER_RUN, Run

GRANITE = Fault(
    shear_modulus="30GPa",
    poisson_ratio=0.25,
    friction=0.65,
    a=0.010,
    b=0.015,
    slip_distance="5um",
    normal_stress="50MPa",
    velocity="1um/s",
    height="2m",
)
PAIR = PAPER_RUN.replaced(second_body="deformable", second_shear_modulus=6.2e9, second_n_y=9)


@pytest.mark.parametrize(
    "run",
    [
        PAPER_RUN,
        PAIR,
        PAPER_RUN.replaced(loading="remote", stress_rate=1e4, n_x=61, friction_law="product"),
        PAPER_RUN.replaced(friction_law="dieterich_ruina", a=0.01, zeta_over_a=2.0),
        Run.sized(GRANITE, perturbation="normal_load", strength=1e-4, seed=1),
    ],
)
def test_a_run_is_its_flat_values(run):
    again = Run.from_json(run.to_json())
    assert again == run and hash(again) == hash(run)
    assert again.to_dict() == run.to_dict() and run.replaced() == run
    assert run.fault.a == run.law.expansion(run.fault.velocity).a


def test_a_second_body_is_like_the_first_in_all_that_is_left_out():
    like = PAPER_RUN.replaced(second_body="deformable")
    taller = like.replaced(height=0.02)
    assert taller.below.height == 0.02 and taller.below.n_y == taller.block.n_y
    again = like.replaced(second_height=like.fault.height, second_far_side="traction")
    assert again == like and fault(again) == fault(like) and ensemble(again) == ensemble(like)
    assert PAIR.below.material.shear_modulus == 6.2e9 and PAIR.below.n_y == 9
    assert PAIR.replaced(second_shear_modulus=None).below.material == PAIR.upper.material
    assert PAIR.replaced(second_body="rigid", second_n_y=None).below is None


def test_constants_change_the_friction_law():
    run = PAPER_RUN.replaced(friction=0.6, a=0.01, b=0.015)
    assert run.law.expansion(1e-5) == pytest.approx((0.6, 0.01, 0.005))
    assert (run.fault.friction, run.fault.a) == pytest.approx((0.6, 0.01))


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"heigth": 0.2}, "there is no parameter heigth; did you mean height"),
        ({"law": "product"}, "there is no parameter law; did you mean friction_law"),
        ({"length": 1.0}, "did you mean block_length"),
        ({"height": -1.0}, "height = -1.0 m is not allowed"),
        ({"n_x": 7}, r"n_x = 7 is not allowed: .* integer in \[8, 100000\]"),
        ({"second_height": 0.1}, "second_height = 0.1 is not allowed with second_body = rigid"),
    ],
)
def test_bad_values_are_refused(values, message):
    with pytest.raises(ParameterError, match=message):
        PAPER_RUN.replaced(**values)


def test_what_follows_from_the_fault():
    """The paper's v*, v0, phi*, age and correlation length are those of V = 10 um/s, D = .5 um."""
    run = Run.sized(GRANITE, n_x=800)
    critical = run.critical_length
    assert run.block.length == float(f"{6.0 * critical:.4g}") and run.block.n_x == 800
    assert run.fault.initial_state == pytest.approx(20.0 * 5e-6 / 1e-6)
    assert run.law.law == "dieterich_ruina" and run.law.slip_distance == 5e-6
    assert run.law.reference_slip_rate == 1e-6
    assert run.law.regularisation_slip_rate == pytest.approx(1e-10)
    assert run.stepping.end_time > run.growth_time(critical) > run.stepping.time_after_event
    zone = 30e9 / 0.75 * 5e-6 / (0.015 * 50e6)
    assert run.perturbation.correlation_length == pytest.approx(0.2 * zone)
    assert Run.sized(PAPER).fault.initial_state == 1.0


def test_half_spaces_become_high_and_long_blocks():
    high = GRANITE.replace(height=math.inf)
    run, critical = Run.sized(high), high.critical_length()
    assert run.fault.height == run.below.height == pytest.approx(4.0 * critical, rel=1e-3)
    assert run.block.length == pytest.approx(35.0 * critical, rel=1e-3)
    assert run.process_zone() / (run.block.length / run.block.n_x) >= 6.0
    assert run.fault.stability_length() == pytest.approx(high.stability_length(), rel=0.03)


PMMA = Fault(
    shear_modulus=2.4e9,
    poisson_ratio=0.35,
    friction=0.4,
    a=0.01,
    b=0.013,
    slip_distance=1e-6,
    normal_stress=1e6,
    velocity=1e-5,
    density=1200.0,
    height=4e-3,
    second_shear_modulus=math.inf,
)
LOAD = {"perturbation": "normal_load", "strength": 1e-4}


@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"b": 0.012, "height": 0.05},
        {"b": 0.015, "height": math.inf, "second_shear_modulus": 2.4e9},
        {"b": 0.017, "height": 0.02, "evolution": "slip"},
        {"b": 0.05, "height": 0.02},
    ],
)
def test_a_run_lasts_and_reaches_beyond_its_drop(changed):
    """Weak faults ended before it: their block and end were multiples of L_c and its time."""
    run = Run.sized(PMMA.replace(**changed), **LOAD)
    assert run.reach.unstable < run.reach.drop < run.reach.latest
    assert run.stepping.end_time > 1.45 * run.growth_time(run.reach.latest)
    assert run.block.length > run.reach.latest / 0.6
    assert run.reach.latest <= run.longest_reach
    assert run.fault.height > run.reach.latest or math.isfinite(PMMA.replace(**changed).height)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"velocity": None}, "velocity"),
        ({"friction": None}, "friction"),
        ({"height": [0.1, 0.2]}, "height has 2 values"),
        ({"far_side": "clamped"}, "far_side = 'clamped' is not allowed"),
        ({"b": 0.009}, "a control run, in which nothing is to nucleate, needs its block_length"),
    ],
)
def test_what_is_missing_is_asked_for(changed, message):
    """V and f of the paper were taken in silence."""
    with pytest.raises(ParameterError, match=message):
        Run.sized(GRANITE.replace(**changed))


def test_records_of_earlier_versions_are_refused():
    for bad in ({"material": {"shear_modulus": 3.1e9}}, {}, [1], "text"):
        with pytest.raises(ParameterError, match="no run of this version"):
            Run.from_dict(bad)
    text = PAPER_RUN.to_dict() | {"height": "high"}
    with pytest.raises(ParameterError, match="height = 'high' is not allowed"):
        Run.from_dict(text)


CHANGES = {
    "regularisation_slip_rate": 1e-11,
    "reference_slip_rate": 2e-6,
    "zeta_over_a": 0.006,
    "height": 3.0,
    "second_body": math.inf,
    "friction_law": GRANITE.law().changed({"regularisation_slip_rate": 1e-11}),
}


@pytest.mark.parametrize("name", CHANGES)
def test_the_advice_for_a_parameter_of_the_fault_can_be_followed(name):
    """It was fault.replace(regularisation_slip_rate=...), which is refused."""
    with pytest.raises(ParameterError, match="is a parameter of the fault") as refused:
        Run.sized(
            GRANITE, **{name: {"friction_law": "product", "second_body": "rigid"}.get(name, 1e-7)}
        )
    advised = str(refused.value).split(": ", 1)[1].removesuffix(" changes it")
    changed = eval(advised.replace("...", "value"), {"fault": GRANITE, "value": CHANGES[name]})
    assert (
        changed != GRANITE
        and Run.sized(changed, block_length=9.0).fault.velocity == GRANITE.velocity
    )
