"""A report on a small run, and a browser that opens it."""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from coarse_run import CONFIG
from once import once

from nucleation.datasets import provenance
from nucleation.pictures import style
from nucleation.theory.curves import Curves, theory_dataset
from replication.figures import catalogue
from replication.figures.paper import figure_2
from replication.report import encode, page, stability

ROOT = Path(__file__).parents[2]
PATCH_TABLES = ROOT / "results" / "reference" / "patch_tables.json"
MISSING = "chromium is missing: workflow/install-debian.sh browser"
CLAIMS = [
    {"id": "onset", "where": "Fig. S2", "statement": "It runs away after 13 s.", "paper": "13",
     "ours": 12.78, "uncertainty": [12.78, 12.87], "unit": "s", "verdict": "replicated",
     "reason": "Inside.", "quotation": "<b>13 s</b>", "method": "The force's drop."},
    {"id": "ratio", "where": "Eq. (6)", "statement": "Larger than by springs.", "paper": "2.36",
     "ours": 2.356, "uncertainty": [2.356, 2.356], "unit": "1",
     "verdict": "replicated with a deviation that is explained", "reason": "Rounded.",
     "quotation": "", "method": "A formula."},
    {"id": "open", "where": "Sect. 5", "statement": "Nobody knows.", "paper": None, "ours": None,
     "uncertainty": None, "unit": "1", "verdict": "cannot be checked", "reason": "No number.",
     "quotation": "", "method": "None."},
    {"id": "wrong", "where": "Fig. 3", "statement": "It is 100 m.", "paper": "100", "ours": 9.0,
     "uncertainty": [8.0, 11.0], "unit": "m", "verdict": "not replicated", "reason": "Far off.",
     "quotation": "", "method": "A ruler."},
]  # fmt: skip


@pytest.fixture(scope="session")
def content(settings, table, tmp_path_factory):
    """A report with all sections."""
    theory = theory_dataset(
        settings.base.material,
        settings.base.friction,
        settings.main_text_interface,
        Curves(heights=tuple(np.geomspace(0.004, 0.1, 5))),
    )
    stem = tmp_path_factory.mktemp("figures") / "figure_2"
    pdf, png = style.save(figure_2.draw(theory), stem)
    entry = catalogue.FIGURES["figure_2"]
    caption = (ROOT / "workflow" / "report" / "figure_2.rst").read_text(encoding="utf-8")
    results = {"theory": theory, "lengths": table}
    caption = encode.caption_html(caption, {})
    return dict(
        fault={
            "shear_modulus": 3.1e9, "poisson_ratio": 1.0 / 3.0, "plane": "strain", "height": 0.1,
            "normal_stress": 1e6, "a": 0.0068, "b": 0.0228, "slip_distance": 5e-7, "friction": 0.41,
            "velocity": 1e-5,
        },
        friction=settings.base.friction,
        config=CONFIG,
        origin=provenance.attributes(CONFIG, "0" * 64, "none"),
        results=results,
        pictures=[page.picture("figure_2", entry, [png, pdf], caption, results)],
        patch_tables=PATCH_TABLES,
        claims=CLAIMS,
        studies={},
        warnings={},
    )  # fmt: skip


@pytest.fixture(scope="session")
def report(content, tmp_path_factory) -> Path:
    """The report as a file."""
    path = tmp_path_factory.mktemp("report") / "report.html"
    path.write_text(page.build(**content), encoding="utf-8")
    return path


@pytest.fixture(scope="session", autouse=True)
def tables(tmp_path_factory):
    """The tables of L_s, which take seconds, made once for all workers, if they are asked for."""
    made = stability.in_page

    def write(path):
        path.write_text(json.dumps(made()))

    def read():
        return json.loads(once(tmp_path_factory, "tables.json", write).read_text())

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stability, "in_page", read)
        yield


@pytest.fixture(scope="session")
def browser():
    """A headless Chromium. It may be missing on a developer's machine, but not in CI."""
    program = shutil.which("chromium")
    if program is None and os.environ.get("CI") == "true":
        pytest.fail(MISSING)
    if program is None:
        pytest.skip(MISSING)
    from playwright.sync_api import sync_playwright  # a second, for those who need it

    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield started
        started.close()


class Opened:
    """A page of the browser, with what it asked for and what it complained about."""

    def __init__(self, browser, path: Path, **options) -> None:
        self.page = browser.new_context(**options).new_page()
        self.page.set_default_timeout(60_000)  # ms: the machine may be busy
        self.requests: list[str] = []
        self.complaints: list[str] = []
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.goto(path.as_uri())


@pytest.fixture(scope="session")
def opened(browser, report) -> Opened:
    """The report on a wide screen, opened once."""
    one = Opened(browser, report, viewport={"width": 1280, "height": 900})
    one.page.wait_for_selector("#values dd")
    return one


@pytest.fixture(scope="session")
def open_page(browser):
    """Open another page on a wide screen."""
    return lambda path: Opened(browser, path, viewport={"width": 1280, "height": 900})


@pytest.fixture
def web(opened):
    """The open page; nothing may go wrong in it while a test uses it."""
    yield opened.page
    assert opened.complaints == []


@pytest.fixture
def open_report(browser, report):
    """Open the report once more, on a screen of other properties."""
    made = []

    def open_(**options) -> Opened:
        made.append(Opened(browser, report, **options))
        made[-1].page.wait_for_selector("#values dd")
        return made[-1]

    yield open_
    for one in made:
        one.page.context.close()
