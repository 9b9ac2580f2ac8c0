"""What pages, docstrings and comments name is there; the house is as CONTRIBUTING draws it."""

import re
import tomllib

import pytest
from docs.samples import FENCE, PAGES, ROOT, samples

from docs import names

SOURCE = ROOT / "src" / "nucleation"
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")


OF_OTHERS = {"sitecustomize.py"}


def stale(find):
    """What pages and sources name and is not there, by file; `find` has a text and its place."""
    found = {}
    for path in (*PAGES, *names.FILES):
        page = path.suffix == ".md" and [(FENCE.sub("", path.read_text(encoding="utf-8")), "")]
        named = {name for text, place in page or names.words(path) for name in find(text, place)}
        roots = (ROOT, SOURCE, SOURCE.parent, ROOT / "docs", ROOT / "tests", path.parent)
        if missing := {name for name in named if not any((r / name).exists() for r in roots)}:
            found[str(path.relative_to(ROOT))] = missing - made_on(path) if page else missing
    return {name: missing for name, missing in found.items() if missing}


def made_on(page):
    """The files that a page has its readers write."""
    return {sample.file for sample in samples(page)}


def test_roles_and_names_with_dots_resolve():
    """Each ``:func:``, ``{class}`` and so on, and each name that begins with the package's."""
    assert stale(lambda text, place: names.stale_roles(text, place)) == {}
    assert stale(lambda text, _: names.stale_dotted(text)) == {}


def test_files_exist():
    """With their folders, and sources by their bare names."""
    known = OF_OTHERS.union(
        p.name for root in (*names.ROOTS, "tests") for p in (ROOT / root).rglob("*.*")
    )

    def named(text, _):
        return {n for n in names.FILE.findall(text) if not n.startswith("results/")} - known

    assert stale(named) == {}


def test_wings_are_those_of_the_contracts():
    """From the roof to the ground, those on one floor in one line."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    (layers,) = (
        contract["layers"]
        for contract in project["tool"]["importlinter"]["contracts"]
        if contract["type"] == "layers"
    )
    floors = [re.findall(r"nucleation\.(\w+)", layer) for layer in layers]
    table = CONTRIBUTING.split("| wing |")[1].split("\n\n")[0]
    rows = re.findall(r"^\| (`.*?`) \|", table, re.M)
    assert [re.findall(r"`(\w+)", row) for row in rows] == floors[1:]  # __main__ stands on the roof
    entries = {
        p.stem for p in SOURCE.iterdir() if p.suffix == ".py" or (p / "__init__.py").exists()
    }
    assert entries == {"__init__"} | {wing for floor in floors for wing in floor}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_linked_pages_exist(page):
    for target in re.findall(r"\]\(([\w./-]+?)(?:#[\w-]*)?\)", page.read_text(encoding="utf-8")):
        assert (page.parent / target).exists(), target
