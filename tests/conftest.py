"""For all tests: their order, what hypothesis does, and why tests were skipped.

Each file is run by one worker (make test). Were a long one begun last, the other core would wait.
"""

import os
from pathlib import Path

import hypothesis
import pytest

pytest_plugins = ("coarse_run",)

# make test hands its own settings (VENV=...) to every make below it
for name in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL"):
    os.environ.pop(name, None)

# No deadline: machines are busy. In CI the same examples at every run, elsewhere new ones.
hypothesis.settings.register_profile(
    "project", deadline=None, max_examples=100, derandomize=os.environ.get("CI") == "true"
)
hypothesis.settings.load_profile("project")

LONG = ("workflow/cluster", "faults", "workflow", "docs", "verification")
"""Directories by the time that their longest file takes; all others take less."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    items.sort(key=_rank)  # within a rank the order stays


def _rank(item: pytest.Item) -> int:
    path = item.path.relative_to(Path(__file__).parent)
    return next((rank for rank, name in enumerate(LONG) if path.is_relative_to(name)), len(LONG))
