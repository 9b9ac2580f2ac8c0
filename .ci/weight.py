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

WING = 3_000
"""The most lines of one wing."""


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


def wings() -> dict[str, tuple[int, list[str]]]:
    """A budget for each directory of the package."""
    package = ROOT / "src" / "nucleation"
    names = sorted(path.name for path in package.iterdir() if (path / "__init__.py").is_file())
    return {f"lines of src/nucleation/{name}": (WING, [f"src/nucleation/{name}"]) for name in names}


def main() -> bool:
    """Print all weights, of the wings the largest; whether each is within its budget."""
    found = {what: weight(what, patterns) for what, (_, patterns) in BUDGETS.items()}
    of_wings = {what: weight(what, patterns) for what, (_, patterns) in wings().items()}
    largest = max(of_wings, key=of_wings.__getitem__)
    found[largest], BUDGETS[largest] = of_wings[largest], wings()[largest]
    for what, count in found.items():
        print(f"{count:6} of {BUDGETS[what][0]} {what}")
    return all(count <= BUDGETS[what][0] for what, count in found.items())


if __name__ == "__main__":
    sys.exit(not main())
