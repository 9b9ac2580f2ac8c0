"""The recipe of the container agrees with the project: what it copies, installs and starts."""

import json
import re
import shlex
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "workflow" / "container"


def instructions():
    """The recipe's instructions: words and arguments, continued lines joined."""
    text = re.sub(r"\\\n\s*", "", (FOLDER / "Dockerfile").read_text())
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return [tuple(line.split(maxsplit=1)) for line in lines]


def test_what_is_copied_exists():
    for word, arguments in instructions():
        if word == "COPY" and not arguments.startswith("--from"):
            for name in shlex.split(arguments)[:-1]:
                assert (ROOT / name).exists(), name


def test_the_workflow_needs_nothing_that_is_not_copied(workflow_files):
    copied = [
        name for word, arguments in instructions() if word == "COPY" and "--from" not in arguments
        for name in shlex.split(arguments)[:-1]
    ]  # fmt: skip
    for path in workflow_files:
        name = path.relative_to(ROOT).as_posix()
        assert any(name == part or name.startswith(f"{part}/") for part in copied), name


@pytest.fixture
def workflow_files():
    """Files of the checkout that rules name, beside the results."""
    texts = [(ROOT / "Snakefile").read_text()]
    texts += [path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk")]
    named = {
        Path(ROOT, *re.findall(r'"([^"]+)"', parts))
        for text in texts for parts in re.findall(r'Path\(BASE, ((?:"[^"{]+",? ?)+)\)', text)
    }  # fmt: skip
    assert ROOT / "docs" / "article.md.in" in named and len(named) > 3
    return {path for path in named if path.exists()} | {ROOT / "CITATION.cff"}


def test_it_runs_as_nobody_of_the_host_and_starts_the_workflow():
    found = dict(instructions())
    assert found["USER"] not in ("root", "0")
    assert {"USER=nucleation", "HOME=/tmp"} <= set(shlex.split(found["ENV"]))
    start = json.loads(found["ENTRYPOINT"])
    assert start[:3] == ["python", "-m", "nucleation.pipeline.launch"]
    for path in (word for word in start if word.startswith("/opt/nucleation/")):
        assert (ROOT / path.removeprefix("/opt/nucleation/")).exists(), path
