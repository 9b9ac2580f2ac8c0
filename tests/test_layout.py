"""Layout is the formatter's alone."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
EXEMPTION = re.compile(r"#\s*fmt:\s*(?:skip|off)")


@pytest.mark.parametrize("folder", ["src", "tests", "benchmarks", "workflow"])
def test_no_line_is_kept_from_the_formatter(folder):
    texts = {path: path.read_text("utf-8") for path in (ROOT / folder).rglob("*.py")}
    assert texts
    assert [path.name for path, text in texts.items() if EXEMPTION.search(text)] == []
