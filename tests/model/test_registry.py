"""Laws are files: what there is, and what a run uses of it."""

import pytest

import nucleation.model.friction.laws as laws
from nucleation.datasets import code
from nucleation.model.friction import LAWS, Friction, law_class, module, plugins
from nucleation.model.quantities import ParameterError
from nucleation.run.run import PAPER_RUN

HOME = "nucleation.model.friction"


def test_each_class_bears_the_name_of_its_file():
    for name in LAWS:
        assert law_class(name)().law == name
        assert Friction(law=name) == law_class(name)()


def test_code_of_a_run_is_that_of_its_own_laws():
    """No law is reached by imports: the digest has those that are named beside, and no other."""
    packages = (f"{HOME}.laws.", f"{HOME}.evolutions.")
    plain = code.closure("nucleation.simulation.run")
    assert HOME in plain and not [name for name in plain if name.startswith(packages)]
    own = plugins(PAPER_RUN.law)
    whole = code.closure("nucleation.simulation.run", *own)
    assert {name for name in whole if name.startswith(packages)} == set(own)


def test_another_law_keeps_what_all_share():
    friction = Friction(law="product", slip_distance=1e-6, evolution="slip", aging_coefficient=0.1)
    own = {"law": "dieterich_ruina", "log_state_coefficient": 0.02}
    assert friction.changed(own) == Friction(slip_distance=1e-6, evolution="slip", **own)
    assert friction.changed({"law": "product"}) == friction


def test_parameters_of_another_law_are_refused():
    words = r"= 0\.1, state_scale = 1\.0 is not .* dieterich_ruina has no such .* has law, evolu"
    with pytest.raises(ParameterError, match=words):
        Friction(law="dieterich_ruina", aging_coefficient=0.1, state_scale=1.0)
    with pytest.raises(ParameterError, match=r"friction_law = 'none'.*one of dieterich_ruina, pr"):
        Friction(law="none")
    for values in ({}, {"slip_distance": 1e-6}):  # no constants of the paper unasked
        with pytest.raises(ParameterError, match=r"missing: give law, .*paper's is product"):
            Friction(**values)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a = 1\ndef growth(:\n", "SyntaxError: .*odd.py, line 2"),
        ("a = 1\nb = 2\nc = d\n", "NameError: name 'd'"),
    ],
)
def test_a_file_that_can_not_be_loaded_is_named(text, said, tmp_path, monkeypatch):
    (tmp_path / "odd.py").write_text(text)
    monkeypatch.setattr(laws, "__path__", [*laws.__path__, str(tmp_path)])
    with pytest.raises(ParameterError, match=rf"laws/odd.py: the law odd can't be loaded: {said}"):
        module("laws", "odd")
