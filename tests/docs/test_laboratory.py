"""Published laboratory faults: every number says where it was read, in a unit, within its range."""

import dataclasses
from pathlib import Path

import pytest
import yaml
from asked import critical_length, stability_length

from nucleation.answers.specimen import SPECIMEN
from nucleation.model.quantities import declared
from nucleation.model.units import parse
from nucleation.theory.values import QUANTITIES

PAGE = Path(__file__).parents[2] / "docs" / "laboratory.yaml"
FAULTS = yaml.safe_load(PAGE.read_text(encoding="utf-8"))
OTHERS = {
    **dict.fromkeys(("fault_length", "thickness", "observed_length"), SPECIMEN),
    "young_modulus": dataclasses.replace(QUANTITIES["shear_modulus"], description="E"),
    "density": declared("mass density", "(0.0, 1e6) kg/m^3"),
    "loading_rate": declared("rate of the shear stress", "(0.0, 1e15) Pa/s"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_numbers_have_a_place_a_unit_and_a_range(name):
    fault = FAULTS[name]
    assert {"title", "material", "source", "read"} <= fault.keys()
    assert not fault.keys() - {
        "title",
        "material",
        "source",
        "read",
        "says",
        "plane",
        "measured",
        "assumed",
    }
    read = [*fault.get("measured", {}).values(), *fault.get("assumed", {}).values()]
    assert not (read and fault["read"] == "not read")
    for numbers in read:
        for key, value in numbers.items():
            for end in value if isinstance(value, list) else [value]:
                parse(f"{name}.{key}", str(end), (QUANTITIES | OTHERS)[key])


def test_lengths_on_the_page():
    """Of the granite, with the numbers that the tutorial assumes."""
    fault = FAULTS["mclaskey_kilgore_2013"]["assumed"]
    given = {key: value for numbers in fault.values() for key, value in numbers.items()}
    numbers = {
        key: float(parse(key, str(value), (QUANTITIES | OTHERS)[key]))
        for key, value in given.items()
    }
    young = numbers.pop("young_modulus")
    numbers["shear_modulus"] = young / (2.0 * (1.0 + numbers["poisson_ratio"]))
    assert critical_length(**numbers) == pytest.approx(1.8, abs=0.05)
    assert stability_length(**numbers) == pytest.approx(1.2, abs=0.05)
