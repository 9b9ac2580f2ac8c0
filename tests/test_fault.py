"""One fault: its methods are the functions of the library, wherever the fault comes from."""

import dataclasses
import math

import numpy as np
import pint
import pytest
import xarray as xr

from nucleation import api
from nucleation.api import Fault, Friction, Geometry, Parameters
from nucleation.model.linearised import interface_state
from nucleation.model.quantities import ParameterError
from nucleation.theory.creep.lengths import stability_length_of
from nucleation.theory.critical import run_length

ROCK = {
    "shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6, "a": 0.010, "b": 0.015,
    "slip_distance": 5e-6,
}  # fmt: skip
BLOCKS = {"height": 0.5, "second_shear_modulus": 60e9, "second_height": 0.3, "friction": 0.6}
FAULTS = {
    "half-spaces": ROCK,
    "array": ROCK | {"height": [0.1, 0.5, math.inf]},
    "named array": ROCK | {"height": xr.DataArray([0.1, 0.5], dims="h")},
    "quantity": ROCK | {"normal_stress": pint.UnitRegistry().Quantity(50.0, "MPa")},
    "two bodies": ROCK | BLOCKS,
    "remote": ROCK | {"height": 0.5, "loading": "remote"},
    "law": {
        "shear_modulus": 3.1e9, "poisson_ratio": 1 / 3, "normal_stress": 1e6, "velocity": 1e-5,
        "friction_law": Friction(), "height": 0.02, "second_shear_modulus": math.inf,
    },
    "zone": ROCK | {"zone_thickness": 0.01, "zone_shear_modulus": 5e9},
    "antiplane": ROCK | {"plane": "antiplane", "height": 0.5},
}  # fmt: skip


def equal(found, expected):
    assert type(found) is type(expected)
    for one, other in zip(np.ravel(found), np.ravel(expected), strict=True):
        assert one == other or (math.isnan(one) and math.isnan(other))


@pytest.mark.parametrize("name", FAULTS)
def test_methods_are_the_functions(name):
    given = FAULTS[name]
    fault = Fault(**given)
    for question in ("critical_length", "stability_length"):
        function = getattr(api, question)
        equal(getattr(fault, question)(), function(**given))
        equal(function(**fault), function(**given))
    xr.testing.assert_identical(fault.lengths_in_use(), api.lengths_in_use(**given))
    with_velocity = given | {"velocity": 1e-6}
    equal(Fault(**with_velocity).spectrum(3.0), api.spectrum(3.0, **with_velocity))
    equal(fault.transfer_functions(3.0)[0], api.transfer_functions(3.0, **fault)[0])


def test_the_rest_of_the_questions():
    fault = Fault(**ROCK)
    statuses = api.length_statuses(**ROCK)
    xr.testing.assert_identical(fault.length_statuses(), statuses)
    assert fault.specimen_fit("normal_stress", 1.0) == api.specimen_fit(
        "normal_stress", 1.0, **{name: x for name, x in ROCK.items() if name != "normal_stress"}
    )
    width = api.weakening_patch_length(outside_zeta=-0.005, **ROCK)
    assert fault.weakening_patch_length(-0.005) == width


@pytest.mark.slow
def test_slow_slip_and_the_drop():
    fault = Fault(**ROCK, height=0.5, velocity=1e-6, friction=0.6)
    assert fault.runaway_length() == api.runaway_length(**fault)
    found = fault.expected_drop(strength=1e-5)
    assert found == api.expected_drop(fault.parameters(perturbation="normal_load", strength=1e-5))
    assert found.stability_length == pytest.approx(float(fault.stability_length()), rel=1e-6)


def test_a_friction_law_alone_gives_its_constants():
    fault = Fault(**FAULTS["law"])
    f, a, zeta = Friction().expansion(1e-5)
    assert (fault.friction, fault.a, fault.zeta) == (f, a, zeta)
    assert fault.slip_distance == Friction().slip_distance and fault.evolution == "aging"
    with pytest.raises(ParameterError, match="velocity is missing: a friction law is expanded"):
        Fault(**{**FAULTS["law"], "velocity": None})


@pytest.mark.parametrize(
    "changes",
    [
        {}, {"height": 0.1, "evolution": "slip"}, {"second_body": "deformable", "height": 0.01},
        {"second_body": "deformable", "second_far_side": "clamped", "second_shear_modulus": 9e9},
        {"plane": "antiplane"}, {"second_body": "deformable", "second_height": 0.01},
    ],
)  # fmt: skip
def test_the_fault_of_a_simulation(changes):
    parameters = Parameters(geometry=Geometry(height=0.02, length=2.0)).replaced(changes)
    fault = Fault.of(parameters)
    critical = run_length(parameters, interface_state(parameters))
    assert fault.critical_length() == pytest.approx(critical, rel=1e-12)
    if parameters.loading.kind == "edge":
        expected = stability_length_of(parameters, critical)
        assert fault.stability_length() == pytest.approx(expected, rel=1e-9)
        again = Fault.of(fault.parameters())
        assert again.critical_length() == pytest.approx(critical, rel=1e-9)
        assert again.stability_length() == pytest.approx(expected, rel=1e-6)


def test_a_file_is_read_as_by_the_commands(tmp_path):
    path = tmp_path / "fault.yaml"
    path.write_text(
        "shear_modulus: 30 GPa\npoisson: 0.25\nnormal_stress: 50 MPa\na: 0.01\nzeta_over_a: 0.5\n"
        "slip_distance: 5 um\nsecond_body: 60GPa,0.3,30cm\nheight: 50 cm\nfriction: 0.6\n"
        "zone_thickness: 1 cm\nzone_shear_modulus: 5 GPa\n"
    )
    expected = Fault(
        **ROCK | BLOCKS, second_poisson_ratio=0.3, zone_thickness=0.01, zone_shear_modulus=5e9
    )
    found = Fault.from_file(path)
    assert found.critical_length() == pytest.approx(float(expected.critical_length()), rel=1e-12)
    path.write_text("Dc: 5 um\n")
    with pytest.raises(ParameterError, match="did you mean slip_distance"):
        Fault.from_file(path)


@pytest.mark.parametrize(
    ("changes", "match"),
    [
        ({"Dc": 1e-6}, "did you mean slip_distance"),
        ({"a": None}, "a is missing: every fault needs it"),
        ({"height": [0.1, 0.2]}, "height has 2 values"),
        ({"far_side": "clamped"}, "far_side = 'clamped' is not allowed: the far side of a sim"),
    ],
)
def test_what_is_refused(changes, match):
    with pytest.raises(ParameterError, match=match):
        Fault(**{**ROCK, "velocity": 1e-6, "friction": 0.6, "height": 0.5, **changes}).parameters()


def test_it_is_frozen():
    with pytest.raises(dataclasses.FrozenInstanceError):
        Fault(**ROCK).a = 0.1
