"""What the workflow would run, and what stops it before it runs anything."""

import dataclasses
from collections import Counter
from pathlib import Path

import pytest

from nucleation.configuration import load, read_yaml

ROOT = Path(__file__).parents[2]

DRAWN = ("draw_figure_1", "draw_figure_2", "draw_figure_3", "draw_figure_s1", "draw_figure_s2")


@pytest.fixture
def paper(workflow):
    return dataclasses.replace(workflow, config=ROOT / "config" / "config.yaml")


def test_default_target_is_the_whole_paper(paper):
    config = load(paper.config)
    runs = len(config.runs_of("paper")) + len(config.runs_of("converged"))
    once = ("theory", "gather_lengths", "write_table_s1", "paper", *DRAWN)
    assert paper.planned() == {"simulate": runs, "extract": 2, **dict.fromkeys(once, 1)}


@pytest.mark.parametrize(
    ("target", "expected"),
    [
        ("theory", {"theory": 1}),
        ("figure_1 table_s1", {"draw_figure_1": 1, "write_table_s1": 1}),
        ("figure_2 figure_s1", {"theory": 1, "draw_figure_2": 1, "draw_figure_s1": 1}),
        ("simulations", {"simulate": 6}),
        ("lengths", {"simulate": 6, "extract": 2, "gather_lengths": 1}),
        (
            "figure_3",
            {"theory": 1, "simulate": 6, "extract": 2, "gather_lengths": 1, "draw_figure_3": 1},
        ),
        ("figure_s2", {"simulate": 5, "extract": 1, "draw_figure_s2": 1}),
    ],
)
def test_targets(workflow, target, expected):
    names = target.split()
    assert workflow.planned(*names) == dict(Counter(expected) | Counter(names))


QUICK = read_yaml(ROOT / "config" / "quick.yaml")


@pytest.mark.parametrize(
    ("config", "fragments"),
    [
        ({**QUICK, "material": {"poisson_ratio": 0.5}}, ["poisson_ratio = 0.5", "(-1, 0.5)"]),
        (
            {"studies": {"s": {"runs": [{"height": -1, "law": "agin", "n_x": 0}]}}},
            ["height = -1 m", "law = 'agin'", "n_x = 0", "has 3 problems"],
        ),
        ("results: a\nresults: b\n", ["the key results stands twice, in lines 1 and 2"]),
        ("stepping: {tolerance: 1e-2}\n", ["tolerance = '1e-2'", "write 1.0e-2"]),
    ],
)
def test_bad_configuration_stops_before_any_job(workflow, config, fragments):
    done = workflow.configured(config)()
    assert done.returncode != 0
    for fragment in fragments:
        assert fragment in done.stdout
    assert "Traceback" not in done.stdout
    assert not (workflow.directory / "results").exists()


def test_bad_value_on_the_command_line_stops_before_any_job(workflow):
    done = workflow("--config", "resluts=other")
    assert done.returncode != 0
    assert "resluts = 'other' is not allowed: unknown key; did you mean results?" in done.stdout
    assert not (workflow.directory / "results").exists()


def test_figure_without_its_simulation_says_which(workflow):
    other = workflow.configured({"studies": {"mine": {"runs": [{"height": 0.1}]}}})
    done = other("figure_3", "--dry-run")
    assert done.returncode != 0
    assert "no run of the configuration has study paper, law aging, height 0.1" in done.stdout
    assert "Traceback (most recent call last)" not in done.stdout


def test_own_study_needs_no_study_of_the_paper(workflow):
    other = workflow.configured({"studies": {"mine": {"runs": [{"height": [0.1, 0.2]}]}}})
    assert other.planned("lengths") == {
        "simulate": 2, "extract": 1, "gather_lengths": 1, "lengths": 1,
    }  # fmt: skip


def test_failed_simulation_is_no_result_and_keeps_its_record(workflow):
    """A run whose steps may not get short has to fail, at once and by name."""
    run = {"height": 0.01, "n_x": 16, "n_y": 4, "shortest_step": 0.5}
    done = workflow.configured({"studies": {"fails": {"runs": [run]}}})("lengths")
    assert done.returncode != 0
    (record,) = (workflow.directory / "results" / "simulations").iterdir()
    assert record.name == "fails-aging-H0.01-phi1-n_x16-n_y4-shortest_step0.5.failed.nc"
    assert "failed: the step size fell below the shortest step allowed" in done.stdout
    assert not (workflow.directory / "results" / "lengths.nc").exists()
