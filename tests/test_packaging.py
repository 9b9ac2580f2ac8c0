"""The package outside its checkout: a wheel with all that it needs, and every import declared."""

import ast
import importlib.metadata
import os
import re
import subprocess
import sys
import sysconfig
import tomllib
import venv
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "nucleation"
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
EXTRAS = PROJECT["optional-dependencies"]


def normal(name):
    return re.sub(r"[-_.]+", "-", name).lower()


def named(requirements):
    """Names of the packages in requirements; the project's own extras stand for what is in them."""
    found = set()
    for requirement in requirements:
        name, extras = re.match(r"([\w.-]+)(?:\[([\w,]+)\])?", requirement).groups()
        if name == "nucleation":
            found |= named(each for extra in extras.split(",") for each in EXTRAS[extra])
        else:
            found.add(normal(name))
    return found


CORE = named(PROJECT["dependencies"])
BEYOND = {
    "report": "report",
    "claims/article.py": "report",
    "claims/printing.py": "article",
    "pipeline": "workflow",
}
"""Parts of the package that need one of the extras as well."""


def imported(path):
    """Top-level names of foreign modules that a file imports, anywhere in it."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            names.add(node.module)
    top = {name.split(".")[0] for name in names}
    return top - sys.stdlib_module_names - {"nucleation"}


def test_every_import_is_declared():
    distributions = importlib.metadata.packages_distributions()
    used = set()
    for path in SOURCE.rglob("*.py"):
        name = str(path.relative_to(SOURCE))
        extra = next((extra for part, extra in BEYOND.items() if name.startswith(part)), None)
        allowed = CORE | (named(EXTRAS[extra]) if extra else set())
        for module in imported(path):
            providers = {normal(each) for each in distributions[module]}
            assert providers & allowed, f"{name} imports {module}"
            used |= providers
    idle = CORE - used - {"pandas", "netcdf4"}  # of xarray: its tables and its files
    assert not idle


def test_everything_declared_is_pinned():
    pinned = re.findall(r"^([\w.-]+)==", (ROOT / "environment.txt").read_text(), re.M)
    assert named(PROJECT["dependencies"]) | named(EXTRAS["test"]) <= set(map(normal, pinned))
    assert {"report", "workflow", "article", "remote", "docs", "test"} == set(EXTRAS)


def run(*command, **options):
    done = subprocess.run(
        [str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True, timeout=600, **options,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Built by the pinned setuptools, from a copy of what is committed: nothing is downloaded."""
    copy, built = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("wheel")
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        (copy / name).write_bytes((ROOT / name).read_bytes())
    for path in SOURCE.rglob("*"):
        if path.is_file() and "__pycache__" not in path.parts:
            target = copy / path.relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(path.read_bytes())
    pip = (sys.executable, "-m", "pip", "--disable-pip-version-check")
    run(*pip, "wheel", "--no-deps", "--no-build-isolation", "--no-index", "-w", built, copy)
    (path,) = built.iterdir()
    return path


@pytest.mark.slow
def test_wheel_is_whole(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if not name.endswith("/")}
    files = {str(p.relative_to(SOURCE.parent)) for p in SOURCE.rglob("*") if p.is_file()}
    files = {name for name in files if "__pycache__" not in name}
    assert files <= names
    assert {"nucleation/py.typed", "nucleation/report/template.html"} <= files


def closure(names):
    """Distributions with all that they need, as installed here."""
    found, waiting = set(), set(names)
    while waiting:
        name = waiting.pop()
        try:
            requires = importlib.metadata.requires(name) or []
        except importlib.metadata.PackageNotFoundError:
            continue  # for another machine
        found.add(name)
        plain = (each for each in requires if "extra ==" not in each)
        waiting |= {normal(re.match(r"[\w.-]+", each)[0]) for each in plain} - found
    return found


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    """An environment with the wheel and what it declares, its own files linked from this one."""
    directory = tmp_path_factory.mktemp("environment")
    venv.create(directory, with_pip=False, symlinks=True)
    base = {"base": str(directory), "platbase": str(directory)}
    library = Path(sysconfig.get_path("purelib", vars=base))
    for name in closure(CORE):
        for file in importlib.metadata.distribution(name).files:
            top = Path(file).parts[0]
            origin = Path(importlib.metadata.distribution(name).locate_file(top))
            if top not in ("..", "__pycache__") and not (library / top).exists():
                (library / top).symlink_to(origin)
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(library)
    return directory / "bin" / "python"


def outside(installed, directory, *arguments):
    """Run the environment's Python far from the checkout."""
    clean = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    return run(
        installed, *arguments, cwd=directory, env={**clean, "NUMBA_CACHE_DIR": str(directory)}
    )


LIBRARY = """
import importlib.util, nucleation
from nucleation.api import Geometry, Mesh, Parameters, Stepping, critical_length, simulate, write
assert "site-packages" in nucleation.__file__, nucleation.__file__
assert importlib.util.find_spec("snakemake") is importlib.util.find_spec("jinja2") is None
fault = dict(shear_modulus=30e9, poisson_ratio=0.25, normal_stress=50e6, a=0.010, b=0.015)
print(round(float(critical_length(**fault, slip_distance=5e-6)), 3))
block = Parameters(geometry=Geometry(height=0.005, length=0.9), mesh=Mesh(n_x=16, n_y=2),
                   stepping=Stepping(end_time=0.02))
write(simulate(block), "run.nc")
"""

COMMANDS = """
import importlib.metadata
for point in importlib.metadata.distribution("nucleation").entry_points:
    print(point.name, "=", point.value)
"""


@pytest.mark.slow
def test_library_and_command_work_with_what_is_declared(installed, tmp_path):
    assert outside(installed, tmp_path, "-c", LIBRARY) == "2.513\n"
    assert "slip_rate" in outside(installed, tmp_path, "-m", "nucleation", "show", "run.nc")
    small = "simulate again.nc --n-x 16 --n-y 2 --end-time 0.02"
    outside(installed, tmp_path, "-m", "nucleation", *small.split())
    assert (tmp_path / "again.nc").stat().st_size > 10_000
    fault = "--shear-modulus 30GPa --poisson 0.25 --normal-stress 50MPa --a 0.010 --b 0.015"
    words = ["length", *fault.split(), "--slip-distance", "5um"]
    assert "2.51" in outside(installed, tmp_path, "-m", "nucleation", *words)
    (command,) = run(installed, "-c", COMMANDS).splitlines()
    assert command == "nucleation = nucleation.__main__:start"
