"""The JSON schema and the library's own checks allow the same values of every parameter."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nucleation.configuration import refusals, schema
from nucleation.configuration.study_names import study_parameters

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


@pytest.mark.parametrize("key", DECLARED)
@settings(max_examples=15)
@given(data=st.data())
def test_schema_allows_what_the_library_allows(key, data):
    node, entry = DECLARED[key]
    value = data.draw(values(entry))
    allowed = entry.allows((value,) if entry.many else value)
    allowed &= value not in (math.inf, -math.inf)  # YAML has it, and no parameter takes it there
    valid = refusals._Validator({"$defs": SCHEMA["$defs"], **node}).is_valid(value)
    assert valid == allowed
