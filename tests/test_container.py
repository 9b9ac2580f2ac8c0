"""The recipe of the container agrees with the project: what it copies, installs and starts."""

import json
import re
import shlex
from pathlib import Path

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "workflow" / "container"


def instructions():
    """The recipe's instructions: words and arguments, continued lines joined."""
    text = re.sub(r"\\\n\s*", "", (FOLDER / "Dockerfile").read_text())
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return [tuple(line.split(maxsplit=1)) for line in lines]


def copied():
    """What the recipe takes of the checkout."""
    return [
        name
        for word, arguments in instructions()
        if word == "COPY" and "--from" not in arguments
        for name in shlex.split(arguments)[:-1]
    ]


def test_what_is_copied_exists():
    assert [name for name in copied() if not (ROOT / name).exists()] == []


def test_the_workflow_needs_nothing_that_is_not_copied():
    """Files of the checkout that rules name, beside the results."""
    texts = [(ROOT / "Snakefile").read_text()]
    texts += [path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk")]
    place = r'(?:\bours\(|Path\(BASE, )"([^"]+)"\)'
    named = {ROOT / path for text in texts for path in re.findall(place, text)}
    assert named > {ROOT / "docs" / "article.md.in"}
    for path in {path for path in named if path.exists()} | {ROOT / "CITATION.cff"}:
        assert any(path.is_relative_to(ROOT / name) for name in copied()), path


def test_it_runs_as_nobody_of_the_host_and_starts_the_workflow():
    found = dict(instructions())
    assert found["USER"] not in ("root", "0")
    assert {"USER=nucleation", "HOME=/tmp"} <= set(shlex.split(found["ENV"]))
    start = json.loads(found["ENTRYPOINT"])
    assert start[:3] == ["python", "-m", "replication.pipeline.launch"]
    for path in (word for word in start if word.startswith("/opt/nucleation/")):
        assert (ROOT / path.removeprefix("/opt/nucleation/")).exists(), path
