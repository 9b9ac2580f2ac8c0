"""The documentation builds without a warning, tutorials executed, and holds what it should."""

import json
import re
import runpy
import shutil

import pytest
from docs.samples import ROOT

pytestmark = pytest.mark.system

DOCS = ROOT / "docs"
TUTORIALS = sorted((DOCS / "tutorials").glob("*.ipynb"))


def test_every_page_is_in_the_site(site):
    pages = list(DOCS.glob("*.md"))
    assert len(pages) > 14
    for page in pages:
        assert (site / page.relative_to(DOCS).with_suffix(".html")).is_file(), page


def test_figures_of_the_reference_are_there(site):
    """Each on one page at least, those of the paper in the gallery of the results."""
    pages = {path.name: path.read_text() for path in site.glob("*.html")}
    shown = {name: set(re.findall(r'src="_images/([^"]+\.png)"', pages[name])) for name in pages}
    reference = {path.name for path in (ROOT / "results" / "reference").glob("*.png")}
    assert set.union(*shown.values()) >= reference
    papers = {f"figure_{name}.png" for name in ("1", "2", "3", "s1", "s2")}
    assert shown["results.html"] >= papers
    assert all((site / "_images" / name).stat().st_size > 10_000 for name in reference)


@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_tutorial_is_kept_without_outputs_and_executed(site, path):
    notebook = json.loads(path.read_text())
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in code)
    page = (site / "tutorials" / path.with_suffix(".html").name).read_text()
    assert page.count('class="cell_output') >= 4
    assert page.count("<img") + page.count("<svg") >= 2


def test_mathematics_is_shown_without_the_network(site):
    """It needed a script from elsewhere."""
    page = (site / "theory.html").read_text()
    assert page.count("<math ") + page.count("<math>") > 20
    assert "\\(" not in page and "\\[" not in page
    for path in site.rglob("*.html"):
        assert not re.findall(r'<script[^>]+src="https?:', path.read_text()), path


def test_addresses_of_pages_that_are_gone_lead_to_their_content(site):
    """With the heading that an address had; without one to the part that replaces the page."""
    moved = [line.split() for line in (DOCS / "moved.txt").read_text().splitlines()]
    assert len(moved) >= 10
    for old, new in moved:
        assert not (DOCS / f"{old}.md").exists(), old
        stub = (site / f"{old}.html").read_text()
        page, _, heading = new.partition("#")
        assert f'location.replace("{page}.html" + (location.hash || "#{heading}"))' in stub
        assert not heading or f'id="{heading}"' in (site / f"{page}.html").read_text(), new


def test_source_pages_lead_back_to_the_description(site):
    links = 0
    for page in (site / "_modules").rglob("*.html"):
        for link in re.findall(r'class="viewcode-back" href="([^"]+)"', page.read_text()):
            path, _, anchor = link.partition("#")
            assert f'id="{anchor}"' in (page.parent / path).read_text(), (page.name, link)
            links += 1
    assert links > 200


def test_reading_the_settings_removes_no_page(tmp_path):
    """Tests of the pages import conf.py while the site is built."""
    page = tmp_path / "docs" / "generated" / "page.rst"
    page.parent.mkdir(parents=True)
    page.touch()
    settings = shutil.copy(DOCS / "conf.py", tmp_path / "docs")
    runpy.run_path(settings)
    assert page.exists()
