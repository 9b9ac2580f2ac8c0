"""What studies are for: roles with their requirements, and names that say nothing."""

import copy

import pytest
from configurations import CONFIG, PAPER, assert_one_problem, study

from replication import figures
from replication.configuration.load import configure, load
from replication.configuration.roles import PAIRS, REFINEMENTS, ROLES

TALL = {"height": 0.1}


def two(role):
    own = {"role": role, "runs": [TALL]}
    return {"studies": {"one": own, "other": {**own, "runs": [TALL | {"initial_state": 2.0}]}}}


BAD = {
    "unknown": (study(TALL, role="maps"), ["studies.s.role = 'maps'", "one of own, paper"]),
    "lengths, one by one": (
        study(TALL, role="map", runs_per_job=2),
        ["studies.s.measure = lengths is not allowed with role = map: it must be stability"]
    ),
    "a table of its own": (
        study(TALL, role="converged", table="own"),
        ["studies.s.table = own is not allowed with role = converged: it must be lengths"]
    ),
    "less than the interface": (
        study(TALL | {"record": "lengths"}, role="converged"),
        ["studies.s: s-aging-H0.1-phi1-recordlengths: record = lengths is", "must be interface"]
    ),
    "perturbed": (
        study(TALL, TALL | {"perturbation": "state", "strength": 1e-3}, role="convergence_quiet"),
        ["perturbation = state is not allowed with role = convergence_quiet: it must be none"]
    ),
    "one body": (
        study(TALL, role="pairs"),
        ["second_body = rigid is not allowed with role = pairs: it must be deformable"]
    ),
    "two maps": (
        {"studies": {name: {"role": "map", "runs_per_job": 2, "measure": "stability",
                            "runs": [TALL]} for name in ("one", "other")}},
        ["studies.other.role = map is not allowed: studies.one has it"],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("config", "fragments"), BAD.values(), ids=BAD.keys())
def test_what_a_role_needs_is_asked_for(config, fragments):
    assert_one_problem(config, fragments)


@pytest.mark.parametrize("role", [name for name, role in ROLES.items() if role.several])
def test_roles_that_several_studies_may_share(role):
    entry = {"height": 0.005} | ({"second_body": "deformable"} if role in PAIRS else {})
    own = {"role": role, "runs": [entry]}
    if ROLES[role].study:  # of those that share, patch_theory alone asks for something
        own |= {"measure": "stability", "runs_per_job": 2}
    settings = configure({"studies": {"one": own, "other": copy.deepcopy(own)}})
    assert settings.studies_for(role) == ["one", "other"]
    assert [run.study for run in settings.runs_for(role)] == ["one", "other"]
    assert {run.to_dict()["role"] for run in settings.runs} == {role}


def test_names_can_be_any():
    """The paper's configuration with its studies called by letters: the same roles and runs."""
    renamed = copy.deepcopy(PAPER)
    names = dict(zip(renamed["studies"], map("s{:02d}".format, range(99)), strict=False))
    renamed["studies"] = {names[name]: own for name, own in renamed["studies"].items()}
    before, after = configure(PAPER), configure(renamed)
    for role in ROLES:
        assert after.studies_for(role) == [names[name] for name in before.studies_for(role)]
    assert [run.run for run in after.runs] == [run.run for run in before.runs]
    assert after.shown(0.1).study == names["paper"]


def test_figures_stand_on_roles_that_there_are():
    asked = {role for roles in figures.ROLES.values() for role in roles}
    assert asked | {*PAIRS, *REFINEMENTS} <= set(ROLES)
    found = {own.role for own in load(CONFIG / "quick.yaml").studies.values()}
    assert figures.drawable(found) == list(figures.ROLES)
