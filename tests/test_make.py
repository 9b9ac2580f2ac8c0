"""What is given to make reaches the programs as it is, whatever characters it has."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

pytestmark = pytest.mark.system

PROGRAM = """#!{python} -IS
import json, os, sys
with open("called", "a") as file:
    print(json.dumps(sys.argv[1:]), file=file)
with open("environment", "w") as file:
    json.dump(dict(os.environ), file)
"""

NAMES = [
    "$$(touch PWN).yaml",
    "$(touch PWN).yaml",
    "$(shell touch PWN).yaml",
    "`touch PWN`.yaml",
    "a;touch PWN;.yaml",
    "a&touch PWN.yaml",
    "a|touch PWN",
    "-",
    'q"x.yaml',
    "q'x.yaml",
    "a b.yaml",
    "a\\b.yaml",
    "#a.yaml",
    "é.yaml",
]


@pytest.fixture
def make(tmp_path):
    """Run make in a place whose environment notes how its Python is called; give the calls."""
    for name in ("environment.txt", "environment-dev.txt"):
        (tmp_path / name).touch()
    programs = tmp_path / "venv" / "bin"
    programs.mkdir(parents=True)
    for name in ("python", "snakemake"):
        (programs / name).write_text(PROGRAM.format(python=Path(sys.executable).resolve()))
        (programs / name).chmod(0o755)
    for name in ("environment", "environment-dev"):
        (tmp_path / "venv" / f"{name}.stamp").touch()

    def run(*arguments, **variables):
        (tmp_path / "called").unlink(missing_ok=True)
        given = [f"{name}={value}" for name, value in {"VENV": "venv", **variables}.items()]
        done = subprocess.run(
            ["make", "-f", ROOT / "Makefile", *arguments, *given],
            cwd=tmp_path,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        assert done.returncode == 0, done.stdout
        assert not (tmp_path / "PWN").exists()
        return [json.loads(line) for line in (tmp_path / "called").read_text().splitlines()]

    run.environment = lambda: json.loads((tmp_path / "environment").read_text())
    return run


LAUNCH = ["-m", "replication.pipeline.launch"]


@pytest.mark.parametrize("name", NAMES)
def test_no_name_of_a_file_is_run(make, name, monkeypatch):
    cores = ["--cores", "2"]
    assert make("paper", CONFIG=name) == [[*LAUNCH, *cores, "--configfile", name]]
    built, shown = make("report", CONFIG=name)
    given = [*cores, "--configfile", name]
    assert built == [*LAUNCH, "figures", *given]
    assert shown == [*LAUNCH, "figures", "--report", "results/report.html", *given]
    assert make("paper", CORES=name) == [[*LAUNCH, "--cores", name]]
    monkeypatch.setenv("CONFIG", name)
    assert make("paper") == [[*LAUNCH, *given]]


@pytest.mark.parametrize("variable", ["NUCLEATION_STORES", "NUMBA_CACHE_DIR", "OTHER"])
def test_no_other_variable_is_run_and_all_reach_the_jobs(make, variable):
    for value in ("$(shell touch PWN)", "$HOME/store", "`touch PWN`"):
        make("check", **{variable: value})
        assert make.environment()[variable] == value


def test_targets_are_words(make):
    assert make("paper", TARGETS="figure_3 lengths")[0][2:4] == ["figure_3", "lengths"]
    found = make("paper", TARGETS="$(touch PWN) `touch PWN`")[0][2:]
    assert found == ["$(touch", "PWN)", "`touch", "PWN`", "--cores", "2"]


def test_an_environment_with_a_quote_in_its_name(make, tmp_path):
    (tmp_path / "venv").rename(tmp_path / "v'e$n`v")
    assert make("paper", VENV="v'e$n`v") == [[*LAUNCH, "--cores", "2"]]


def test_an_environment_with_a_blank_in_its_name_is_refused(tmp_path):
    command = ["make", "-f", ROOT / "Makefile", "paper", "VENV=my venv"]
    done = subprocess.run(command, cwd=tmp_path, text=True, capture_output=True)
    assert done.returncode != 0
    assert 'VENV = "my venv" is not allowed' in done.stderr


INSTALL = ["-P", "workflow/install.py"]


@pytest.mark.parametrize(
    ("target", "installed"),
    [
        ("install", ["environment.txt"]),
        ("paper", ["environment.txt"]),
        ("report", ["environment.txt"]),
        ("quick", ["environment.txt"]),
        ("test-quick", ["environment.txt", "environment-dev.txt"]),
        ("docs", ["environment.txt", "environment-dev.txt"]),
    ],
)
def test_each_target_installs_what_it_needs(make, tmp_path, target, installed):
    for stamp in tmp_path.glob("venv/*.stamp"):
        stamp.unlink()
    (tmp_path / "venv/bin/sphinx-build").symlink_to("python")
    assert [call[-1] for call in make(target) if call[:-1] == INSTALL] == installed
    assert [call for call in make("paper") if call[:-1] == INSTALL] == []
    subprocess.run([tmp_path / "venv/bin/nucleation", "length"], cwd=tmp_path, check=True)
    assert (tmp_path / "called").read_text().endswith('["-P", "-m", "nucleation", "length"]\n')
