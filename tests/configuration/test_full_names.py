"""Parameters of studies by full and short names, and the friction laws' own ones."""

import pytest
from configurations import assert_one_problem, study, with_run

from nucleation.model.friction.constants import constants
from nucleation.theory.estimates import growth_time
from replication.configuration.load import configure

RUN = "studies.paper.runs[6]"
SHORT = {"height": 0.1, "evolution": ["aging", "slip"], "n_x": 800, "initial_state": 10.0}
FULL = {
    "geometry.height": 0.1, "friction.evolution": ["aging", "slip"], "mesh.n_x": 800,
    "loading.initial_state": 10.0,
}  # fmt: skip


def runs_of(*entries, **settings):
    return configure(study(*entries, **settings)).runs


def test_full_names_give_the_same_runs():
    assert runs_of(SHORT) == runs_of(FULL)
    assert [run.id for run in runs_of(FULL)] == [
        "s-aging-H0.1-phi10-n_x800", "s-slip-H0.1-phi10-n_x800",
    ]  # fmt: skip
    assert [run.given for run in runs_of(SHORT)] == [run.given for run in runs_of(FULL)]


def test_names_in_defaults_and_runs_may_differ():
    (run,) = runs_of({"height": 0.1}, defaults={"geometry.height": 0.2, "mesh.n_x": 90})
    assert (run.parameters.geometry.height, run.parameters.mesh.n_x) == (0.1, 90)


def test_end_of_a_run_that_is_given_none_follows_from_the_theory():
    """Not the paper's: late enough for an event, and soon after it."""
    config = study({"height": [0.1, 5.0]})
    low, high = configure(config).runs
    for run in (low, high):
        due = growth_time(run.parameters, run.critical_length)
        assert run.parameters.stepping.end_time == pytest.approx(1.5 * due, rel=0.05)
        assert run.parameters.stepping.time_after_event == pytest.approx(0.5)
    assert high.parameters.stepping.end_time != low.parameters.stepping.end_time
    section = {**config, "stepping": {"end_time": 16.0}}
    for given in (section, study({"height": 0.1, "end_time": 16.0})):
        assert configure(given).runs[0].parameters.stepping.end_time == 16.0
        assert configure(given).runs[0].parameters.stepping.time_after_event > 1.0


BAD = {
    "range by a full name": (
        with_run(**{"geometry.height": [0.2, -1.0]}),
        [f"{RUN}.geometry.height[1] = -1.0 m is not allowed: block height must lie in (0, 1e"],
    ),
    "given twice": (
        study({"height": 0.1, "geometry.height": 0.2}),
        ["studies.s.runs[0]: geometry.height = 0.2 is not allowed: height is given already"],
    ),
    "wrong group": (
        with_run(**{"mesh.height": 0.1}),
        [f"{RUN}.mesh.height = 0.1 is not allowed: unknown key; did you mean"],
    ),
    "unknown": (with_run(zzz=0.1), [f"{RUN}.zzz = 0.1", "known keys: shear_modulus, poisson_r"]),
    "a law of friction as evolution": (
        with_run(height=0.1, law="aging"),
        [f"{RUN}.law = 'aging'", "one of dieterich_ruina, product", "called evolution"],
    ),
    "another law's parameter in the section": (
        {**study({"height": 0.1}), "friction": {"law": "dieterich_ruina", "state_scale": 1.0}},
        ["friction.state_scale = 1.0 is not allowed: the friction law dieterich_ruina has no such",
         "log_rate_coefficient"],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("config", "fragments"), BAD.values(), ids=BAD.keys())
def test_bad_names_and_laws_are_named(config, fragments):
    assert_one_problem(config, fragments)


def test_a_second_body_is_named():
    """By its full name or with ``second_``; what has neither is the first body's."""
    short = {"second_body": "deformable", "second_height": [0.1, 0.2], "height": 0.3}
    full = {"second_body.kind": "deformable", "second_body.height": [0.1, 0.2], "height": 0.3}
    assert runs_of(short) == runs_of(full)
    one, other = runs_of(short)
    assert one.parameters.below.geometry.height == 0.1
    assert other.parameters.geometry.height == 0.3
    assert one.id == "s-aging-H0.3-phi1-second_bodydeformable-second_height0.1"


def test_laws_are_compared_by_one_study():
    """Both laws with the same constants: the theory's length is one, the laws are two."""
    constant = {"friction": 0.5, "a": 0.01, "zeta_over_a": 1.0}
    runs = runs_of(
        {"height": 0.1, "friction.law": ["product", "dieterich_ruina"]}, defaults=constant
    )
    assert [run.id for run in runs] == [
        "s-aging-H0.1-phi1-friction_lawproduct", "s-aging-H0.1-phi1-friction_lawdieterich_ruina",
    ]  # fmt: skip
    for run in runs:
        found = constants(run.parameters.friction, 1e-5)
        assert found == pytest.approx(constant | {"zeta": 0.01, "b": 0.02})
    assert runs[0].critical_length == pytest.approx(runs[1].critical_length, rel=1e-9)
    assert runs[1].value("friction_law") == "dieterich_ruina"
    assert runs[1].value("aging_coefficient") is None
