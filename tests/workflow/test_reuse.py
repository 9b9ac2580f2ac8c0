"""Results are used exactly when parameters, code and content vouch for them, however they came."""

import dataclasses
import shutil

import pytest

from nucleation.fault.files import read_yaml

SIMULATIONS = 6  # of the quick configuration


@pytest.fixture
def plain(checkout, tmp_path_factory):
    """A checkout to edit, over a plain copy of the results without Snakemake's notes."""
    directory = tmp_path_factory.mktemp("plain")
    results = checkout.directory / "results"
    shutil.copytree(results, directory / "results", copy_function=shutil.copyfile)
    return dataclasses.replace(checkout, directory=directory)


def edit(workflow, path, old, new):
    file = workflow.checkout / path
    text = file.read_text()
    assert text.count(old) >= 1, path
    file.write_text(text.replace(old, new))


def test_without_notes_changed_parameters_and_code_are_seen(plain):
    assert plain.planned() == {}
    values = read_yaml(plain.config)
    values["friction"] = {"aging_coefficient": 0.085}
    assert plain.configured(values, "yaml").planned("lengths")["simulate"] == SIMULATIONS
    edit(plain, "src/nucleation/simulation/run.py", "SAFETY = 0.85", "SAFETY = 0.86")
    planned = plain.planned()
    assert planned["simulate"] == SIMULATIONS and planned["extract"] == 2
    edit(plain, "src/nucleation/simulation/run.py", "SAFETY = 0.86", "SAFETY = 0.85")
    assert plain.planned() == {}, "back to the first code, its results are used again"


@pytest.mark.parametrize("place", ["./results//quick/", "{}/results/quick"])
def test_the_same_place_by_another_name(plain, place):
    values = {**read_yaml(plain.config), "results": place.format(plain.directory)}
    assert plain.configured(values, "place.yaml").planned() == {}


def test_renamed_study_runs_no_simulation_again(plain):
    values = read_yaml(plain.config)
    values["studies"] = {
        {"converged": "fine"}.get(name, name): study for name, study in values["studies"].items()
    }
    planned = plain.configured(values, "renamed.yaml").planned("lengths")
    assert "simulate" not in planned and planned["extract"] == 1


def test_new_law_makes_nothing_stale(plain):
    laws = plain.checkout / "src/nucleation/model/friction/evolutions"
    shutil.copy(laws / "aging.py", laws / "another.py")
    assert plain.planned() == {}
    file = laws / "slip.py"
    file.write_text(file.read_text() + "\nSPARE = 1\n")
    assert plain.planned("simulations")["simulate"] == 1, "the one run of the slip law"


def test_code_edited_after_planning_is_refused(plain):
    """The edit is made by the first job itself, between planning and the figure."""
    edit(
        plain,
        "src/replication/pipeline/job.py",
        "    began = time.monotonic()\n",
        "    began = time.monotonic()\n"
        "    _f = Path(__file__).parents[1] / 'figures' / 'figure_1.py'\n"
        "    _f.write_text(_f.read_text().removesuffix('X = 1') + 'X = 1')\n",
    )
    mine = plain.configured({**read_yaml(plain.config), "results": "new"}, "edited.yaml")
    done = mine("table_s1", "figure_1", "--cores", "1", "--prioritize", "table_s1")
    assert done.returncode != 0
    assert "have changed since this job was planned" in done.stdout
    assert not list((plain.directory / "new" / "figures").glob("figure_1.*"))
    mine.printed("figure_1")
