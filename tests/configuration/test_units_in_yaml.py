"""Units in the configuration, as people write them, and one vocabulary for all of its readers."""

import pytest
from configurations import messages, study

from nucleation.fault.files import read_yaml
from replication.configuration.load import configure

SI = {
    "shear_modulus": 30e9, "poisson_ratio": 0.25, "density": 2650.0, "velocity": 1e-6,
    "height": 0.02, "normal_stress": 5e7, "slip_distance": 5e-6,
}  # fmt: skip


def test_units_are_read_wherever_a_parameter_stands(tmp_path):
    """In defaults and runs of a study, from a file with the signs that people use."""
    path = tmp_path / "my.yaml"
    path.write_text(
        "studies: {s: {defaults: {shear_modulus: 30 GPa, poisson_ratio: 1/4, density: 2650 kg·m⁻³,"
        " slip_distance: 5 µm, normal_stress: 50MPa, velocity: 1e-6 m s-1},"
        " runs: [{height: [2cm, 4 cm]}]}}",
        encoding="utf-8",
    )
    first, second = configure(read_yaml(path)).runs
    assert {name: first.value(name) for name in SI} == pytest.approx(SI, rel=1e-15)
    assert second.run.fault.height == 0.04


def test_sections_and_ranges_have_units_too():
    config = study({"height": {"start": "5 mm", "stop": "10 cm", "num": 3, "scale": "log"}})
    made = configure(
        config
        | {
            "material": {"shear_modulus": "30 GPa", "density": "1e3"},
            "stepping": {"end_time": "2 h"},
        }
        | {"curves": {"heights": ["5 mm", "1e1"]}}
    )
    assert made.curves.heights == (0.005, 10.0) and made.base.fault.density == 1000.0
    assert made.base.fault.shear_modulus == 30e9 and made.base.stepping.end_time == 7200.0
    assert [run.run.fault.height for run in made.runs] == [0.005, 0.0223607, 0.1]


def test_every_bad_unit_is_told_at_once_with_key_value_unit_and_range():
    text = messages(
        study({"height": "2 kg", "n_x": "8.5"}) | {"material": {"shear_modulus": "30 GPx"}}
    )
    assert "the configuration has 3 problems" in text
    assert "studies.s.runs[0].height = '2 kg' is not allowed: height of the body" in text
    assert "kg is a unit of mass, but m is needed" in text
    assert "material.shear_modulus = '30 GPx'" in text and "not a known unit" in text
    assert "runs[0].n_x = '8.5' is not allowed: number of elements along x must be an in" in text
