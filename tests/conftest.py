"""The order of the tests: files that run for long come first.

Each file is run by one worker (make test). Were a long one begun last, the other core would wait.
"""

from pathlib import Path

import pytest

pytest_plugins = ("coarse_run",)

LONG = ("workflow/cluster", "faults", "workflow", "docs", "verification")
"""Directories by the time that their longest file takes; all others take less."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    items.sort(key=_rank)  # within a rank the order stays


def _rank(item: pytest.Item) -> int:
    path = item.path.relative_to(Path(__file__).parent)
    return next((rank for rank, name in enumerate(LONG) if path.is_relative_to(name)), len(LONG))
