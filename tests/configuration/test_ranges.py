"""The JSON schema, for editors, and the library's own checks allow the same values."""

import math
import numbers
import sys

import jsonschema
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from replication.configuration import schema
from replication.configuration.refusals import value_problems
from replication.configuration.study_names import study_parameters

SCHEMA = schema.build()
STUDY = SCHEMA["$defs"]["study"]["properties"]["defaults"]["properties"]
DECLARED = {
    f"{group}.{name}": (SCHEMA["properties"][group]["properties"][name], entry)
    for group in schema.GROUPS
    for name, entry in schema.group_entries(group).items()
} | {f"studies.{name}": (STUDY[name], entry) for name, entry in study_parameters().items()}


def near(end):
    """An end of a range, the numbers beside it, and others about as large."""
    if not math.isfinite(end):
        return st.nothing()
    beside = [end, math.nextafter(end, math.inf), math.nextafter(end, -math.inf), int(end)]
    return st.sampled_from(beside) | st.floats(end - abs(end) - 1.0, end + abs(end) + 1.0)


def values(entry):
    """Numbers in and out of a range, and what is no number, or one only for Python."""
    numbers = near(entry.low) | near(entry.high) | st.integers(-5, 5) | st.floats()
    return numbers | st.booleans() | st.none() | st.sampled_from(("", "1.0", *entry.choices))


def is_number(_, value):
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return False
    return abs(value) <= sys.float_info.max  # no integer beyond, and no NaN


def is_integer(_, value):
    return isinstance(value, int) and not isinstance(value, bool)


Validator = jsonschema.validators.extend(
    jsonschema.Draft202012Validator,
    type_checker=jsonschema.Draft202012Validator.TYPE_CHECKER.redefine_many(
        {"number": is_number, "integer": is_integer}
    ),
)


def is_valid(value, node=SCHEMA):
    """What an editor makes of a value, or of a whole configuration."""
    return Validator({"$defs": SCHEMA["$defs"], **node}).is_valid(value)


@pytest.mark.parametrize("key", DECLARED)
@settings(max_examples=15)
@given(data=st.data())
def test_schema_allows_what_the_library_allows(key, data):
    node, entry = DECLARED[key]
    value = data.draw(values(entry))
    allowed = entry.allows((value,) if entry.many else value)
    allowed &= value not in (math.inf, -math.inf)  # YAML has it, and no parameter takes it there
    assert is_valid(value, node) == allowed
    group, name = key.split(".")
    if group == "studies":
        config = {"studies": {"s": {"runs": [{"height": 1.0}], "defaults": {name: value}}}}
    else:
        config = {group: {name: value}, "studies": {"s": {"runs": [{"height": 1.0}]}}}
    assert (list(value_problems(config)) == []) == allowed


FORMS = st.recursive(
    st.none() | st.booleans() | st.sampled_from((1, 2, 0.5, -1.0, "aging", "x", "", "log")),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(("start", "stop", "num", "scale", "height")), inner)
    ),
    max_leaves=6,
)


@pytest.mark.parametrize("key", ["height", "evolution", "n_x", "initial_state", "defaults"])
@settings(max_examples=150)
@given(value=FORMS)
def test_schema_allows_the_same_forms_of_what_a_run_gives(key, value):
    config = {"studies": {"s": {"runs": [{"density": 1.0, key: value}]}}}
    assert (list(value_problems(config)) == []) == is_valid(config)


@pytest.mark.parametrize("key", ["results", "curves", "studies", "friction"])
@settings(max_examples=150)
@given(value=FORMS)
def test_schema_allows_the_same_forms_of_sections(key, value):
    config = {"studies": {"s": {"runs": [{"height": 1.0}]}}, key: value}
    assert (list(value_problems(config)) == []) == is_valid(config)


@settings(max_examples=150)
@given(study=st.fixed_dictionaries({}, optional={"runs": FORMS, "defaults": FORMS, "role": FORMS}))
def test_schema_allows_the_same_forms_of_studies(study):
    config = {"studies": {"s": study}}
    assert (list(value_problems(config)) == []) == is_valid(config)
