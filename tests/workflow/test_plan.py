"""What the workflow would run, and what stops it before it runs anything."""

import dataclasses
import re
import subprocess
import sys
from pathlib import Path

import pytest

from replication import figures
from replication.configuration.load import load, read_yaml

ROOT = Path(__file__).parents[2]

DRAWN = ("figure_1", "figure_2", "figure_3", "figure_s1", "figure_s2")
CLAIMING = ("dispersion", "claims", "write_article")


@pytest.fixture
def paper(workflow):
    return dataclasses.replace(workflow, config=ROOT / "config" / "config.yaml")


def test_default_target_is_the_whole_paper(paper):
    config = load(paper.config)
    studies = ("paper", "converged", "long_blocks")
    batches = {run.batch for study in studies for run in config.runs_of(study)}
    assert len(batches) == 7
    once = ("theory", "lengths", "table_s1", *DRAWN, *CLAIMING)
    assert paper.planned() == {
        "extract": 2,
        "follow_patches": 1,
        "simulate": len(batches),
        **dict.fromkeys(once, 1),
    }


@pytest.mark.parametrize(
    ("target", "expected"),
    [
        ("figure_1 table_s1", {"figure_1": 1, "table_s1": 1}),
        ("simulations", {"simulate": 6}),
        ("figure_3", {"theory": 1, "simulate": 6, "extract": 2, "lengths": 1, "figure_3": 1}),
        ("figure_s2", {"simulate": 5, "extract": 1, "figure_s2": 1}),
        (
            "claims",
            {
                "theory": 1,
                "dispersion": 1,
                "simulate": 6,
                "extract": 2,
                "follow_patches": 1,
                "claims": 1,
            },
        ),
        ("figure_study_drop", {"simulate_and_measure": 2, "join_batches": 1, "draw_study": 1}),
    ],
)
def test_targets(workflow, target, expected):
    assert workflow.planned(*target.split()) == expected


QUICK = read_yaml(ROOT / "config" / "quick.yaml")


@pytest.mark.parametrize(
    ("config", "fragments"),
    [
        ({**QUICK, "material": {"poisson_ratio": 0.5}}, ["poisson_ratio = 0.5", "(-1, 0.5)"]),
        (
            {"studies": {"s": {"runs": [{"height": -1, "evolution": "agin", "n_x": 0}]}}},
            ["height = -1 m", "evolution = 'agin'", "n_x = 0", "has 3 problems"],
        ),
        ("", ["must be given as JSON or YAML with keys at top level"]),
    ],
)
def test_bad_configuration_stops_before_any_job(workflow, config, fragments):
    done = workflow.configured(config)()
    assert done.returncode != 0
    for fragment in fragments:
        assert fragment in done.stdout
    assert "Traceback" not in done.stdout
    assert not (workflow.directory / "results").exists()


@pytest.mark.parametrize(
    ("arguments", "fragment"),
    [
        (["figure_4"], "No rule to produce figure_4"),
        (["table_s1", "--config", "results="], "results = None is not allowed"),
        (["--config", "resluts=other"], "resluts = 'other' is not allowed: unknown key; did you"),
    ],
)
def test_bad_command_line_stops_before_any_job(workflow, arguments, fragment):
    done = workflow(*arguments)
    assert done.returncode != 0
    assert fragment in done.stdout
    assert "Traceback (most recent call last)" not in done.stdout
    assert not (workflow.directory / "results").exists()


@pytest.mark.parametrize("name", ["store", "logs"])
def test_a_file_in_the_place_of_a_directory_stops_before_any_job(workflow, name):
    place = workflow.directory / "results" / "quick" / name
    place.parent.mkdir(parents=True)
    place.write_text("my own\n")
    done = workflow("table_s1")
    assert done.returncode != 0 and f"{place} is no directory" in done.stdout
    assert "Traceback" not in done.stdout and place.read_text() == "my own\n"


def test_a_snakemake_without_the_libraries_says_how_to_get_them(workflow):
    hidden = (
        "import importlib.util as util, sys; found = util.find_spec;"
        "util.find_spec = lambda name, *more: None if name == 'numpy' else found(name, *more);"
        "from snakemake.cli import main; main(sys.argv[1:])"
    )
    command = [sys.executable, "-c", hidden, *workflow.arguments("table_s1")]
    done = subprocess.run(command, cwd=workflow.directory, capture_output=True, text=True)
    lines = [line for line in done.stderr.splitlines() if "numpy" in line]
    assert done.returncode != 0 and len(lines) == 1 and "make install" in lines[0]
    assert "Traceback" not in done.stderr


def test_coarse_meshes_are_one_line_and_a_list(workflow):
    assert "Warning" not in workflow("table_s1", "--dry-run").stdout, "it needs no study"
    printed = workflow.printed("studies", "--dry-run")
    (warning,) = re.findall("Warning: .*", printed)
    number, place = re.search(r"(\d+) runs have .*; (\S+) lists them", warning).groups()
    assert "with 1.8 elements per process zone at worst (" in warning
    texts = (workflow.directory / place).read_text().splitlines()
    (text,) = (text for text in texts if text.startswith("studies.paper: "))
    assert "2.3 to a process zone of 0.0526 m; recommended is n_x = 103 or more" in text
    ids = {run for text in texts for run in re.findall(r"[a-z]\w+-(?:aging|slip)-[^ ,):\]]+", text)}
    assert len(ids) == int(number) > 20


@pytest.mark.parametrize(
    ("target", "table", "missing"),
    [
        ("lengths", "own", "no study with table: lengths, which this target needs"),
        ("figure_drop", "own", "no study with role: drop, which this target needs"),
        ("figure_3", "lengths", "no study with role: paper has a run with evolution = aging"),
    ],
)
def test_target_without_its_studies_says_which(workflow, target, table, missing):
    study = {"table": table, "runs": [{"height": 0.1}]}
    done = workflow.configured({"studies": {"mine": study}})(target, "--dry-run")
    assert done.returncode != 0
    assert missing in done.stdout
    assert "Traceback (most recent call last)" not in done.stdout


def test_failed_simulation_is_no_result_and_keeps_its_record(workflow):
    """A run whose steps may not get short has to fail, by name; former lengths don't stay."""
    run = {"height": 0.01, "n_x": 16, "n_y": 4}
    values = {"stepping": {"end_time": 0.1}, "studies": {"fails": {"runs": [run]}}}
    assert workflow.configured(values)("lengths").returncode == 0
    run["shortest_step"] = 9.0e-8
    done = workflow.configured(values)("lengths")
    assert done.returncode != 0
    (record,) = (workflow.directory / "results" / "unfinished").iterdir()
    name = "fails-aging-H0.01-phi1-n_x16-n_y4-shortest_step9e-8"
    assert record.name.startswith(f"{name}.") and record.name.endswith(".failed.nc")
    assert "failed: the step size fell below the shortest step allowed" in done.stdout
    assert "Error in rule simulate:" in done.stdout and f"batches/{name}.json" in done.stdout
    assert not (workflow.directory / "results" / "lengths.nc").exists()


def test_configuration_of_ones_own_needs_no_target(workflow):
    """By default it makes its lengths and figures; the paper's are not among them."""
    defaults = {"n_x": 20, "n_y": 4, "end_time": 0.2}
    studies = {
        "mine": {"defaults": defaults, "runs": [{"height": [0.01, 0.02]}]},
        "alone": {"defaults": defaults, "table": "own", "runs": [{"height": 0.01}]},
    }
    planned = workflow.configured({"studies": studies}).planned()
    once = {"extract": 2, "lengths": 1, "draw_study": 2}
    assert planned == {"simulate": 3, **once}


def test_every_rule_has_a_text_and_every_figure_is_a_target(workflow):
    listed = workflow("--list-rules").stdout
    texts = dict(re.findall(r"^(\w+) \((.+)\)$", listed, re.M))
    drawn = {name for name in texts if name.startswith("figure_")}
    of_studies = {name for name in drawn if name.startswith("figure_study_")}
    assert drawn - of_studies == {*figures.ROLES, "figure_studies"}
    assert {"figure_study_paper", "figure_study_converged"} <= of_studies
    assert {"paper", "lengths", "figures", "simulate", "figure_3"} <= texts.keys()
    rules = "".join(path.read_text() for path in ROOT.glob("workflow/rules/*.smk"))
    rules += (ROOT / "Snakefile").read_text()
    assert set(re.findall(r"^rule (\w+):$", rules, re.M)) == texts.keys() - of_studies
    local = set(
        re.findall(r"^rule (\w+):\n(?:[^\n]*\n(?!rule ))*    localrule: True$", rules, re.M)
    )
    assert "figure_1" in local, "what takes seconds is a job on a cluster"
    assert not local & {"simulate", "extract", "follow_patches", "theory", "dispersion", "claims"}


def test_article_of_the_replication_has_the_figures_beyond(workflow):
    planned = workflow.planned("replication")
    made = {"write_article", "figure_3", "figure_drop", "figure_map"}
    assert planned["write_replication"] == 1 and made <= planned.keys()
