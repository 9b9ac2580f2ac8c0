"""The report of studies of one's own: it begins with them, each fault with its own theory."""

import dataclasses
import re

import numpy as np
import pytest
import xarray as xr

from nucleation.figures import catalogue
from nucleation.report import answer, faults, page, tables
from nucleation.theory.critical import critical_length

STUDIES = answer.OwnStudies({"mine": "granite"}, {"mine": ["mesh too coarse (x): by far"]})


@pytest.fixture(scope="module")
def two_faults(table):
    """The run of the paper's fault, and one without an event on a stiffer one."""
    stiffer = table.assign(
        id=("run", ["stiff"]), shear_modulus=("run", [3e10]), height=("run", [40.0]),
        onset_time=("run", [np.nan]), length=("run", [np.nan]),
    )  # fmt: skip
    return xr.concat([table, stiffer], dim="run").assign(study=("run", ["mine", "mine"]))


@pytest.fixture(scope="module")
def html(content, two_faults):
    figure = content.pictures[0]._replace(name="study_mine", category=catalogue.OWN)
    results = {**content.results, "lengths": two_faults}
    mine = content._replace(claims=None, pictures=[figure], own=STUDIES, results=results)
    return page.build(mine)


def test_it_begins_with_the_study_and_has_no_verdicts_of_the_paper(html, two_faults):
    headings = re.findall(r"<h2[^>]*>(.*?)</h2>", html)
    assert headings[:2] == ["Study mine", "The 2 faults"]
    answer = re.search(r'<p class="answer"><b>(.*) m</b></p>', html)
    assert answer and float(answer[1]) == pytest.approx(float(two_faults["length"][0]), rel=5e-3)
    assert "What was replicated" not in html and "data-kind=" not in html
    assert "mesh too coarse (x): by far" in html
    assert "1 of 2 runs had no event" in html and "<li>stiff: " in html
    assert html.count('<figure id="study_mine">') == 1
    assert "<title>Critical nucleation lengths: mine</title>" in html


def test_faults_are_told_apart_by_what_the_theory_knows(two_faults):
    first, second = faults.faults(two_faults)
    assert (first.number, second.number) == (1, 2)
    assert second.in_page()["values"]["mu"] == 3e10
    pair = two_faults.assign(below=("run", ["deformable"] * 2), shear_modulus=("run", [3e9] * 2))
    assert len(faults.faults(pair.assign(n_x=("run", [8, 9])))) == 1
    for changes in ({"far_side": ["free", "clamped"]}, {"second_shear_modulus": [3e9, 9e9]}):
        other = pair.assign({name: ("run", values) for name, values in changes.items()})
        assert len(faults.faults(other)) == 2


def test_the_pages_theory_is_not_drawn_for_a_second_block(content, two_faults):
    """It knows of rigid bases alone."""
    pair = two_faults.assign(below=("run", ["rigid", "deformable"]))
    drawn = page._data(content._replace(own=STUDIES), pair)["faults"]
    assert [fault["label"] for fault in drawn] == ["fault 1"]


def test_points_have_the_marker_of_their_fault(two_faults):
    seen = two_faults.assign(length=("run", [0.1, 0.5]))
    looks = {series["name"]: series["symbol"] for series in tables.point_series(seen)}
    assert looks == {"mine, aging law, fault 1": "circle", "mine, aging law, fault 2": "square"}
    assert len({faults.look(n) for n in range(1, 85)}) == 84


def test_curves_reach_the_studies_heights(content, two_faults):
    results = {"lengths": two_faults}
    heights, seen = page._heights(content._replace(own=STUDIES), two_faults)
    assert heights[-1] == pytest.approx(400.0) and seen[1] == pytest.approx(120.0)
    ratios = heights[1:] / heights[:-1]
    assert ratios.max() < 1.02, "a polygon one can see"
    assert page._heights(content._replace(results=results), two_faults)[0] is page.HEIGHTS


@pytest.mark.system
def test_every_fault_has_its_own_theory_in_the_browser(html, browser, settings, tmp_path):
    path = tmp_path / "own.html"
    path.write_text(html, encoding="utf-8")
    for width in (1280, 390):
        web = browser.new_context(viewport={"width": width, "height": 900}).new_page()
        complaints = []
        web.on("pageerror", lambda error, to=complaints: to.append(str(error)))
        web.goto(path.as_uri())
        web.wait_for_selector("#theory-plot .main-svg")
        curves = web.evaluate(
            "() => Object.fromEntries(element('theory-plot').data.map((t) => [t.name, [t.x, t.y]]))"
        )
        material = dataclasses.replace(settings.base.material, shear_modulus=3e10)
        heights, length = (np.array(values)[::40] for values in curves["theory, fault 2"])
        expected = critical_length(heights, material, settings.main_text_interface)
        np.testing.assert_allclose(length, expected, rtol=1e-6)
        assert web.evaluate("document.documentElement.scrollWidth") <= width
        assert complaints == []
