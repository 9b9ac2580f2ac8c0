"""The package outside its checkout: a wheel with all that it needs, and every import declared."""

import ast
import importlib.metadata
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tomllib
import venv
import zipfile
from pathlib import Path

import pytest

from nucleation import installed
from workflow import install

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
        if normal(name) == PROJECT["name"]:
            found |= named(each for extra in extras.split(",") for each in EXTRAS[extra])
        else:
            found.add(normal(name))
    return found


CORE = named(PROJECT["dependencies"])
BEYOND = {
    "nucleation/pictures": "figures",
    "nucleation/extraction": "solver",
    "nucleation/fem": "solver",
    "nucleation/simulation": "solver",
    "replication": "test",
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
    return top - sys.stdlib_module_names - {"nucleation", "replication"}


def test_every_import_is_declared():
    distributions = importlib.metadata.packages_distributions()
    used = set()
    for path in SOURCE.parent.rglob("*.py"):
        name = str(path.relative_to(SOURCE.parent))
        extra = next((extra for part, extra in BEYOND.items() if name.startswith(part)), None)
        allowed = CORE | (named(EXTRAS[extra]) if extra else set())
        for module in imported(path):
            providers = {normal(each) for each in distributions[module]}
            assert providers & allowed, f"{name} imports {module}"
            used |= providers
    unused = {"netcdf4"}  # xarray reads and writes with it
    assert not (CORE | named(EXTRAS["solver"]) | named(EXTRAS["figures"])) - used - unused


@pytest.mark.parametrize("extra", installed.EXTRAS)
def test_what_is_asked_for_is_what_the_extra_brings(extra):
    distributions = importlib.metadata.packages_distributions()
    modules = {each for name in installed.EXTRAS[extra] for each in distributions[name]}
    own = [each for each in EXTRAS[extra] if not each.startswith(PROJECT["name"])]
    assert set(map(normal, modules)) == named(own)
    assert PROJECT["name"] == installed.DISTRIBUTION


def pinned(file):
    """Versions, with the machines that they are for, by package."""
    found = {}
    for name, version in re.findall(r"^([\w.-]+)==([^\\\n]+)", (ROOT / file).read_text(), re.M):
        found.setdefault(normal(name), set()).add(version.partition(";")[0].strip())
    return found


def test_everything_declared_is_pinned():
    paper, everything = pinned("environment.txt"), pinned("environment-dev.txt")
    core = named(PROJECT["dependencies"])
    assert core | named(EXTRAS["workflow"]) <= set(paper)
    assert core | named(EXTRAS["test"]) <= set(everything)
    assert {"sphinx", "mypy", "pytest", "ruff"}.isdisjoint(paper)
    for name, versions in paper.items():
        assert versions <= everything[name], f"{name}: make lock"
    assert {"solver", "figures", "workflow", "docs", "test"} == set(EXTRAS)


def run(*command, code=0, **options):
    done = subprocess.run(
        [str(word) for word in command],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=600,
        **options,
    )
    assert done.returncode == code, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """Built by the pinned setuptools, from a copy of what is committed: nothing is downloaded."""
    copy, built = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("wheel")
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, copy)
    ignored = shutil.ignore_patterns("__pycache__")
    shutil.copytree(SOURCE, copy / SOURCE.relative_to(ROOT), ignore=ignored)
    shutil.copytree(ROOT / "docs", copy / "docs", ignore=ignored)
    pip = (sys.executable, "-m", "pip", "--disable-pip-version-check")
    run(*pip, "wheel", "--no-deps", "--no-build-isolation", "--no-index", "-w", built, copy)
    (path,) = built.iterdir()
    return path


@pytest.mark.slow
def test_wheel_is_whole(wheel):
    files = {str(p.relative_to(SOURCE.parent)) for p in SOURCE.rglob("*") if p.is_file()}
    with zipfile.ZipFile(wheel) as archive:
        assert {x for x in files if "__pycache__" not in x} <= set(archive.namelist())
    assert "nucleation/py.typed" in files
    assert not any("replication" in name for name in archive.namelist())


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
def light(wheel, tmp_path_factory):
    return environment(wheel, tmp_path_factory.mktemp("light"), CORE)


def environment(wheel, directory, requirements):
    """An environment with the wheel and what it declares, its own files linked from this one."""
    venv.create(directory, with_pip=False, symlinks=True)
    base = {"base": str(directory), "platbase": str(directory)}
    library = Path(sysconfig.get_path("purelib", vars=base))
    for name in closure(requirements):
        for file in importlib.metadata.distribution(name).files:
            top = Path(file).parts[0]
            origin = Path(importlib.metadata.distribution(name).locate_file(top))
            if top not in ("..", "__pycache__") and not (library / top).exists():
                (library / top).symlink_to(origin)
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(library)
    (data,) = library.glob("*.data/data/share")
    data.rename(directory / "share")  # as pip does
    return directory / "bin" / "python"


def outside(python, directory, *arguments, code=0):
    """Run an environment's Python far from the checkout."""
    clean = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    clean |= {"NUMBA_CACHE_DIR": str(directory)}
    return run(python, *arguments, code=code, cwd=directory, env=clean)


LIBRARY = """
import importlib.util, nucleation
from nucleation.api import PAPER, Fault, Run, simulate, write
assert "site-packages" in nucleation.__file__, nucleation.__file__
assert importlib.util.find_spec("snakemake") is importlib.util.find_spec("jinja2") is None
fault = dict(shear_modulus=30e9, poisson_ratio=0.25, normal_stress=50e6, a=0.010, b=0.015)
print(round(Fault(**fault, slip_distance=5e-6).critical_length(), 3))
block = Run.sized(PAPER, block_length=0.9, n_x=16, n_y=2, end_time=0.02)
write(simulate(block), "run.nc")
"""

FAULT = "--shear-modulus 30GPa --poisson-ratio 0.25 --normal-stress 50MPa --a 0.010 --b 0.015"
LENGTH = ["-m", "nucleation", "length", *FAULT.split(), "--slip-distance", "5um"]

THEORY = """
from nucleation import api
fault = dict(shear_modulus=30e9, poisson_ratio=0.25, normal_stress=50e6, a=0.010, b=0.015)
fault = api.Fault(**fault, slip_distance=5e-6)
print(round(fault.critical_length(), 3))
print(round(fault.stability_length(), 3))
print(list(fault.lengths("none")), api.PAPER.height)
from nucleation.api import *
try:
    simulate()
except ImportError as error:
    print(error)
"""


@pytest.mark.slow
def test_library_alone_has_lengths_and_names_the_extra_for_the_rest(light, tmp_path):
    advice = "this needs numba, rocket_fft, netCDF4: pip install 'nucleation-length[solver]'"
    *lengths, said = outside(light, tmp_path, "-c", THEORY).splitlines()
    assert lengths[:2] == ["2.513", "1.947"] and said.startswith(advice)
    assert lengths[2:] == ["['stability_length', 'critical_length', 'process_zone'] 0.005"]
    (tmp_path / "run.nc").touch()
    for words in (["simulate", "new.nc"], ["show", "run.nc"]):
        said = outside(light, tmp_path, "-m", "nucleation", *words, code=2)
        assert f"Error: {advice}" in " ".join(said.split())
        assert "Traceback" not in said


HELP = """
from click.shell_completion import ShellComplete
from click.testing import CliRunner
from nucleation.commands import COMMANDS, main
shell = ShellComplete(main, {}, "nucleation", "_NUCLEATION_COMPLETE")
for command in COMMANDS:
    assert "Exit codes:" in CliRunner().invoke(main, [command, "--help"]).output, command
    assert [item.value for item in shell.get_completions([command], "--js")] == ["--json"], command
"""


@pytest.mark.slow
def test_library_alone_has_the_help_of_every_command(light, tmp_path):
    """Help and completion load no extra, and a dry run needs none."""
    outside(light, tmp_path, "-c", HELP)
    dry = ["simulate", "new.nc", "--paper", "--dry-run"]
    assert "critical length" in outside(light, tmp_path, "-m", "nucleation", *dry)


@pytest.mark.slow
def test_pages_are_cited_by_an_address_that_is_there(light, tmp_path):
    """Far from a checkout too: by the path of the page that the wheel has brought."""
    said = outside(light, tmp_path, "-m", "nucleation", "length", "--paper", "--height", "2cm")
    said += outside(light, tmp_path, *LENGTH, "--outside-zeta", "-0.005")
    pages = re.findall(r"[^\s(]*doc[^\s(]*\.md", said)
    assert {Path(page).name for page in pages} == {"drop.md", "creeping_patch.md"}
    assert all(Path(page).is_absolute() and Path(page).is_file() for page in pages)


@pytest.mark.slow
@pytest.mark.system
def test_it_works_with_the_oldest_versions(wheel, tmp_path):
    """Those that pyproject.toml allows, of all that simulates and draws; they are downloaded."""
    wanted = [*PROJECT["dependencies"], *EXTRAS["solver"], *EXTRAS["figures"]]
    assert all(">=" in requirement for requirement in wanted)
    constraints = tmp_path / "oldest.txt"
    constraints.write_text("\n".join(wanted).replace(">=", "=="))
    venv.create(tmp_path / "environment", with_pip=False, symlinks=True)
    python = tmp_path / "environment" / "bin" / "python"
    variables = install.variables_of_uv(install.settings_of_pip())
    program = [sys.executable, "-m", "pip", "--python", python, "install"]
    if variables is not None:
        program = [install.uv(), "pip", "install", "--no-config", "--python", python]
    given = os.environ | (variables or {})
    try:
        run(*program, "--quiet", "-c", constraints, f"{wheel}[solver,figures]", env=given)
    except AssertionError:
        if os.environ.get("CI") == "true":
            raise
        pytest.skip("no packages can be installed here")
    assert outside(python, tmp_path, "-c", LIBRARY) == "2.513\n"
    assert "2.513 m" in outside(python, tmp_path, *LENGTH)
    outside(python, tmp_path, "-m", "nucleation", "show", "run.nc", "--plot", "run.png")
    assert (tmp_path / "run.png").stat().st_size > 10_000


@pytest.mark.system
def test_the_other_project_in_its_place_is_told(tmp_path):
    """Both installed into one place, the other one last."""
    place = tmp_path / "nucleation"
    place.mkdir()
    for part in SOURCE.iterdir():
        (place / part.name).symlink_to(part)
    (place / "__init__.py").unlink()
    (place / "__init__.py").write_text('"""nucleation - generated bindings."""')
    for words in (["-m", "nucleation", "--help"], ["-c", "import nucleation.api"]):
        own = {"cwd": tmp_path, "env": {"PYTHONPATH": str(tmp_path)}}
        said = run(sys.executable, *words, code=1, **own)
        assert "is not nucleation-length" in said and "pip uninstall nucleation" in said
