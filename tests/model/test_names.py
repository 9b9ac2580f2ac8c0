"""Full and short names of parameters."""

import pytest

from nucleation.model.names import Names
from nucleation.model.parameters import GROUPS, Parameters, names
from nucleation.model.quantities import ParameterError, declared

HEIGHT = declared("height", "(-inf, inf) m")
TWO = Names(
    {"geometry.height": HEIGHT, "geometry.length": HEIGHT, "second_body.height": HEIGHT,
     "friction.evolution": HEIGHT, "friction.law": HEIGHT},
    {"law": "friction.evolution"},
)  # fmt: skip


def test_full_and_short_names():
    for name in ("geometry.length", "length"):
        assert TWO.full(name) == "geometry.length"
    assert TWO.short("geometry.length") == "length"
    assert TWO.others("geometry.length") == ["geometry.length"]


def test_an_ambiguous_name_is_no_name():
    with pytest.raises(ParameterError, match="there is no parameter height"):
        TWO.full("height")
    assert TWO.short("second_body.height") == "second_body.height"
    assert TWO.others("second_body.height") == []


def test_an_alias_is_stronger():
    assert TWO.full("law") == TWO.full("evolution") == "friction.evolution"
    assert TWO.short("friction.evolution") == "law"
    assert TWO.others("friction.evolution") == ["friction.evolution", "evolution"]
    assert TWO.full("friction.law") == TWO.short("friction.law") == "friction.law"


def test_names_of_a_run():
    known = names()
    parameters = Parameters()
    assert set(parameters.named()) <= set(known)
    for full in known:
        group, _, field = full.rpartition(".")
        assert (group or "friction") in GROUPS and known[full].description
        assert known.full(known.short(full)) == full
        if group == "second_body":
            assert known.full(f"second_{field}") == full
        elif full != "loading.kind":
            assert known.full(field) == full
    assert known.short("friction.evolution") == "evolution" and known.full("initial_state") in known
    assert known.short("friction.law") == "friction_law"


def test_replaced_by_any_name():
    for height, law in (("height", "evolution"), ("geometry.height", "friction.evolution")):
        changed = Parameters().replaced({height: 0.2, law: "slip", "n_x": 80})
        assert (changed.geometry.height, changed.friction.evolution) == (0.2, "slip")
        assert changed.mesh.n_x == 80 and changed.mesh.n_y == Parameters().mesh.n_y


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"heigth": 0.2}, "there is no parameter heigth"),
        ({"geometry.n_x": 80}, "there is no parameter geometry.n_x"),
        ({"height": 0.2, "geometry.height": 0.1}, "given twice: it is geometry.height"),
        ({"height": -1.0}, "geometry.height = -1.0 m"),
        ({"log_state_coefficient": 0.1}, "the friction law product has no such parameter"),
    ],
)
def test_bad_replacements(values, message):
    with pytest.raises(ParameterError, match=message):
        Parameters().replaced(values)
