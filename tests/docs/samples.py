"""The code samples of README and docs: fenced blocks with their language and what stands before.

A sample in Python that is followed by a ``text`` block has to print it.
"""

import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.glob("*.md"))]
FENCE = re.compile(r"^```(?P<language>[^\n]*)\n(?P<code>.*?)^```$", re.M | re.S)


class Sample(NamedTuple):
    """One fenced block of a page."""

    language: str
    code: str
    line: int  # of its first line of code
    file: str  # named right before it, as in "... `path`:", or ""


def samples(page: Path) -> list[Sample]:
    """All fenced blocks of a page, in order."""
    text = page.read_text(encoding="utf-8")
    return [
        Sample(
            match["language"].strip(),
            match["code"],
            text.count("\n", 0, match.start("code")) + 1,
            _file_named(text[: match.start()]),
        )
        for match in FENCE.finditer(text)
    ]


def _file_named(before: str) -> str:
    match = re.search(r"`([\w./-]+\.(?:py|smk|yaml))`:\n\n$", before)
    return match[1] if match else ""


def printed(blocks: list[Sample]) -> Iterator[tuple[Sample, str | None]]:
    """Samples in Python to be run on this page, each with what it has to print, if stated."""
    for block, after in pairwise([*blocks, None]):
        if block.language == "python" and not block.file:
            states = after is not None and after.language == "text"
            yield block, after.code if states else None


def commands(blocks: list[Sample]) -> Iterator[tuple[int, str]]:
    """The commands of the shell samples, continued lines joined and remarks left out.

    A ``console`` block is a transcript, with what the command prints, run by
    tests/commands/test_command_line_page.py.
    """
    for block in blocks:
        if block.language in ("sh", "bash", "shell"):
            joined = block.code.replace("\\\n", " ")
            for number, line in enumerate(joined.splitlines()):
                command = re.sub(r"(^|\s+)#.*", "", line).strip()
                if command:
                    yield block.line + number, command
