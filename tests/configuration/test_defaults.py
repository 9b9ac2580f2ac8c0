"""The default configuration, which stands in for what others leave out, and the examples."""

import pytest
from configurations import CONFIG, papers

from nucleation.extraction.extraction import extract
from nucleation.simulation.run import simulate
from replication.configuration.advice import warned
from replication.configuration.load import configure, load
from replication.configuration.roles import JUDGED, LONGER, PAPERS


def test_the_default_configuration_is_both_files():
    paper, whole = load(CONFIG / "config.yaml"), papers()
    assert whole == load(CONFIG / "config.yaml", CONFIG / "beyond.yaml")
    assert list(whole.studies)[:3] == list(paper.studies) == ["paper", "converged", "long_blocks"]
    assert [study.role for study in paper.studies.values()] == [PAPERS, JUDGED, LONGER]
    assert paper.runs == whole.runs[: len(paper.runs)]
    assert len(whole.studies) > 15


def test_studies_that_are_left_out_are_the_papers(tmp_path):
    (tmp_path / "mine.yaml").write_text("results: mine\nstepping: {tolerance: 5.0e-3}\n")
    mine = load(tmp_path / "mine.yaml", lazy=True)
    assert mine == configure({"results": "mine", "stepping": {"tolerance": 5e-3}}, lazy=True)
    assert mine.results == "mine"
    assert mine.studies == papers().studies
    for given, usual in zip(mine.runs_of("paper"), papers().runs_of("paper"), strict=True):
        assert given.id == usual.id
        assert given.run == usual.run.replaced(tolerance=5e-3)


def test_studies_that_are_given_stand_alone(tmp_path):
    (tmp_path / "mine.yaml").write_text("studies: {mine: {runs: [{height: 0.01}]}}\n")
    mine = load(tmp_path / "mine.yaml")
    assert list(mine.studies) == ["mine"]
    assert mine.base.fault == papers().base.fault


def test_later_files_are_stronger(tmp_path):
    (tmp_path / "one.yaml").write_text("results: one\nstepping: {end_time: 40.0}\n")
    (tmp_path / "two.yaml").write_text(
        "stepping: {tolerance: 5.0e-3}\nstudies: {mine: {runs: [{height: 0.01}]}}\nresults: two\n"
    )
    both = load(tmp_path / "one.yaml", tmp_path / "two.yaml")
    assert (both.results, list(both.studies)) == ("two", ["mine"])
    assert (both.base.stepping.end_time, both.base.stepping.tolerance) == (40.0, 5e-3)


EXAMPLES = sorted((CONFIG / "examples").glob("*.yaml"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_is_valid_and_needs_no_warning(path):
    config = load(path)
    assert config.results == f"results/{path.stem}"
    assert warned(config.runs) == []
    assert f"config/examples/{path.name}" in path.read_text(), "how to run it"


@pytest.mark.slow
def test_rock_nucleates_under_a_load_far_from_the_fault():
    """The lowest blocks, on elements twice as large as the example's."""
    config = load(CONFIG / "examples" / "rock.yaml")
    lowest = (x for x in config.runs if "H0.25" in x.id and "loadingremote" in x.id)
    run = next(lowest)
    parameters = run.run.replaced(n_x=121, n_y=8, grading=6.0)
    length = extract(simulate(parameters), config.extraction)["length"]
    assert length == pytest.approx(0.567, rel=0.05)
