"""What entries of studies give: names, units, friction laws, a second body and its theory."""

import pytest
from configurations import messages, study

from nucleation.fault import Fault
from nucleation.fault.files import read_yaml
from nucleation.run.run import PAPER_RUN
from nucleation.run.sizing import stiffness_of
from replication.configuration.load import configure


def runs_of(*entries, **settings):
    return configure(study(*entries, **settings)).runs


def test_values_of_a_run_are_stronger_than_defaults():
    (run,) = runs_of({"height": 0.1}, defaults={"height": 0.2, "n_x": 90})
    assert (run.run.fault.height, run.run.block.n_x) == (0.1, 90)
    assert run.id == "s-aging-H0.1-phi1" and run.given == {"height": 0.1, "n_x": 90}


def test_end_of_a_run_that_is_given_none_follows_from_the_theory():
    """Not the paper's: late enough for an event, and soon after it."""
    config = study({"height": [0.1, 5.0]})
    low, high = configure(config).runs
    for run in (low, high):
        due = run.run.growth_time(run.critical_length)
        assert run.run.stepping.end_time == pytest.approx(1.5 * due, rel=0.05)
        assert run.run.stepping.time_after_event == pytest.approx(0.5)
    assert high.run.stepping.end_time != low.run.stepping.end_time
    section = {**config, "stepping": {"end_time": 16.0}}
    for given in (section, study({"height": 0.1, "end_time": 16.0})):
        assert configure(given).runs[0].run.stepping.end_time == 16.0
        assert configure(given).runs[0].run.stepping.time_after_event > 1.0


def test_a_second_body_is_named():
    runs = runs_of({"second_body": "deformable", "second_height": [0.1, 0.2], "height": 0.3})
    assert [run.run.below.height for run in runs] == [0.1, 0.2]
    assert runs[0].id == "s-aging-H0.3-phi1-second_bodydeformable-second_height0.1"


@pytest.mark.parametrize("bottom", ["free", "clamped", "roller"])
def test_each_run_has_the_theory_of_its_own_far_sides(bottom):
    own = {"second_far_side": bottom, "second_shear_modulus": 6e9, "second_height": 0.03}
    (run,) = runs_of({"height": 0.02, "second_body": "deformable", **own})
    friction = run.run.law.expansion(1e-5)
    expected = Fault(
        shear_modulus=3.1e9,
        poisson_ratio=1 / 3,
        height=0.02,
        friction=friction.f0,
        a=friction.a,
        zeta=friction.zeta,
        slip_distance=5e-7,
        normal_stress=1e6,
        **own,
    ).critical_length()
    assert run.critical_length == pytest.approx(float(expected), rel=1e-9)
    assert run.run.block.length == pytest.approx(6 * run.critical_length, rel=1e-3)


def test_estimates_go_with_the_softer_body():
    """In the limits of the theory, by hand: thick bodies share, thin ones bend on one another."""
    thick = PAPER_RUN.replaced(height=50.0, second_body="deformable")
    soft = thick.replaced(second_shear_modulus=3.1e7)
    own = 3.1e9 / (1.0 - 1.0 / 3.0)
    assert stiffness_of(thick.fault)[0] == pytest.approx(own / 2.0, rel=1e-6)
    assert soft.process_zone() < 0.03 * thick.process_zone()
    thin = PAPER_RUN.replaced(height=0.01, second_body="deformable")
    assert stiffness_of(thin.fault)[1] == pytest.approx(own * 2 * 0.01 / 8.0, rel=1e-4)
    clamped = thin.replaced(second_far_side="clamped")
    assert stiffness_of(clamped.fault)[1] == pytest.approx(own * 2 * 0.01, rel=1e-4)
    assert soft.growth_time(0.1) > 20 * thick.growth_time(0.1)


SI = {
    "shear_modulus": 30e9,
    "poisson_ratio": 0.25,
    "density": 2650.0,
    "velocity": 1e-6,
    "height": 0.02,
    "normal_stress": 5e7,
    "slip_distance": 5e-6,
}


def test_units_are_read_wherever_a_parameter_stands(tmp_path):
    """In defaults and runs of a study, from a file with the signs that people use."""
    path = tmp_path / "my.yaml"
    path.write_text(
        "studies: {s: {fault: paper, defaults: {shear_modulus: 30 GPa, poisson_ratio: 1/4,"
        " density: 2650 kg·m⁻³,"
        " slip_distance: 5 µm, normal_stress: 50MPa, velocity: 1e-6 m s-1},"
        " runs: [{height: [2cm, 4 cm]}]}}",
        encoding="utf-8",
    )
    first, second = configure(read_yaml(path)).runs
    assert {name: first.value(name) for name in SI} == pytest.approx(SI, rel=1e-15)
    assert second.run.fault.height == 0.04


def test_sections_and_ranges_have_units_too():
    config = study({"height": {"start": "5 mm", "stop": "10 cm", "num": 3, "scale": "log"}})
    config |= {"material": {"shear_modulus": "30 GPa", "density": "1e3"}}
    config |= {"stepping": {"end_time": "2 h"}, "curves": {"heights": ["5 mm", "1e1"]}}
    made = configure(config)
    assert made.curves.heights == (0.005, 10.0) and made.base.fault.density == 1000.0
    assert made.base.fault.shear_modulus == 30e9 and made.base.stepping.end_time == 7200.0
    assert [run.run.fault.height for run in made.runs] == [0.005, 0.0223607, 0.1]


def test_every_bad_unit_is_told_at_once_with_key_value_unit_and_range():
    config = study({"height": "2 kg", "n_x": "8.5"})
    text = messages(config | {"material": {"shear_modulus": "30 GPx"}})
    assert "the configuration has 3 problems" in text
    assert "studies.s.runs[0].height = '2 kg' is not allowed: height of the body" in text
    assert "kg is a unit of mass, but m is needed" in text
    assert "material.shear_modulus = '30 GPx'" in text and "not a known unit" in text
    assert "runs[0].n_x = '8.5' is not allowed: number of elements along x must be an in" in text
