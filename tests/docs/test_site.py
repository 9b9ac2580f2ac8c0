"""The documentation builds without a warning, tutorials executed, and holds what it should.

Its calculator is opened in a real browser, against the library.
"""

import json
import os
import re
import runpy
import shutil
import subprocess
import sys

import numpy as np
import pytest
from docs.samples import ROOT

from nucleation.api import Fault

pytestmark = pytest.mark.system

DOCS = ROOT / "docs"
MISSING = "chromium is missing: workflow/install-debian.sh browser"
TUTORIALS = sorted((DOCS / "tutorials").glob("*.ipynb"))


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The built site, by the command of `make docs`."""
    makefile = (ROOT / "Makefile").read_text()
    recipe = re.search(r"^docs:.*\n\t\$\(BIN\)/sphinx-build (-W .*)$", makefile, re.M)[1]
    built = tmp_path_factory.mktemp("site")
    options = recipe.replace("docs/_build/html", str(built)).split()
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", *options],
        cwd=ROOT,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=1500,
    )
    assert done.returncode == 0, done.stdout
    return built


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


@pytest.fixture(scope="module")
def opened(site):
    """The page of the built site in a headless Chromium, and what went wrong in it."""
    program = shutil.which("chromium")
    if program is None and os.environ.get("CI") == "true":
        pytest.fail(MISSING)
    if program is None:
        pytest.skip(MISSING)
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        page, complaints = browser.new_page(), []
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("request", lambda request: complaints.append(request.url))
        page.goto((site / "calculator.html").as_uri())
        assert complaints.pop(0) == page.url.partition("#")[0]  # nothing else is loaded
        yield page, complaints
        browser.close()


def computed(opened, fault):
    """What the page computes of a fault in its form."""
    words = {k: v for k, v in fault.items() if not k.startswith("second_") and v != np.inf}
    words["second_body"] = "same"
    if "second_shear_modulus" in fault:
        rigid = fault["second_shear_modulus"] == np.inf
        words["second_body"] = "rigid" if rigid else "other"
        if not rigid:
            words |= {k: v for k, v in fault.items() if k.startswith("second_") and v != np.inf}
    page, complaints = opened
    page.evaluate("form.reset()")
    page.evaluate("given => { for (const k in given) form.elements[k].value = given[k] }", words)
    page.evaluate("show()")
    found = page.evaluate("answer()")
    assert found["wrong"] == []
    complaints.clear()
    return found


def random_faults(number, bodies, seed):
    """Layers and half-spaces that weaken."""
    random = np.random.default_rng(seed)
    for _ in range(number):
        a = random.uniform(0.002, 0.006)
        fault = {
            "shear_modulus": 10.0 ** random.uniform(9, 11),
            "a": a,
            "b": a * (1.0 + 0.4 * 100.0 ** random.uniform(0.05, 0.95)),
            "poisson_ratio": random.uniform(0.0, 0.49),
            "normal_stress": 10.0 ** random.uniform(6, 8),
            "friction": random.uniform(0.05, 0.9),
            "slip_distance": 10.0 ** random.uniform(-6, -4),
            "height": random.choice([np.inf, 10.0 ** random.uniform(-2, 2)]),
        }
        if bodies == "rigid":
            fault["second_shear_modulus"] = np.inf
        if bodies == "other":
            fault["second_shear_modulus"] = fault["shear_modulus"] * 10.0 ** random.uniform(-1, 1)
            fault["second_poisson_ratio"] = random.uniform(0.0, 0.49)
            fault["second_height"] = random.choice([np.inf, 10.0 ** random.uniform(-2, 2)])
        yield {k: float(v) for k, v in fault.items()}


@pytest.mark.parametrize("bodies", ["same", "rigid", "other"])
def test_lengths_are_those_of_the_library(opened, bodies):
    known = 0
    for given in random_faults(15, bodies, 3):
        found, fault = computed(opened, given), Fault(**given)
        assert found["critical"] == pytest.approx(float(fault.critical_length()), rel=1e-8), given
        if found["stability"] is not None:
            known += 1
            expected = float(fault.stability_length())
            assert found["stability"] == pytest.approx(expected, rel=0.02), given
    assert known > (12 if bodies != "other" else 1)


def test_lengths_are_shown_with_their_unit_and_kept_in_the_address(opened):
    computed(opened, {})
    page, complaints = opened
    assert page.inner_text("#critical") == "2.513 m" and page.inner_text("#stability") == "1.947 m"
    page.fill("[name=normal_stress]", "100 MPa")
    assert page.inner_text("#critical") == "1.257 m"
    address = page.url
    assert "normal_stress=100+MPa" in address
    page.goto("about:blank")
    page.goto(address)
    assert page.inner_text("#critical") == "1.257 m"
    page.select_option("[name=second_body]", "other")
    assert page.is_visible("[name=second_height]")
    assert "not in these tables" not in page.inner_text("#stability")  # half-spaces
    page.fill("[name=second_height]", "1 m")
    assert "nucleation length computes it" in page.inner_text("#stability")
    complaints.clear()


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("shear_modulus", "", "Shear modulus μ must lie in [1, 1e15] Pa"),
        ("shear_modulus", "2,5 GPa", "write a decimal point in place of the comma"),
        ("shear_modulus", "30 mm", "Shear modulus μ must lie in [1, 1e15] Pa"),
        ("poisson_ratio", "0.6", "Poisson's ratio ν must lie in [-0.99, 0.49]"),
        ("b", "0.009", "b must exceed a"),
    ],
)
def test_bad_values_have_no_result(opened, name, text, said):
    computed(opened, {})
    page, complaints = opened
    page.fill(f"[name={name}]", text)
    assert said in page.inner_text("#wrong")
    assert page.inner_text("#critical") == page.inner_text("#stability") == ""
    complaints.clear()
