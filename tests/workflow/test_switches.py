"""Snakemake's switches: each means here what it means in any workflow, before a build and after."""

import dataclasses
import re
import shutil
import sqlite3

import pytest

RUN = {"height": [0.05, 0.1], "n_x": 40, "n_y": 4, "tolerance": 0.1, "longest_step": 0.5}
FILES = ("lengths.csv", "lengths.nc", "lengths/s.csv", "figures/study_s.png", "figures/study_s.pdf")
SAME = "made again: the same as in the store, which is kept"
RULES = {"simulate", "extract", "lengths", "draw_study"}


@pytest.fixture(scope="module")
def built(workflow_type, tmp_path_factory):
    """A study of two runs with its lengths and its figure."""
    made = configured(workflow_type(tmp_path_factory.mktemp("switches")), RUN)
    made.printed()
    return made


def configured(made, run):
    study = {"length_over_critical": 2.0, "defaults": {"time_after_event": 0.0}, "runs": [run]}
    return made.configured({"studies": {"s": study}})


@pytest.fixture
def copied(built, tmp_path):
    """A copy of it, to be changed."""
    directory = tmp_path / "copy"
    shutil.copytree(built.directory, directory, symlinks=True)
    return dataclasses.replace(built, directory=directory, config=directory / built.config.name)


@pytest.fixture
def fresh(built, tmp_path):
    """The same before anything is built."""
    return dataclasses.replace(built, directory=tmp_path)


def logs(run):
    """What the jobs have written."""
    paths = sorted((run.directory / "results" / "logs").glob("*/*.log"))
    return "".join(path.read_text() for path in paths)


def node_names(graph):
    """The rules in a graph in the language of dot."""
    return set(re.findall(r'label ?= ?"(\w+)', graph)) & RULES


def test_summary_lists_every_file(built, fresh):
    listed = [built.printed("--summary"), fresh.printed("-D")]
    assert all(f"results/{name}\t" in text for name in FILES for text in listed)
    assert "no update" in listed[0] and "update pending" not in listed[0]


@pytest.mark.parametrize("switch", ["--dag", "--rulegraph", "--filegraph"])
def test_graphs_have_every_rule(built, fresh, switch):
    run = built if switch == "--dag" else fresh
    graph = run.printed(switch)
    found = set(re.findall(r"\w+", graph)) if switch == "--filegraph" else node_names(graph)
    assert found & RULES == RULES


def test_a_forced_rule_computes_again_and_compares(copied):
    before = {path: path.read_bytes() for path in copied.directory.glob("results/simulations/*.nc")}
    copied.printed("lengths", "--forcerun", "simulate")
    assert logs(copied).count(SAME) == 2
    assert all(path.read_bytes() == content for path, content in before.items())


def test_a_forced_file_and_all_of_them_compute_again(copied):
    (file, _) = sorted(copied.directory.glob("results/simulations/*.nc"))
    copied.printed(str(file.relative_to(copied.directory)), "-f")
    assert logs(copied).count(SAME) == 1
    assert copied.planned("lengths", "-F") == {"simulate": 2, "extract": 1, "lengths": 1}
    copied.printed("lengths", "--forceall")
    assert logs(copied).count(SAME) == 4, (
        "the file, then both simulations and the lengths of the study"
    )


def lock(run, *files):
    """A lock as of another run in this directory, which is at work or was killed."""
    locks = run.directory / ".snakemake" / "locks"
    locks.mkdir(exist_ok=True)
    (locks / "0.output.lock").write_text("".join(f"{file}\n" for file in files))


@pytest.mark.parametrize(
    ("locked", "arguments"),
    [
        ("other/lengths.csv", ["lengths", "--forcerun", "lengths"]),
        ("results/figures/mine.png", ["lengths", "--forcerun", "lengths"]),
        ("results/lengths.csv", ["lengths", "--nolock", "--forcerun", "lengths"]),
        (None, ["./results/lengths.csv", "-f"]),
        (None, ["lengths", "--forcerun", "./results/../results/lengths.nc"]),
    ],
)
def test_what_is_forced_is_made_again_whatever_its_path_and_whoever_has_a_lock(
    copied, locked, arguments
):
    if locked:
        lock(copied, locked)
    copied.printed(*arguments)
    (log,) = copied.directory.glob("results/logs/lengths.log")
    assert SAME in log.read_text()


def test_until_and_omit_from_know_the_rules(fresh):
    assert fresh.planned("--until", "simulate") == {"simulate": 2}
    assert fresh.planned("--omit-from", "draw_study").keys() == RULES - {"draw_study"}
    fresh.printed("--until", "simulate")
    results = fresh.directory / "results"
    assert len([*results.glob("simulations/*.nc")]) == 2 and not (results / "lengths.csv").exists()


def test_threads_of_a_rule_can_be_set(fresh):
    """One core is the profile's; a cluster's profile leaves the rule's two."""
    for options, threads in (((), 1), (("--set-threads", "simulate=2"), 2)):
        commands = fresh.printed("lengths", "--dry-run", "-p", *options)
        assert len(re.findall(rf"pipeline\.job \S+ simulate {threads} ", commands)) == 2


def test_a_dry_run_changes_no_visible_file(copied):
    listed = {path: path.lstat().st_mtime_ns for path in copied.directory.glob("results/*/*")}
    assert "Nothing to be done" in copied.printed("--dry-run")
    changed = configured(copied, {**RUN, "tolerance": 0.2})
    assert changed.planned("lengths")["simulate"] == 2
    for path, time in listed.items():
        assert path.lstat().st_mtime_ns == time or {"logs", "store"} & {*path.parts}


def test_a_run_beside_another_one_changes_nothing(copied):
    """It stops before its first job, and so does not take away what the other one shows."""
    lock(copied, "results/lengths.csv")
    changed = configured(copied, {**RUN, "tolerance": 0.2})
    done = changed("lengths")
    assert done.returncode != 0 and "cannot be locked" in done.stdout
    assert all((copied.directory / "results" / name).is_file() for name in FILES)


def test_a_refused_run_leaves_the_recipes_of_the_other_one_with_a_database_too(copied):
    """Snakemake keeps its locks in a database then, not in files."""
    database = ("--persistence-backend", "db")
    copied.printed("lengths", *database, "--dry-run")
    with sqlite3.connect(copied.directory / ".snakemake" / "metadata.db") as connection:
        lock = str(copied.directory / ".snakemake"), "results/lengths.csv", "output"
        columns = "namespace, file_path, lock_type"
        connection.execute(f"INSERT INTO snakemake_locks ({columns}) VALUES (?, ?, ?)", lock)
    recipes = set(copied.directory.glob("results/store/recipes/*/**/*.json"))
    done = configured(copied, {**RUN, "tolerance": 0.2})("lengths", *database)
    assert done.returncode != 0 and "cannot be locked" in done.stdout
    assert recipes and all(path.is_file() for path in recipes)
    assert all((copied.directory / "results" / name).is_file() for name in FILES)


def test_a_failed_run_beside_another_one_leaves_no_former_results(copied):
    lock(copied, "results/figures/mine.png")
    changed = configured(copied, {**RUN, "tolerance": 0.01, "shortest_step": 9.0e-8})
    assert changed("lengths").returncode != 0
    assert not (copied.directory / "results" / "lengths.csv").exists()


def test_lint_misses_no_log(built):
    assert "No log directive" not in built("--lint").stdout


@pytest.mark.parametrize("lost", [False, True], ids=["notes", "no notes"])
def test_touch_makes_nothing_stale_or_current(copied, lost):
    if lost:
        shutil.rmtree(copied.directory / ".snakemake")
    copied.printed("--touch")
    assert copied.planned() == {}
    changed = configured(copied, {**RUN, "tolerance": 0.2})
    changed("--touch")
    assert changed.planned("lengths")["simulate"] == 2


def test_deleted_output_is_shown_again_without_a_job(copied):
    copied.printed("--delete-all-output")
    results, before = copied.directory / "results", logs(copied)
    assert not any((results / name).exists() for name in FILES)
    assert "Shown without a job" in copied.printed()
    assert all((results / name).is_file() for name in FILES) and logs(copied) == before


def test_every_file_is_a_target(built, fresh):
    targets = [f"results/{file}" for file in FILES]
    assert built.planned(*targets) == {}
    assert fresh.planned(*targets) == {"simulate": 2, "extract": 1, "lengths": 1, "draw_study": 1}
