"""Laws are files: what there is, what a run uses of it, and a law added while the program runs."""

import copy
import pickle
import sys
from pathlib import Path

import pytest

import nucleation.model.friction.evolutions as evolutions
import nucleation.model.friction.laws as laws
from nucleation.configuration import schema
from nucleation.configuration.load import configure
from nucleation.model.friction.law import Friction
from nucleation.model.friction.registry import (
    EVOLUTIONS,
    LAWS,
    USUAL_LAW,
    law_class,
    law_declarations,
    plugins,
)
from nucleation.model.parameters import Parameters, names
from nucleation.model.quantities import ParameterError, declarations
from nucleation.pipeline import code

HOME = "nucleation.model.friction"

COULOMB = '''"""Friction that depends on nothing but the direction of slip."""

import dataclasses

import numpy as np

from nucleation.model.friction.law import Friction, law_name
from nucleation.model.quantities import quantity


@dataclasses.dataclass(frozen=True)
class Law(Friction):
    law: str = law_name(__name__)
    level: float = quantity("friction coefficient", low=0.0, high=2.0, default=0.6)

    def coefficient_and_slopes(self, slip_rate, log_state):
        size = self.slip_speed(slip_rate)
        ratio = slip_rate / size
        by_rate = self.level * (1.0 - ratio**2) / size
        return self.level * ratio, by_rate, np.zeros_like(ratio + log_state)
'''


@pytest.fixture
def coulomb(tmp_path, monkeypatch):
    (tmp_path / "coulomb.py").write_text(COULOMB)
    monkeypatch.setattr(laws, "__path__", [*laws.__path__, str(tmp_path)])
    yield
    sys.modules.pop(f"{HOME}.laws.coulomb", None)


def test_a_law_is_a_file():
    for registry in (LAWS, EVOLUTIONS):
        package = Path(sys.modules[HOME].__file__).parent / registry.package.rpartition(".")[2]
        files = {path.stem for path in package.glob("*.py")} - {"__init__"}
        assert (
            set(registry) == files
            and len(registry) == len(files)
            and all(name in registry for name in files)
        )
        for name in ("", "__init__.py", "no such", "../law", 3, None):
            assert name not in registry
    assert {"product", "dieterich_ruina"} <= set(LAWS) and {"aging", "slip"} <= set(EVOLUTIONS)


def test_each_class_bears_the_name_of_its_file():
    for name in LAWS:
        assert law_class(name)().law == name
        assert Friction(law=name) == law_class(name)()
    assert Friction() == Friction(law=USUAL_LAW)


def test_parameters_of_the_same_name_are_the_same():
    """Two laws may share a parameter, not its name alone: `law_declarations` refuses that."""
    found = law_declarations()
    assert set(declarations(Friction)) <= set(found)
    assert found["aging_coefficient"].description == "aging coefficient (friction law product)"


def test_a_file_is_all_that_a_new_law_needs(coulomb):
    assert "coulomb" in LAWS and "coulomb" in list(LAWS)
    assert "friction.level" in names() and names().full("level") == "friction.level"
    assert "coulomb" in schema.build()["properties"]["friction"]["properties"]["law"]["enum"]
    friction = Friction(law="coulomb", level=0.5)
    assert friction.coefficient(1.0, 1.0) == pytest.approx(0.5)
    study = {"runs": [{"height": 0.1, "friction.law": "coulomb"}]}
    with pytest.raises(ParameterError, match="friction grows with slip rate"):
        configure({"friction": {"law": "coulomb", "level": 0.4}, "studies": {"s": study}})


def test_what_was_added_is_gone():
    assert "coulomb" not in LAWS and "friction.level" not in names()


def test_plugins_of_a_run():
    run = Parameters(friction=Friction(law="dieterich_ruina", evolution="slip"))
    expected = (f"{HOME}.laws.dieterich_ruina", f"{HOME}.evolutions.slip")
    assert plugins(run) == plugins(run.friction) == expected


def test_code_of_a_run_is_that_of_its_own_laws():
    """No law is reached by imports: the digest has those that are named beside, and no other."""
    packages = (f"{HOME}.laws.", f"{HOME}.evolutions.")
    plain = code.closure("nucleation.simulation.run")
    assert f"{HOME}.law" in plain and not [name for name in plain if name.startswith(packages)]
    own = plugins(Parameters())
    whole = code.closure("nucleation.simulation.run", *own)
    assert {name for name in whole if name.startswith(packages)} == set(own)


def test_objects_are_copied_and_stored():
    friction = Friction(law="dieterich_ruina", evolution="slip", log_state_coefficient=0.02)
    for again in (copy.deepcopy(friction), pickle.loads(pickle.dumps(friction))):
        assert again == friction and type(again) is type(friction)


def test_another_law_keeps_what_all_share():
    friction = Friction(characteristic_slip_distance=1e-6, evolution="slip", aging_coefficient=0.1)
    other = friction.changed({"law": "dieterich_ruina", "log_state_coefficient": 0.02})
    assert other == Friction(
        law="dieterich_ruina", characteristic_slip_distance=1e-6, evolution="slip",
        log_state_coefficient=0.02,
    )  # fmt: skip
    assert friction.changed({"law": "product"}) == friction


def test_parameters_of_another_law_are_refused():
    with pytest.raises(ParameterError) as caught:
        Friction(law="dieterich_ruina", aging_coefficient=0.1, state_scale=1.0)
    assert str(caught.value).startswith(
        "friction.aging_coefficient = 0.1, friction.state_scale = 1.0 is not allowed: "
        "the friction law dieterich_ruina has no such parameter; it has law, evolution, "
    )
    with pytest.raises(ParameterError, match=r"friction.law = 'none'.*one of dieterich_ruina, pr"):
        Friction(law="none")


def test_records_of_before_there_were_laws():
    """Parameters without the name of a law are the paper's law's."""
    values = Parameters().to_dict()
    assert values["friction"].pop("law") == "product"
    assert Parameters.from_dict(values) == Parameters()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a = 1\ndef growth(:\n", "line 2: the law odd can't be loaded: SyntaxError: "),
        ("a = 1\nb = 2\nc = d\n", "line 3: the law odd can't be loaded: NameError: name 'd'"),
        ("import nothing_of_it\n", "line 1: the law odd can't be loaded: ModuleNotFoundError"),
    ],
)
@pytest.mark.parametrize("package", [laws, evolutions])
def test_a_file_that_can_not_be_loaded_is_named_with_its_line(
    package, text, said, tmp_path, monkeypatch
):
    (tmp_path / "odd.py").write_text(text)
    monkeypatch.setattr(package, "__path__", [*package.__path__, str(tmp_path)])
    key = "friction.law" if package is laws else "evolution"
    with pytest.raises(ParameterError) as caught:
        configure({"studies": {"s": {"runs": [{"height": 0.1, key: "odd"}]}}})
    assert f"{tmp_path / 'odd.py'}, {said}" in str(caught.value)
