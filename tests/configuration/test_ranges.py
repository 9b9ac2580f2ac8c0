"""Random values, forms and faults: what the declarations allow, and nothing else."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_random_faults import NUMBER, random_fault

from nucleation.api import Fault
from nucleation.fault.parameters import parameters
from nucleation.model.quantities import ParameterError
from replication.configuration.checks import Reader
from replication.configuration.load import configure
from replication.configuration.settings import GROUPS, entries_of

DECLARED = {
    f"{group}.{name}": entry for group in GROUPS for name, entry in entries_of(group).items()
} | {f"studies.{name}": entry for name, entry in parameters().items()}


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
def test_a_value_is_allowed_as_its_declaration_says(key, data):
    entry = DECLARED[key]
    value = data.draw(values(entry))
    meant = 1.0 if value == "1.0" and not entry.worded else value  # YAML reads 1e-8 as text
    allowed = entry.allows((meant,) if entry.many and meant is not None else meant)
    allowed &= value not in (math.inf, -math.inf)  # YAML has it, and no parameter takes it there
    group, name = key.split(".")
    if group == "studies":
        config = {"studies": {"s": {"runs": [{"height": 1.0}], "defaults": {name: value}}}}
    else:
        config = {group: {name: value}, "studies": {"s": {"runs": [{"height": 1.0}]}}}
    reader = Reader()
    reader.configuration(config)
    assert (reader.problems == []) == allowed


FORMS = st.recursive(
    st.none() | st.booleans() | st.sampled_from((1, 2, 0.5, -1.0, "aging", "x", "", "log")),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(("start", "stop", "num", "scale", "height")), inner)
    ),
    max_leaves=6,
)


def refused_or_made(config):
    """A configuration of any form is made, or refused with the place of each problem."""
    try:
        configure(config, lazy=True)
    except ParameterError as error:
        assert str(error).startswith("the configuration has ") or "lacks the key" in str(error)


@pytest.mark.parametrize("key", ["height", "evolution", "n_x", "initial_state", "defaults"])
@settings(max_examples=15)
@given(value=FORMS)
def test_forms_of_what_a_run_gives(key, value):
    refused_or_made({"studies": {"s": {"runs": [{"density": 1.0, key: value}]}}})


@pytest.mark.parametrize("key", ["results", "curves", "studies", "friction"])
@settings(max_examples=15)
@given(value=FORMS)
def test_forms_of_sections(key, value):
    refused_or_made({"studies": {"s": {"runs": [{"height": 1.0}]}}, key: value})
    refused_or_made({"studies": {"s": {"runs": value, key: value}}})


@pytest.mark.slow
@pytest.mark.parametrize("number", range(NUMBER))
def test_a_study_has_the_lengths_of_its_fault(number):
    """L_s is located within 1e-3; a study refuses, with a reason, what no simulation can have."""
    known, _ = random_fault(number)
    fault = Fault(**known)
    if math.isinf(fault.height) or math.isnan(fault.critical_length()):
        return
    values = {key: value for key, value in fault.to_dict().items() if "far_side" not in key}
    values["second_body"] = "deformable"
    if math.isinf(fault.second_shear_modulus):
        del values["second_shear_modulus"]
        values["second_body"] = "rigid"
    values["friction_law"] = "dieterich_ruina"
    values["regularisation_slip_rate"] = 1e-6 * fault.velocity
    values["end_time"] = 1.0  # else it follows from L, in a second
    study = {"fault": "paper", "defaults": values, "runs": [{"seed": 1}]}
    try:
        (run,) = configure({"studies": {"own": study}}).runs_of("own")
    except ParameterError as error:
        assert "is not allowed" in str(error) or "no friction law has" in str(error)
        return
    own = run.run.fault
    of_law = ("friction", "a", "zeta", "slip_distance")
    rest = {key: value for key, value in known.items() if key not in of_law}
    by_law = Fault(**rest, friction_law=own.friction_law)
    assert own.critical_length() == pytest.approx(fault.critical_length(), rel=1e-9)
    stable = by_law.stability_length()
    assert own.stability_length() == pytest.approx(stable, rel=1e-3, nan_ok=True)
