"""What a configuration leaves out has the value of the default one, its studies too."""

from configurations import CONFIG, papers

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
