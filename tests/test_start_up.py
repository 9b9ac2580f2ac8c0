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
SCIENCE = ("scipy", "pandas", "jsonschema")

CONFIGURATION = """
from replication.configuration import advice, load
settings = load.load()
advice.warned(settings.runs)
"""
LAZY = """
from replication.configuration import load
load.load(lazy=True).runs_for("paper", "converged", "long_blocks")
"""
COMMANDS = """
from nucleation.commands import run
for words in {}:
    code = run(words.split())
    assert code in (0, None), code
"""
LENGTHS = """
from nucleation import api
fault = dict(shear_modulus=30e9, poisson_ratio=0.25, normal_stress=50e6, a=0.01, b=0.015)
api.Fault(**fault, slip_distance=5e-6, velocity=1.0, height=[0.1, 1.0]).critical_mode()
"""
PLAN = """
from snakemake.cli import main
try:
    main("paper --snakefile {root}/Snakefile --dry-run --quiet all".split())
except SystemExit as end:
    assert not end.code
"""
JOB = """
from dataclasses import asdict
from replication.configuration.load import load
from replication.pipeline import making, recipes, store
settings = load(lazy=True)
values = {"base": settings.base.to_dict(), "curves": asdict(settings.drawn_curves())}
call = "replication.tables.curves:theory_dataset"
recipe = recipes.Recipe("theory", ["theory.nc"], ".", call, [], values, {}, [])
making.make(recipe, "theory", store.Store("store"), 1, False)
"""
HALF_SPACES = (
    "length --shear-modulus=30GPa --poisson-ratio=0.25 --normal-stress=50MPa --a=0.010 --b=0.015 "
    "--slip-distance=5um --perturbation=none"
)
DRY_RUN = "simulate run.nc --height=0.1 --friction-law=dieterich_ruina --dry-run"
PLAIN = ["--help", "simulate --help", DRY_RUN]
NEEDED_LATER = {
    "theory": (LENGTHS, (*SOLVER, *HEAVY, "scipy", "pandas")),
    "configuration": (CONFIGURATION, (*SOLVER, *HEAVY)),
    "planning": (LAZY, (*SOLVER, *HEAVY, *SCIENCE)),
    "help and dry run": (COMMANDS.format(PLAIN), (*SOLVER, *HEAVY)),
    "help of length": (COMMANDS.format(["length --help"]), SOLVER),  # it knows named dimensions
    "length": (COMMANDS.format([HALF_SPACES]), (*SOLVER, *HEAVY, "scipy")),
    "plan": (PLAN.format(root=ROOT), COMPILED),
    "job": (JOB, (*SOLVER, "matplotlib", "pint", "scipy.integrate", "scipy.optimize")),
    "drawing": ("import replication.tables.lengths, replication.figures.figure_3", COMPILED),
}
"""Codes, and modules that they need not load."""


def loaded(code, names, directory):
    """Which of some modules a fresh Python has loaded after some code."""
    code += f"\nimport sys\nprint(*sorted({{*{names!r}}} & {{*sys.modules}}))"
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=directory,
        text=True,
        capture_output=True,
        check=True,
        env={"PYTHONPATH": str(ROOT / "src"), "PATH": "/usr/bin:/bin", "HOME": str(directory)},
    )
    return done.stdout.splitlines()[-1].split()


@pytest.mark.parametrize(("code", "names"), NEEDED_LATER.values(), ids=NEEDED_LATER)
def test_what_is_not_needed_is_not_loaded(code, names, tmp_path):
    assert loaded(code, names, tmp_path) == []


def test_a_simulation_does(tmp_path):
    """The test itself would miss nothing: what is looked for is found where it is used."""
    names = (*SOLVER, *HEAVY)
    code = "import nucleation.simulation.run, netCDF4, matplotlib, pint"
    assert loaded(code, names, tmp_path) == sorted(names)
