"""The default configuration and the examples; roles, and when a study is expanded."""

import copy

import pytest
from configurations import CONFIG, PAPER, messages, papers

from nucleation.extraction.extraction import extract
from nucleation.fault.files import read_yaml
from nucleation.model.quantities import ParameterError
from nucleation.simulation.run import simulate
from replication import figures
from replication.configuration import load as module
from replication.configuration.advice import warned
from replication.configuration.load import configure, load
from replication.configuration.roles import JUDGED, LONGER, PAIRS, PAPERS, REFINEMENTS, ROLES


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
    loaded = (load(CONFIG / name) for name in ("quick.yaml", "blind.yaml"))
    found = {own.role for settings in loaded for own in settings.studies.values()}
    assert figures.drawable(found) == list(figures.ROLES)


GOOD = {"length_over_critical": 4.0, "runs": [{"height": [0.01, 0.02]}]}
BAD = {"runs": [{"height": 0.01, "initial_shear_stress": 5e4}]}  # without its start


@pytest.fixture
def expanded(monkeypatch):
    """The names of the studies that are expanded, as they are."""
    names = []
    original = module.study_runs

    def noted(name, *others):
        names.append(name)
        return original(name, *others)

    monkeypatch.setattr(module, "study_runs", noted)
    return names


def test_the_lazy_configuration_is_the_whole_one():
    lazy = configure(PAPER, lazy=True)
    whole = configure(PAPER)
    assert lazy == whole
    assert lazy.runs == whole.runs
    for run in whole.runs:
        assert lazy.run(run.id) == run
    for name in {run.batch for run in whole.runs} - {""}:
        assert lazy.batch(name) == [run for run in whole.runs if run.batch == name]


def test_a_study_is_expanded_once_and_only_if_asked_for(expanded):
    settings = configure(PAPER, lazy=True)
    assert settings.studies_for("drop") == ["drop"]
    assert expanded == []
    (run,) = [run for run in settings.runs_for("long_blocks") if run.labels["height"] == 0.1]
    assert settings.run(run.id) is run
    assert run in settings.batch(run.batch)
    assert run in settings.runs_of("long_blocks")
    assert expanded == ["long_blocks"]
    assert settings.runs_of("no such study") == []


def test_without_lazy_everything_is_checked():
    config = {"studies": {"good": GOOD, "bad": BAD}}
    assert "studies.bad.runs[0]: initial_shear_stress = 50000 Pa is not allowed" in messages(config)
    settings = configure(config, lazy=True)
    assert len(settings.runs_of("good")) == 2
    for ask in ("runs_of bad", "runs_for own", "run bad-aging-H0.01-phi1", "batch bad-0"):
        method, name = ask.split()
        with pytest.raises(ParameterError, match="initial_shear_stress = 50000 Pa is not allowed"):
            getattr(settings, method)(name)
    with pytest.raises(ParameterError, match="initial_shear_stress = 50000 Pa is not allowed"):
        _ = settings.runs


DECLARED = {
    "a range": ({"runs": [{"height": {"start": 2.0, "stop": 1.0, "num": 3}}]}, "less than stop"),
    "a role's key": ({**GOOD, "role": "paper", "table": "own"}, "it must be lengths"),
}


@pytest.mark.parametrize(("section", "said"), DECLARED.values(), ids=DECLARED)
def test_what_needs_no_expansion_is_refused_at_once(section, said, expanded):
    with pytest.raises(ParameterError, match=said):
        configure({"studies": {"s": section}}, lazy=True)
    assert expanded == []


@pytest.mark.parametrize(
    ("name", "fragments"),
    [
        ("paper-aging-H0.05-phi2", ["no run paper-aging-H0.05-phi2", "paper-aging-H0.05-phi1"]),
        ("papers-aging-H0.05-phi1", ["no run papers-aging-H0.05-phi1; studies: paper, converged"]),
    ],
)
def test_an_unknown_run_or_batch_is_told_with_those_like_it(name, fragments):
    with pytest.raises(ParameterError) as caught:
        papers().run(name)
    for fragment in fragments:
        assert fragment in str(caught.value)
    with pytest.raises(ParameterError, match="no batch paper-7; the study paper has paper-"):
        papers().batch("paper-7")
    with pytest.raises(ParameterError, match="no batch good-0; the study good has none"):
        configure({"studies": {"good": GOOD}}).batch("good-0")
