"""The command as a whole: help, version, completion, exit codes, and its page's examples."""

import doctest
import re
import shlex
import subprocess
from pathlib import Path

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


@pytest.mark.parametrize(("error", "code", "words"), [
    (OSError(28, "No space left", "run.nc"), 2, "Error: run.nc: No space left\n"),
    (MemoryError(), 2, "Error: not enough memory\n"),
    (KeyboardInterrupt(), commands.INTERRUPTED, "\nInterrupted\n"),
])  # fmt: skip
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


CHECKER = doctest.OutputChecker()
PAGE = (Path(__file__).parents[2] / "docs" / "command_line.md").read_text(encoding="utf-8")


def examples():
    """Command lines of the page, continued lines joined, and the output that it shows."""
    for block in re.findall(r"```console\n(.*?)```", PAGE, re.DOTALL):
        command, _, output = block.replace("\\\n", " ").partition("\n")
        yield command.removeprefix("$ nucleation "), output


@pytest.mark.system
def test_examples(nucleation, tmp_path, monkeypatch):
    """Run one after another, they print what docs/command_line.md has."""
    monkeypatch.chdir(tmp_path)
    (file,) = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
    Path("fault.yaml").write_text(file)
    found = list(examples())
    assert len(found) == 7
    for command, output in found:
        ended = nucleation(*shlex.split(command))
        said = re.sub(r"^step \d.*\n", "", ended.out + ended.err, flags=re.MULTILINE)
        assert CHECKER.check_output(output, said, doctest.ELLIPSIS), f"{command}\n{said}"
    assert Path("run.png").stat().st_size > 10000


def test_exit_codes_of_the_page():
    table = re.findall(r"^\| (\d+) \| (.*) \|$", PAGE, re.MULTILINE)
    assert len(table) == 5
    for code, meaning in table:
        assert re.search(rf"^  {code} +{re.escape(meaning)}$", commands.EXIT_CODES, re.MULTILINE)
