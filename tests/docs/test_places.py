"""Files that pages name are where they say; the house is as CONTRIBUTING draws it."""

import re
import tomllib

import pytest
from docs.samples import PAGES, ROOT, samples

SOURCE = ROOT / "src" / "nucleation"
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
COMING = {"fem/pair.py"}
"""Files that a page says will be made."""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_files_exist(page):
    text = page.read_text(encoding="utf-8")
    named = set(re.findall(r"`([\w./-]+/[\w.-]+\.(?:py|smk|edp|html|js|css|md|yaml|sh))`", text))
    made = {sample.file for sample in samples(page)} | COMING
    roots = (ROOT, SOURCE, SOURCE.parent, page.parent)
    missing = {n for n in named - made if not any((root / n).exists() for root in roots)}
    assert {n for n in missing if not n.startswith("results/")} == set()


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
