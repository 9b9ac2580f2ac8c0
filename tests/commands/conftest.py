"""A command line run in this process, or as a program."""

import os
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from nucleation import commands

SOURCE = Path(commands.__file__).parents[2]


class Ended(NamedTuple):
    """What a command line left: exit code, standard output and standard error."""

    code: int
    out: str
    err: str


@pytest.fixture(autouse=True)
def no_terminal(monkeypatch):
    """Lines are not wrapped, whatever the terminal of the tests."""
    monkeypatch.delenv("COLUMNS", raising=False)


@pytest.fixture
def nucleation(capfd):
    """Run a command line, given word by word."""

    def run(*words):
        capfd.readouterr()
        code = commands.run([str(word) for word in words])
        return Ended(code, *capfd.readouterr())

    return run


@pytest.fixture
def program(monkeypatch):
    """The words that start the program of this source tree."""
    path = os.pathsep.join(filter(None, [str(SOURCE), os.environ.get("PYTHONPATH")]))
    monkeypatch.setenv("PYTHONPATH", path)
    return [sys.executable, "-m", "nucleation"]
