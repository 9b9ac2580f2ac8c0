"""docs/command_line.md: its examples, run one after another, print what the page says."""

import doctest
import re
import shlex
from pathlib import Path

import pytest

from nucleation import commands

pytestmark = pytest.mark.system

PAGE = Path(__file__).parents[2] / "docs" / "command_line.md"
CHECKER = doctest.OutputChecker()


def examples():
    """Command lines of the page, continued lines joined, and the output that it shows."""
    for block in re.findall(r"```console\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL):
        command, _, output = block.replace("\\\n", " ").partition("\n")
        yield command.removeprefix("$ nucleation "), output


def test_examples(nucleation, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = PAGE.read_text(encoding="utf-8")
    (file,) = re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)
    Path("fault.yaml").write_text(file)
    found = list(examples())
    assert len(found) == 7
    for command, output in found:
        ended = nucleation(*shlex.split(command))
        said = re.sub(r"^step \d.*\n", "", ended.out + ended.err, flags=re.MULTILINE)
        assert CHECKER.check_output(output, said, doctest.ELLIPSIS), f"{command}\n{said}"
    assert Path("run.png").stat().st_size > 10000


def test_exit_codes_of_the_page():
    table = re.findall(r"^\| (\d+) \| (.*) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    assert len(table) == 5
    for code, meaning in table:
        assert re.search(rf"^  {code} +{re.escape(meaning)}$", commands.EXIT_CODES, re.MULTILINE)
