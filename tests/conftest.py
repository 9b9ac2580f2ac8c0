"""For all tests: their order, and what hypothesis does.

Each file is run by one worker (make test). Were a long one begun last, the other core would wait.
"""

import functools
import os
from pathlib import Path

import hypothesis
import pytest

pytest_plugins = ("coarse_run",)

# make test hands its own settings (VENV=...) to every make below it
OF_MAKE = ["MAKEFLAGS", "MFLAGS", "MAKELEVEL", "VENV", "PYTHON"]
for name in [*OF_MAKE, "CORES", "TARGETS", "CONFIG", "PRUNE"]:
    os.environ.pop(name, None)

# Snakemake's plugin asks Slurm at every start: a controller that is gone would take ten seconds.
os.environ["SLURM_CONF"] = os.devnull

# Workers are processes: threads of the linear algebra would take the cores from one another.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# No deadline: machines are busy. In CI the same examples at every run, elsewhere new ones.
hypothesis.settings.register_profile(
    "project", deadline=None, max_examples=100, derandomize=os.environ.get("CI") == "true"
)
hypothesis.settings.load_profile("project")
SYSTEM = ("workflow/cluster", "faults", "workflow")
"""Directories of tests that start the whole workflow."""
LATER = ("docs", "theory", "configuration", "test_packaging.py", "verification")
LONG = ("test_random_faults.py", *SYSTEM, *LATER)
"""What is begun first, by the time that its longest file takes; all others take less."""


@pytest.fixture
def square(monkeypatch):
    """The state evolves by a law that is not the project's."""
    import square_evolution  # and numpy with it, after OPENBLAS_NUM_THREADS is set

    monkeypatch.setattr("nucleation.model.friction.Friction.evolution_law", square_evolution)


@pytest.hookimpl(tryfirst=True)  # marks are chosen from afterwards
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    items.sort(key=lambda item: _rank(item.path))  # within a rank the order stays
    for item in items:
        if _rank(item.path) in map(LONG.index, SYSTEM):
            item.add_marker("system")


@functools.cache
def _rank(path: Path) -> int:
    own = path.relative_to(Path(__file__).parent)
    return next((rank for rank, name in enumerate(LONG) if own.is_relative_to(name)), len(LONG))
