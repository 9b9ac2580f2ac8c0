"""Names of parameters in studies, and the friction laws' own ones."""

import pytest
from configurations import assert_one_problem, study, with_run

from nucleation.model.friction.constants import constants_of
from replication.configuration.load import configure

RUN = "studies.paper.runs[6]"


def runs_of(*entries, **settings):
    return configure(study(*entries, **settings)).runs


def test_values_of_a_run_are_stronger_than_defaults():
    (run,) = runs_of({"height": 0.1}, defaults={"height": 0.2, "n_x": 90})
    assert (run.run.fault.height, run.run.block.n_x) == (0.1, 90)
    assert run.id == "s-aging-H0.1-phi1" and run.given == {"height": 0.1, "n_x": 90}


def test_end_of_a_run_that_is_given_none_follows_from_the_theory():
    """Not the paper's: late enough for an event, and soon after it."""
    config = study({"height": [0.1, 5.0]})
    low, high = configure(config).runs
    for run in (low, high):
        due = run.run.growth_time(run.critical_length)
        assert run.run.stepping.end_time == pytest.approx(1.5 * due, rel=0.05)
        assert run.run.stepping.time_after_event == pytest.approx(0.5)
    assert high.run.stepping.end_time != low.run.stepping.end_time
    section = {**config, "stepping": {"end_time": 16.0}}
    for given in (section, study({"height": 0.1, "end_time": 16.0})):
        assert configure(given).runs[0].run.stepping.end_time == 16.0
        assert configure(given).runs[0].run.stepping.time_after_event > 1.0


BAD = {
    "the name of an earlier version": (
        with_run(height=0.1, length=2.0), [f"{RUN}.length = 2.0", "did you mean block_length?"]
    ),
    "a law of friction as evolution": (
        with_run(height=0.1, friction_law="aging"),
        [f"{RUN}.friction_law = 'aging'", "one of dieterich_ruina, product", "called evolution"]
    ),
    "another law's parameter in the section": (
        {**study({"height": 0.1}),
         "friction": {"friction_law": "dieterich_ruina", "state_scale": 1.0}},
        ["state_scale = 1.0 is not allowed: the friction law dieterich_ruina has no such",
         "log_rate_coefficient"],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("config", "fragments"), BAD.values(), ids=BAD.keys())
def test_bad_names_and_laws_are_named(config, fragments):
    assert_one_problem(config, fragments)


def test_a_second_body_is_named():
    runs = runs_of({"second_body": "deformable", "second_height": [0.1, 0.2], "height": 0.3})
    assert [run.run.below.height for run in runs] == [0.1, 0.2]
    assert runs[0].id == "s-aging-H0.3-phi1-second_bodydeformable-second_height0.1"


def test_laws_are_compared_by_one_study():
    """Both laws with the same constants: the theory's length is one, the laws are two."""
    constant = {"friction": 0.5, "a": 0.01, "zeta_over_a": 1.0}
    runs = runs_of(
        {"height": 0.1, "friction_law": ["product", "dieterich_ruina"]}, defaults=constant
    )
    assert [run.id for run in runs] == [
        "s-aging-H0.1-phi1-friction_lawproduct", "s-aging-H0.1-phi1-friction_lawdieterich_ruina",
    ]  # fmt: skip
    for run in runs:
        found = constants_of(run.run.law, 1e-5)
        assert found == pytest.approx(constant | {"zeta": 0.01, "b": 0.02})
    assert runs[0].critical_length == pytest.approx(runs[1].critical_length, rel=1e-9)
    assert runs[1].value("friction_law") == "dieterich_ruina"
    assert runs[1].value("aging_coefficient") is None
