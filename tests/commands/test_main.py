"""The command as a whole: help, version, completion, exit codes."""

import shlex
import subprocess

import pytest
from click.shell_completion import ShellComplete

from nucleation import __version__, commands


@pytest.mark.parametrize("words", [[], ["length"], ["simulate"], ["show"]])
def test_help(nucleation, words):
    ended = nucleation(*words, "--help")
    assert (ended.code, ended.err) == (0, "") and "Exit codes:" in ended.out
    assert len(ended.out.splitlines()) > 12


def test_version(nucleation):
    assert nucleation("--version").out == f"nucleation, version {__version__}\n"


def test_completion():
    """The shell's completion knows commands and options."""
    shell = ShellComplete(commands.main, {}, "nucleation", "_NUCLEATION_COMPLETE")

    def complete(*words):
        return [item.value for item in shell.get_completions(list(words[:-1]), words[-1])]

    assert complete("le") == ["length"]
    assert "--shear-modulus" in complete("length", "--sh")


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        (OSError(28, "No space left", "run.nc"), 2, "Error: run.nc: No space left\n"),
        (MemoryError(), 2, "Error: not enough memory\n"),
        (KeyboardInterrupt(), commands.INTERRUPTED, "\nInterrupted\n"),
    ],
)
def test_what_the_system_refuses(nucleation, monkeypatch, error, code, words):
    def failing(*_, **__):
        raise error

    monkeypatch.setattr("nucleation.datasets.netcdf.read", failing)
    ended = nucleation("show", __file__)
    assert (ended.code, ended.err) == (code, words)


@pytest.mark.system
def test_a_reader_that_leaves_is_no_failure_with_a_traceback(program):
    ended = subprocess.run(
        f"{shlex.join(program)} simulate --help | head -1",
        shell=True, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ended.stdout.startswith("Usage") and ended.stderr == ""
