"""A configuration is looked at before Snakemake sees it."""

import sys
from pathlib import Path

import pytest

from replication.pipeline import launch

ROOT = Path(__file__).parents[2]
GOOD = "studies: {s: {runs: [{height: 0.01}]}}\n"


@pytest.mark.parametrize(
    ("arguments", "files"),
    [
        ("lengths --cores 2", []),
        ("lengths --configfile a.yaml b.yaml --cores 2", ["a.yaml", "b.yaml"]),
        ("--configfiles=a.yaml -n lengths", ["a.yaml"]),
        ("--configfile a.yaml --config results=b --configfile c.yaml", ["a.yaml", "c.yaml"]),
    ],
)
def test_configuration_files_of_a_command_line(arguments, files):
    assert launch.options(arguments.split()).configfile == files


BAD = {
    "missing": (None, "can't be read: No such file"),
    "code": (f"__use_yte__: true\n{GOOD}".encode(), "__use_yte__ = True is not allowed"),
    "twice": (b"results: a\nresults: b\n", "the key results is given twice, in lines 1 and 2"),
}


@pytest.mark.parametrize(("content", "said"), BAD.values(), ids=BAD.keys())
def test_bad_file_is_one_message_and_snakemake_is_not_started(content, said, tmp_path, monkeypatch):
    if content is not None:
        (tmp_path / "a.yaml").write_bytes(content)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("os.execv", lambda *_: pytest.fail("Snakemake is started"))
    monkeypatch.setattr(sys, "argv", ["launch", "--configfile", "a.yaml"])
    with pytest.raises(SystemExit) as stopped:
        launch.main()
    assert said in stopped.value.code


@pytest.mark.parametrize(
    ("arguments", "refused"),
    [
        ("--cores 0", True),
        ("paper -c 0 -n", True),
        ("-c0", True),
        ("--cores=-1", True),
        ("--cores 10", False),
        ("-c all -n", False),
        ("--cores 1 --retries 0", False),
    ],
)
def test_no_cores_are_refused(arguments, refused):
    """Snakemake would wait forever."""
    assert (launch.problem(arguments.split()) == "--cores must be 1 or more") == refused


def test_good_file_is_handed_on(tmp_path, monkeypatch):
    (tmp_path / "a.yaml").write_text(GOOD)
    arguments = ["-n", "--configfile", str(tmp_path / "a.yaml")]
    started = []
    monkeypatch.setattr("os.execv", lambda program, command: started.append(command))
    monkeypatch.setattr(sys, "argv", ["launch", *arguments])
    launch.main()
    assert started == [[sys.executable, "-m", "snakemake", *arguments]]


@pytest.mark.slow  # for Snakemake's import
@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ([], {"cores": 2, "keep_going": True, "executor": None}),
        (["--workflow-profile", "slurm"], {"jobs": 50, "executor": "slurm"}),
    ],
)
def test_snakemake_finds_the_profiles_of_a_clone(options, expected, monkeypatch):
    from snakemake.cli import parse_args

    monkeypatch.chdir(ROOT)
    _, found = parse_args(["figure_1", *options])
    assert {name: getattr(found, name) for name in expected} == expected


def test_files_are_looked_at_as_snakemake_merges_them(tmp_path, monkeypatch):
    """Each may lack what another one has."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.yaml").write_text("results: a\n")
    (tmp_path / "b.yaml").write_text("studies: {s: {runs: [{height: 0.01, n_x: 1}]}}\n")
    (tmp_path / "c.yaml").write_text("studies: {s: {runs: [{height: 0.01, n_x: 99}]}}\n")
    assert "n_x = 1 is not allowed" in launch.problem(["--configfile", "a.yaml", "b.yaml"])
    assert launch.problem(["--configfile", "b.yaml", "a.yaml", "c.yaml"]) is None
