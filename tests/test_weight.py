"""`make weight` counts what git tracks, and nothing else."""

import runpy
import subprocess
from pathlib import Path

WEIGHT = runpy.run_path(str(Path(__file__).parents[1] / ".ci" / "weight.py"))


def test_what_git_tracks_is_counted(tmp_path):
    def git(*words):
        subprocess.run(["git", "-C", tmp_path, *words], check=True, capture_output=True)

    git("init")
    for name in ("docs/page.md", "docs/below/page.md", "docs/page.py", "own.md", "not_tracked.md"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("two words\n\nand three more\n")
    git("add", "docs", "own.md")
    (tmp_path / "docs/deleted.md").write_text("gone\n")
    git("add", "docs")
    (tmp_path / "docs/deleted.md").unlink()
    assert WEIGHT["weight"]("words", ["docs/*.md"], tmp_path) == 10
    assert WEIGHT["weight"]("lines", ["docs", "own.md"], tmp_path) == 12
