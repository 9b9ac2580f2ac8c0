"""A study is expanded into runs only when one of them is asked for."""

import pytest
from configurations import PAPER, messages, papers

from nucleation.model.quantities import ParameterError
from replication.configuration import load as module
from replication.configuration.load import configure

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
