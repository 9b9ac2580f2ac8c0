"""The digest of code: content and nothing else."""

import importlib.metadata
import os
import subprocess
import sys
from pathlib import Path

import pytest

from nucleation.datasets import code
from nucleation.simulation.checkpoints import SIMULATION
from replication.pipeline import launch

SOURCE = str(Path(__file__).parents[2] / "src")
ENVIRONMENT = {**os.environ, "PYTHONPATH": SOURCE}
LOW = "import numpy as np\n\nX = 1\n\n\ndef f(a):\n    return np.sin(a) + X\n"
HIGH = "from . import low\nfrom .low import f as g\n\nY = low.X + g(2)\n"
JOB = "from nucleation.wing.high import Y\nprint(Y)\n"


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A package of its own in the place of the project's."""
    monkeypatch.setattr(code, "_ROOT", tmp_path)
    code.forget()
    files = {
        "nucleation/__init__.py": '"""Words."""\n__version__ = "1"\n',
        "nucleation/wing/__init__.py": '"""Words."""\n',
        "nucleation/wing/low.py": LOW,
        "nucleation/wing/high.py": HIGH,
        "study/__init__.py": "",
        "study/job.py": JOB,
    }
    for name, text in files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    yield tmp_path
    code.forget()


def digest(package):
    code.forget()
    return code.digest(code.Root("study.job"))


@pytest.mark.parametrize(
    ("name", "old", "new", "matters"),
    [
        ("nucleation/wing/low.py", "X = 1", "X = 2", True),
        ("nucleation/wing/low.py", "sin", "cos", True),
        ("nucleation/wing/low.py", "def f(a):", "def f(a):\n    'Words.'\n    # and more", False),
        ("nucleation/wing/low.py", "np.sin(a) + X", "(\n        np.sin(a) + X)", False),
        ("nucleation/wing/high.py", "g(2)", "g(3)", True),
        ("nucleation/wing/__init__.py", '"""Words."""', "import os", True),
        ("nucleation/__init__.py", '"1"', '"2"', False),
        ("study/job.py", "print(Y)", "print(-Y)", True),
    ],
)
def test_what_counts(package, name, old, new, matters):
    before = digest(package)
    path = package / name
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    assert (digest(package) != before) == matters


def test_what_is_kept_of_a_module_counts_only_for_its_bytes(package):
    low = package / "nucleation/wing/__pycache__/low.source.json"
    low.parent.mkdir()
    before = digest(package)
    high = low.with_name("high.source.json")
    for content in (high.read_text(), "[", "1", low.read_text()[:-9]):
        low.write_text(content)
        assert digest(package) == before


def test_a_definition_of_another_name_counts(package):
    before = digest(package)
    (package / "nucleation" / "wing" / "high.py").write_text(
        HIGH.replace("import f as", "import X as")
    )
    assert digest(package) != before


def test_a_package_that_a_root_never_uses_counts_only_for_others(package):
    job = code.Root("study.job", unused=("nucleation.wing",))
    assert code.closure(job) == {"study", "study.job"}
    whole = code.closure(job, code.Root("nucleation.wing.high"))
    assert {"nucleation.wing.low", "study.job"} < whole


def test_a_package_of_no_root_is_a_library(package):
    """In an installation all libraries lie beside this one."""
    library = package / "quarry"
    library.mkdir()
    (library / "__init__.py").write_text("import nowhere\n")
    (package / "study" / "job.py").write_text("import quarry\n")
    job = code.Root("study.job")
    assert code.closure(job) == {"study", "study.job"}
    assert code.libraries(job) == {"quarry"}


def test_versions_of_what_is_imported_count(package, monkeypatch):
    before = digest(package)
    versions = {"numpy": "0.0"}
    known = importlib.metadata.version
    monkeypatch.setattr(importlib.metadata, "version", lambda n: versions.get(n) or known(n))
    code._version.cache_clear()
    assert digest(package) != before
    versions = {"scipy": "0.0"}
    code._version.cache_clear()
    assert digest(package) == before, "nothing imports it"
    code._version.cache_clear()


def test_a_library_that_is_not_here_stops_no_planning():
    assert code._version("no-such-library") == "missing"


def test_digest_of_the_simulation_reaches_its_libraries():
    names = code.libraries(SIMULATION)
    assert {"numpy", "scipy", "numba", "llvmlite", "xarray", "netCDF4"} <= names
    modules = code.closure(SIMULATION) - {"nucleation"}
    wings = {module.split(".")[1] for module in modules}
    assert not wings & {"extraction", "commands", "api", "pictures", "lengths", "drop"}
    assert not any(module.startswith("replication") for module in modules)


def test_what_reads_tables_does_not_count_the_solver():
    """Nor does its job load it, as a job loads all code that counts."""
    rooms = ("figures.figure_3", "claims.table", "tables.lengths")
    assert not code.libraries(*(code.Root(f"replication.{room}") for room in rooms)) & {"numba"}


WITHOUT = """
import sys

class Missing:
    def find_spec(self, name, *_):
        if f"{name}.".startswith(PREFIXES):
            raise ImportError(name)

sys.meta_path.insert(0, Missing())
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.run import simulate

small = PAPER_RUN.replaced(n_x=16, n_y=4, end_time=1e-3)
print(simulate(type(small).from_dict(small.to_dict())).attrs["steps"])
"""


@pytest.mark.slow
def test_a_simulation_runs_without_the_code_that_does_not_count_for_it():
    text = WITHOUT.replace("PREFIXES", repr(tuple(f"{name}." for name in SIMULATION.unused)))
    command = [sys.executable, "-c", text]
    given = {"capture_output": True, "text": True, "env": ENVIRONMENT}
    done = subprocess.run(command, **given)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) > 3
    counted = text.replace("nucleation.lengths.", "nucleation.fem.")
    assert (
        "ImportError: nucleation.fem"
        in subprocess.run([sys.executable, "-c", counted], **given).stderr
    )


def test_bytecode_is_never_outdated(tmp_path, monkeypatch):
    """An edit of the same size, with its time kept: Python by itself would run the old one."""
    monkeypatch.delenv("PYTHONDONTWRITEBYTECODE", raising=False)
    (tmp_path / "part.py").write_text("print(1)\n")
    command = [sys.executable, "-c", "import part"]
    for first in (True, False):
        if not first:
            moment = (tmp_path / "part.py").stat().st_mtime
            (tmp_path / "part.py").write_text("print(2)\n")
            os.utime(tmp_path / "part.py", (moment, moment))
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)  # compiles it
        launch.make_checked(tmp_path)
    said = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True)
    assert said.stdout == "2\n"


def test_what_numba_keeps_is_named_by_content(tmp_path):
    names = set()
    for text in ("import numba\nX = 1\n", "import numba\nX = 2\n"):
        (tmp_path / "part.py").write_text(text)
        names.add(launch.cache_of_numba(tmp_path))
    (tmp_path / "other.py").write_text("X = 1\n")
    assert len(names | {launch.cache_of_numba(tmp_path)}) == 2


def test_what_jobs_load_has_bytecode(tmp_path):
    """Also where Python is not allowed to write it in a job."""
    package = tmp_path / "house"
    package.mkdir()
    (package / "__init__.py").write_text("import quarry\n")
    (package / "room.py").write_text("")
    (tmp_path / "quarry.py").write_text("")
    program = "from workflow.install import compile_imports; compile_imports('house'); import sys; "
    program += "assert 'numba.np.arraymath' in sys.modules"  # loaded by the first kernel
    given = os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}
    given["PYTHONPATH"] = os.pathsep.join([str(tmp_path), str(Path(SOURCE).parent)])
    subprocess.run([sys.executable, "-c", program], env=given, check=True)
    kept = {path.name.partition(".")[0] for path in tmp_path.rglob("*.pyc")}
    assert kept == {"quarry", "__init__", "room"}
