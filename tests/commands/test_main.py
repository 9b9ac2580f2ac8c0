"""The command as a whole: help, version, completion, exit codes, and its page's examples."""

import doctest
import re
import shlex
import subprocess
from pathlib import Path

import pytest
from click.shell_completion import ShellComplete
from hypothesis import given
from hypothesis import strategies as st

from nucleation import __version__, commands
from nucleation.commands.text import table
from nucleation.model.quantities import Quantity
from nucleation.model.units import in_unit, parse


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
        shell=True,
        capture_output=True,
        text=True,
        check=False,
    )
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


GRANITE = (
    "--shear-modulus",
    "30GPa",
    "--poisson-ratio",
    "0.25",
    "--a",
    "0.010",
    "--b",
    "0.015",
    "--slip-distance",
    "5um",
    "--height",
    "20cm",
    "--normal-stress",
    "50MPa",
)
MOVED = ("--velocity", "1mm/yr", "--friction", "0.6")
RANGE = ("--friction", "0.6 (0.5 to 0.7)", "--draws", "20")
COMMANDS = {
    "length": ("length", *GRANITE, *MOVED),
    "patch": ("length", *GRANITE, "--outside-zeta", "-0.005", "--width", "1m"),
    "quantiles": ("length", *GRANITE, *RANGE),
    "specimen": ("specimen", "--length", "20cm", *GRANITE),
    "simulate": ("simulate", "x.nc", *GRANITE, *MOVED, "--dry-run"),
    "mistake": ("length", "--shear-modulus", "30um"),
}


@pytest.mark.parametrize("kind", COMMANDS)
def test_lines_fit_and_values_are_as_engineers_write_them(nucleation, monkeypatch, kind):
    """Their words are those of a file."""
    ended = nucleation(*COMMANDS[kind])
    wide = (ended.out + ended.err).splitlines()
    monkeypatch.setenv("COLUMNS", "70")
    narrow = "".join(nucleation(*COMMANDS[kind])[1:]).splitlines()
    assert max(map(len, narrow)) <= 70 and max(map(len, wide)) > 80
    assert sorted(" ".join(narrow).split()) == sorted(" ".join(wide).split())
    if kind in ("length", "specimen", "simulate"):
        for text in ("modulus = 30 GPa", "height = 200 mm", "distance = 5 um", "stress = 50 MPa"):
            assert text in ended.out
        assert not re.search(r"\de[+-]?\d+ (Pa|m)(?![\w/])", ended.out.partition("theory")[0])


def test_the_last_column_of_a_table_wraps(monkeypatch):
    rows = [("L", "2 m", "a meaning " * 9), "and a line", ("L_run", "20 m", "short")]
    assert table(rows)[2] == "  L_run  20 m  short"
    monkeypatch.setenv("COLUMNS", "60")
    lines = table(rows)
    assert max(map(len, lines)) <= 60
    starts = {len(line) - len(line.lstrip()) for line in lines if "meaning" in line}
    assert starts == {2, len("  L_run  20 m  ")}
    numbers = table([("id", "1"), ("b", "200")], right=[1])
    assert numbers == ["  id    1", "  b   200"]


@given(
    value=st.floats(1e-20, 1e20),
    unit=st.sampled_from(["m", "s", "m/s", "Pa", "Pa/s", "Pa/m", "kg/m^3", "1"]),
)
def test_an_engineering_unit_keeps_the_value(value, unit):
    again = parse("value", in_unit(value, unit, digits=6), Quantity("value", unit=unit))
    assert again == pytest.approx(value, rel=1e-5)
