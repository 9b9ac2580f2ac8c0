"""How much there is to read: lines and words of what git tracks, against what is allowed.

It ends with status 1 if a budget is exceeded.
"""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUDGETS = {
    "lines of src, workflow and Snakefile": (29_000, ["src", "workflow", "Snakefile"]),
    "lines of tests": (19_000, ["tests"]),
    "words of docs/**/*.md and README.md": (30_000, ["docs/*.md", "README.md"]),
}
"""What is counted, the most that is allowed, and the files as git names them."""


def tracked(patterns: list[str], root: Path = ROOT) -> list[Path]:
    """The files that git tracks and that are there."""
    command = ["git", "-C", str(root), "ls-files", "-z", "--", *patterns]
    names = subprocess.run(command, capture_output=True, check=True, text=True).stdout.split("\0")
    return [root / name for name in names if name and (root / name).is_file()]


def weight(what: str, patterns: list[str], root: Path = ROOT) -> int:
    """Lines or words, whichever is asked for, in the files of some patterns."""
    contents = [path.read_bytes() for path in tracked(patterns, root)]
    lines = what.startswith("lines")
    return sum(text.count(b"\n") if lines else len(text.split()) for text in contents)


def main() -> bool:
    """Print all weights; whether each is within its budget."""
    found = {what: weight(what, patterns) for what, (_, patterns) in BUDGETS.items()}
    for what, count in found.items():
        print(f"{count:6} of {BUDGETS[what][0]} {what}")
    return all(count <= BUDGETS[what][0] for what, count in found.items())


if __name__ == "__main__":
    sys.exit(not main())
