"""The report of studies of one's own: it begins with them, with a table of their faults."""

import re

import numpy as np
import pytest
import xarray as xr

from replication.figures import catalogue
from replication.report import page, tables

STUDIES = {"mine": "granite"}
WARNINGS = {"mine": ["mesh too coarse (x): by far"]}


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
    figure = {**content["pictures"][0], "name": "study_mine", "category": catalogue.OWN}
    results = {**content["results"], "lengths": two_faults}
    own = {"claims": [], "pictures": [figure], "results": results}
    return page.build(**{**content, **own, "studies": STUDIES, "warnings": WARNINGS})


@pytest.mark.slow
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
    first, second = tables.faults(two_faults)
    assert (first.number, second.number) == (1, 2)
    assert second.values["shear_modulus"] == 3e10
    pair = two_faults.assign(below=("run", ["deformable"] * 2), shear_modulus=("run", [3e9] * 2))
    assert len(tables.faults(pair.assign(n_x=("run", [8, 9])))) == 1
    for changes in ({"far_side": ["free", "clamped"]}, {"second_shear_modulus": [3e9, 9e9]}):
        other = pair.assign({name: ("run", values) for name, values in changes.items()})
        assert len(tables.faults(other)) == 2
