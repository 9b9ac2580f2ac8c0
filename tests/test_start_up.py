"""What is not loaded before it is needed: the compiled solver, above all."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.system

ROOT = Path(__file__).parents[1]

COMPILED = ("numba", "nucleation.simulation.step", "nucleation.simulation.run")
SOLVER = (*COMPILED, "nucleation.fem")
HEAVY = ("xarray", "netCDF4", "matplotlib", "pint")  # a second in all, on a good day

LOADED = """
import sys
{code}
print(*sorted(set({names!r}) & set(sys.modules)))
"""

CONFIGURATION = """
from nucleation.configuration import advice, load, schema
settings = load.load("config/config.yaml")
schema.text()
advice.advise(settings.runs)
"""


def loaded(code, names, directory=ROOT):
    """Which of some modules a fresh Python has loaded after some code."""
    done = subprocess.run(
        [sys.executable, "-c", LOADED.format(code=code, names=names)], cwd=directory, text=True,
        capture_output=True, check=True,
        env={"PYTHONPATH": str(ROOT / "src"), "PATH": "/usr/bin:/bin", "HOME": str(directory)},
    )  # fmt: skip
    return done.stdout.splitlines()[-1].split()


def command(*words):
    return f"""
from nucleation.commands import run
code = run({list(words)!r})
assert code in (0, None), code
"""


def test_the_configuration_loads_no_solver():
    assert loaded(CONFIGURATION, (*SOLVER, *HEAVY)) == []


@pytest.mark.parametrize("words", [["--help"], ["simulate", "--help"], ["length", "--help"]])
def test_help_loads_no_solver(words, tmp_path):
    heavy = HEAVY if words != ["length", "--help"] else ()  # arrays over named dimensions
    assert loaded(command(*words), (*SOLVER, *heavy), tmp_path) == []


def test_a_dry_run_loads_no_solver(tmp_path):
    words = ["simulate", "run.nc", "--height=0.1", "--friction-law=dieterich_ruina", "--dry-run"]
    assert loaded(command(*words), (*SOLVER, *HEAVY), tmp_path) == []


def test_planning_the_workflow_loads_no_solver(tmp_path):
    words = ["paper", "--snakefile", str(ROOT / "Snakefile"), "--directory", str(tmp_path),
             "--dry-run", "--quiet", "all"]  # fmt: skip
    code = f"""
from snakemake.cli import main
try:
    main({words!r})
except SystemExit as end:
    assert not end.code
"""
    assert loaded(code, COMPILED, tmp_path) == []


def test_what_reads_and_draws_records_loads_no_solver(tmp_path):
    code = "import nucleation.analysis.lengths, nucleation.figures.paper.figure_3"
    assert loaded(code, COMPILED, tmp_path) == []


def test_a_simulation_does(tmp_path):
    """The test itself would miss nothing: what is looked for is found where it is used."""
    names = (*SOLVER, *HEAVY)
    code = "import nucleation.simulation.run, netCDF4, matplotlib, pint"
    assert loaded(code, names, tmp_path) == sorted(names)
