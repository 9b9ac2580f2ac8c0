"""One fault: one class, one conversion, and one answer about it, whatever form it has."""

import math

import numpy as np
import pint
import pytest
import xarray as xr
from asked import GRANITE, ROCK

from nucleation.api import PAPER, Fault, Friction
from nucleation.model.quantities import ParameterError

BLOCKS = {"height": 0.5, "second_shear_modulus": 60e9, "second_height": 0.3, "friction": 0.6}
FAULTS = {
    "half-spaces": ROCK,
    "array": ROCK | {"height": [0.1, 0.5, math.inf]},
    "named array": ROCK | {"height": xr.DataArray([0.1, 0.5], dims="h")},
    "quantity": ROCK | {"normal_stress": pint.UnitRegistry().Quantity(50.0, "MPa")},
    "two bodies": ROCK | BLOCKS,
    "remote": ROCK | {"height": 0.5, "loading": "remote"},
    "law": {
        "shear_modulus": 3.1e9,
        "poisson_ratio": 1 / 3,
        "normal_stress": 1e6,
        "velocity": 1e-5,
        "friction_law": Friction(law="product"),
        "height": 0.02,
        "second_shear_modulus": math.inf,
    },
    "zone": ROCK | {"zone_thickness": 0.01, "zone_shear_modulus": 5e9},
    "antiplane": ROCK | {"plane": "antiplane", "height": 0.5},
}


def equal(found, expected):
    assert type(found) is type(expected)
    for one, other in zip(np.ravel(found), np.ravel(expected), strict=True):
        assert one == other or (math.isnan(one) and math.isnan(other))


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_given_again_by_its_parameters(name):
    fault = Fault(**FAULTS[name])
    again = Fault(**fault)
    for question in ("critical_length", "stability_length"):
        equal(getattr(again, question)(), getattr(fault, question)())
    changed = fault.replace(b=0.02)
    assert np.allclose(np.asarray(changed.b, dtype=float), 0.02)
    assert changed.second_height is changed.height or "second_height" in FAULTS[name]


@pytest.mark.parametrize("name", sorted(set(FAULTS) - {"array", "named array", "quantity"}))
def test_a_fault_is_a_flat_mapping(name, tmp_path):
    fault = Fault(**FAULTS[name])
    assert Fault.from_dict(fault.to_dict()) == fault
    path = tmp_path / "fault.yaml"
    text = "\n".join(f"{k}: {v}" for k, v in fault.to_dict().items())
    path.write_text(text.replace("inf", "'inf'"))
    assert Fault.from_file(path) == fault


def test_the_paper_s_fault():
    assert PAPER.law() == Friction(law="product") and PAPER.law() is PAPER.friction_law
    assert round(PAPER.critical_length(), 3) == 0.238
    faster = PAPER.replace(velocity=2e-5)
    assert faster.a == Friction(law="product").expansion(2e-5).a != PAPER.a
    other = PAPER.replace(a=0.005)
    assert other.law().expansion(1e-5).a == pytest.approx(0.005)
    assert Fault.from_dict(other.to_dict()).law() == other.law()


def test_scalars_are_plain_numbers():
    """The repr showed array(3.e+10)."""
    text = repr(Fault(**ROCK | {"normal_stress": "50MPa"}))
    assert "shear_modulus=30000000000.0" in text and "normal_stress=50000000.0" in text
    assert "array" not in text


def test_velocity_and_friction_are_asked_for():
    """They were the paper's in silence: 1e-5 m/s and .41."""
    granite = Fault(**GRANITE)
    with pytest.raises(ParameterError, match=r"velocity \(m/s\) is missing"):
        granite.law()
    with pytest.raises(ParameterError, match="friction is missing"):
        granite.replace(velocity=1e-6).law()
    assert granite.density == 1200.0 and "1200 of PMMA (the paper's)" in Fault.__doc__


@pytest.mark.answers
def test_one_length_at_the_drop():
    """It was 1.068 m in one place and 1.314 m in another: slow slip lasts up to L_run."""
    found = Fault(**GRANITE, velocity=1e-6, friction=0.65).lengths()
    drop, runaway = found["drop_length"], found["runaway_length"]
    assert drop.value == runaway.value == pytest.approx(1.32, rel=0.03)
    assert drop.low < runaway.low < drop.value < runaway.high < drop.high, "with its own margin"
    assert drop.status == "value"
    table = found.dataset()
    assert float(table["value"].sel(length="drop_length")) == drop.value
    assert "length L at which the patch runs away" in repr(found)


def test_lengths_of_arrays_are_those_of_each_fault():
    fault = Fault(**GRANITE | {"b": [0.03, 0.04]}, velocity=1e-6, friction=0.65)
    found = fault.lengths()
    for i, b in enumerate([0.03, 0.04]):
        alone = Fault(**GRANITE | {"b": b}, velocity=1e-6, friction=0.65).lengths()
        for key, answer in alone.items():
            own = np.broadcast_to(found[key].value, 2)[i]
            assert own == pytest.approx(answer.value, nan_ok=True), key


def test_a_notebook_shows_values_with_units():
    shown = Fault(**ROCK)._repr_html_().splitlines()
    assert "normal_stress         50000000.0 Pa" in shown
    assert "a                     0.01" in shown


def test_evolution_and_law_are_one_thing():
    """The fault said slip, and its law, lengths and simulations were those of aging."""
    slip = PAPER.replace(height=0.05, evolution="slip")
    assert slip.evolution == slip.law().evolution == "slip"
    assert Fault.from_dict(slip.to_dict()) == slip
    assert slip.replace(friction_law=PAPER.friction_law).evolution == "aging"
    lengths = [float(f.lengths(strength=1e-4)["drop_length"].value) for f in (slip, PAPER)]
    assert lengths[0] == pytest.approx(0.4271, rel=0.01)
    with pytest.raises(ParameterError, match="evolution = 'slip' is not allowed with a friction"):
        Fault(**ROCK, velocity=1e-6, evolution="slip", friction_law=PAPER.friction_law)


def test_a_law_by_its_name_alone_is_refused():
    """It was an AttributeError."""
    with pytest.raises(ParameterError, match="friction_law = 'dieterich_ruina' is not allowed"):
        Fault(**ROCK, velocity=1e-6, friction=0.6, friction_law="dieterich_ruina")


def test_faults_of_arrays_are_compared_by_their_values():
    """== was a ValueError, and hash a TypeError."""
    many = Fault(**ROCK | {"normal_stress": [5e7, 1e8]})
    same = many.replace()
    assert many == same and hash(many) == hash(same)
    assert many != Fault(**ROCK) and many != many.replace(normal_stress=[5e7, 2e8])


def test_none_is_the_default_of_a_height():
    assert Fault(**ROCK, height=None, density=None) == Fault(**ROCK)


def test_a_notebook_shows_both_bodies_and_the_law():
    shown = dict(line.split()[:2] for line in PAPER._repr_html_().splitlines())
    assert shown["second_shear_modulus"] == "inf"
    shown = Fault(**ROCK)._repr_html_()
    assert "second_poisson_ratio  0.25" in shown and "friction_law          None" in shown


@pytest.mark.parametrize("form", [repr, Fault._repr_html_])
@pytest.mark.parametrize(
    ("fault", "body", "law"),
    [
        (PAPER, "rigid", "product; evolution: aging"),
        (Fault(**ROCK), "deformable, like the first", "none, a and b are constant"),
        (Fault(**ROCK, friction=0.6, velocity=1e-3, evolution="slip"), "like", "dieterich_ruina"),
        (Fault(**ROCK, friction=0.6, second_height=3.0), "like the first in all else", "none"),
    ],
)
def test_a_fault_says_what_it_slides_on_and_its_law(form, fault, body, law):
    shown = form(fault)
    assert body in shown.split("Second body: ")[1].split("Friction law: ")[0]
    assert law in shown.split("Friction law: ")[1]
