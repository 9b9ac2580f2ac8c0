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
GRANITE = ("shear_modulus", "poisson_ratio", "normal_stress", "a", "b", "slip_distance", "friction")
STATED = 0.01 * float(re.search(r"by (\d+) % at most", (DOCS / "calculator.md").read_text())[1])
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
def browser():
    """A headless Chromium."""
    program = shutil.which("chromium")
    if program is None and os.environ.get("CI") == "true":
        pytest.fail(MISSING)
    if program is None:
        pytest.skip(MISSING)
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield started
        started.close()


@pytest.fixture(scope="module")
def opened(site, browser):
    """The calculator of the built site, and what went wrong in it."""
    page, complaints = browser.new_page(), []
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: complaints.append(request.url))
    page.goto((site / "calculator.html").as_uri())
    assert complaints and all(url.startswith(site.as_uri()) for url in complaints)  # no network
    complaints.clear()
    return page, complaints


def computed(opened, fault, strength=1e-4):
    """What the page computes of a fault in its form."""
    words = {name: "inf" if value == np.inf else value for name, value in fault.items()}
    if words.get("second_shear_modulus") == "inf":
        words["second_body"] = "rigid"
    page, complaints = opened
    page.evaluate("form.reset()")
    page.evaluate(
        "given => { for (const k in given) form.elements[k].value = given[k] }",
        words | {"strength": strength},
    )
    page.evaluate("update()")
    found = page.evaluate("answer()")
    assert found["wrong"] == []
    assert not any("error" in text.lower() for text in complaints), complaints
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
        zone = fault.lengths("none")["process_zone"].value
        assert found["zone"] == pytest.approx(float(zone), rel=1e-8), given
        if found["stability"] is not None:
            known += 1
            expected = float(fault.stability_length())
            assert found["stability"] == pytest.approx(expected, rel=0.02), given
    assert known > (12 if bodies != "other" else 1)


def faults_of_the_tables(number, bodies, seed):
    """Faults of which the page has L, each with a strength of the load's noise."""
    random = np.random.default_rng(seed)
    least, nu, f = (0.2, (0.0, 0.49), (0.1, 0.9))
    if bodies == "rigid":
        least, nu, f = (0.4, (0.15, 0.45), (0.05, 0.85))
    for _ in range(number):
        friction, over = random.uniform(*f), random.uniform(30.0, 200.0)
        a = friction / over
        fault = {
            "shear_modulus": 1e9,
            "a": a,
            "b": a * (1.0 + np.exp(random.uniform(np.log(least), np.log(6.0)))),
            "poisson_ratio": random.uniform(*nu),
            "normal_stress": 1e6,
            "friction": friction,
            "slip_distance": 1e-6,
            "height": random.choice([np.inf, 10.0 ** random.uniform(-4, 1)]),
        }
        if bodies == "rigid":
            fault["second_shear_modulus"] = np.inf
        noise = np.exp(random.uniform(np.log(6e-4), np.log(2e-2)))
        yield {k: float(v) for k, v in fault.items()}, float(noise / over)


@pytest.mark.parametrize("bodies", ["same", "rigid"])
def test_length_at_which_the_patch_runs_away_is_that_of_the_library(opened, bodies):
    known = 0
    for given, strength in faults_of_the_tables(8, bodies, 5):
        found = computed(opened, given, strength)["drop"]
        expected = Fault(**given).lengths(strength=strength)["drop_length"]
        if found is None:
            continue
        known += 1
        assert expected.doubt == "", given
        for end in ("value", "low", "high"):
            stated = pytest.approx(getattr(expected, end), rel=STATED)
            assert found[end] == stated, (end, given, strength)
    assert known > 4


def test_answer_comes_first_in_the_words_of_the_library(opened):
    """The page's fault is that of README, with a friction coefficient."""
    computed(opened, {})
    page, _ = opened
    granite = {name: page.input_value(f"[name={name}]") for name in GRANITE}
    found = Fault(**granite).lengths()
    words = re.compile(r"[\d.]+(?= m| to)")
    assert words.sub("", page.inner_text("#sentence")) == words.sub("", found.sentence)
    assert page.inner_text("#remark") == " ".join(found.remarks)
    rows = [text.split("\t")[0] for text in page.inner_text("#answers tbody").splitlines()]
    assert rows == ["L", "L_s", "L_c", "L_run", "L_pz"]


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"second_shear_modulus": np.inf, "height": 0.5},
        {"second_shear_modulus": 1e10, "second_height": 1.0},
    ],
    ids=["alike", "rigid", "other"],
)
def test_command_below_the_answer_is_for_the_same_fault(opened, changes):
    found = computed(opened, changes)
    page, _ = opened
    shown = page.inner_text("#command").split()
    assert shown[:2] == ["nucleation", "length"]
    program = [sys.executable, "-m", "nucleation", "length", *shown[2:], "--json"]
    done = json.loads(subprocess.run(program, capture_output=True, text=True, check=True).stdout)
    lengths = {one["key"]: one for one in done["lengths"]}
    assert found["critical"] == pytest.approx(lengths["critical_length"]["value"], rel=1e-8)
    assert page.inner_text("#setting") in " ".join(done["system"])


@pytest.mark.parametrize(
    ("name", "text"),
    [("second_shear_modulus", "10 GPa"), ("a", "0.001"), ("strength", "1e-2"), ("b", "0.2")],
)
def test_length_that_no_table_has_is_left_to_the_command(opened, name, text):
    computed(opened, {})
    page, _ = opened
    page.fill(f"[name={name}]", text)
    assert "use the command below" in page.inner_text("#sentence")
    assert "use the command" in page.inner_text("#drop_length")
    assert page.inner_text("#command").startswith("nucleation length --shear-modulus 30GPa")


def test_lengths_are_shown_with_their_unit_and_kept_in_the_address(opened):
    computed(opened, {})
    page, complaints = opened
    cell = "#critical_length td:nth-child(2)"
    assert page.inner_text(cell) == "2.513 m"
    assert page.inner_text("#stability_length td:nth-child(2)") == "1.946 m"  # the library: 1.947
    page.fill("[name=normal_stress]", "100 MPa")
    assert page.inner_text(cell) == "1.257 m"
    address = page.url
    assert "normal_stress=100+MPa" in address
    page.goto("about:blank")
    page.goto(f"{address}&length=1&unknown=2")
    assert page.inner_text(cell) == "1.257 m"
    page.select_option("[name=second_body]", "rigid")
    assert not page.is_visible("[name=second_height]")
    complaints.clear()


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("shear_modulus", "", "shear modulus must lie in [1e-09, 1e+13) Pa; it is missing"),
        ("shear_modulus", "abc", "it is no number with a unit"),
        ("a", "1e", "e is no unit that is known here, it has none"),
        ("shear_modulus", "2,5 GPa", "write a decimal point in place of the comma"),
        ("shear_modulus", "30 mm", "mm is no unit that is known here: Pa, kPa, MPa, GPa"),
        ("shear_modulus", "30 toString", "toString is no unit"),
        ("poisson_ratio", "0.6", "Poisson's ratio must lie in (-1, 0.5)"),
        ("strength", "1", "must lie in [0, 0.1]"),
        ("b", "0.009", "b must exceed a"),
    ],
)
def test_bad_values_have_no_result(opened, name, text, said):
    computed(opened, {})
    page, _ = opened
    page.fill(f"[name={name}]", text)
    wrong = page.inner_text("#wrong")
    assert said in wrong and (name in wrong.split(" = ")[0] or name == "b")
    for own in ("#sentence", "#remark", "#setting", "#command", "#answers tbody"):
        assert page.inner_text(own) == ""


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_calculator_is_readable_in_either_scheme_and_on_a_phone(site, browser, scheme, width):
    """A page of the site: with its sidebar and way home, nothing wider than the screen."""
    page = browser.new_page(color_scheme=scheme, viewport={"width": width, "height": 900})
    page.goto((site / "calculator.html").as_uri())
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert page.locator(".sidebar-tree a", has_text="Calculator").count() == 1
    assert page.locator('a[href="index.html"]').count() > 0
    for own in ("#fault input[name=a]", "#sentence"):
        ground, ink = page.evaluate(COLOURS, own)
        assert contrast(ground, ink) > 4.5
    ground, _ = page.evaluate(COLOURS, "#fault input[name=a]")
    assert (luminance(ground) < 0.2) == (scheme == "dark")
    page.close()


COLOURS = """own => {
  const element = document.querySelector(own);
  let behind = element;
  const bare = ["rgba(0, 0, 0, 0)", "transparent"];
  while (bare.includes(getComputedStyle(behind).backgroundColor)) behind = behind.parentElement;
  return [getComputedStyle(behind).backgroundColor, getComputedStyle(element).color];
}"""
"""Colours behind and of the text of an element."""


def luminance(colour):
    """Relative luminance of a colour, as WCAG 2 defines it."""
    shares = np.array([float(x) for x in re.findall(r"[\d.]+", colour)[:3]]) / 255.0
    linear = np.where(shares <= 0.03928, shares / 12.92, ((shares + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def contrast(*colours):
    """Contrast of two colours, as WCAG 2 defines it."""
    dark, bright = sorted(map(luminance, colours))
    return (bright + 0.05) / (dark + 0.05)
