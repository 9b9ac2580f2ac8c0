"""What studies are for: roles that several may share, and names that can be any."""

import copy

import pytest
from configurations import CONFIG

from nucleation.fault.files import read_yaml
from replication import figures
from replication.configuration.load import configure, load
from replication.configuration.roles import PAIRS, REFINEMENTS, ROLES


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
    """The quick configuration with its studies called by letters: the same roles and runs."""
    quick = read_yaml(CONFIG / "quick.yaml")
    renamed = copy.deepcopy(quick)
    names = dict(zip(renamed["studies"], map("s{:02d}".format, range(99)), strict=False))
    renamed["studies"] = {names[name]: own for name, own in renamed["studies"].items()}
    before, after = configure(quick), configure(renamed)
    for role in ROLES:
        assert after.studies_for(role) == [names[name] for name in before.studies_for(role)]
    assert [run.run for run in after.runs] == [run.run for run in before.runs]
    assert after.shown(0.1).study == names["paper"]


def test_figures_stand_on_roles_that_there_are():
    asked = {role for roles in figures.ROLES.values() for role in roles}
    assert asked | {*PAIRS, *REFINEMENTS} <= set(ROLES)
    found = {own.role for own in load(CONFIG / "quick.yaml").studies.values()}
    assert figures.drawable(found) == list(figures.ROLES)
