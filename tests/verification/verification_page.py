"""The tables of docs/verification.md."""

from pathlib import Path

PAGE = Path(__file__).parents[2] / "docs" / "verification.md"


def rows(heading):
    """Cells of the rows of the first table below a heading, its head left out."""
    section = PAGE.read_text(encoding="utf-8").split(f"# {heading}\n", 1)[1]
    found = []
    for line in section.splitlines():
        if line.startswith("|"):
            found.append([cell.strip() for cell in line.strip("| ").split("|")])
        elif found:
            break
    return found[2:]
