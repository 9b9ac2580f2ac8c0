"""The article has the numbers of the claims and tables, of few and coarse runs, too."""

import json
import re

import jinja2
import numpy as np
import pytest
from reference_evidence import ROOT, evaluate, evaluated, evidence

from replication.claims import evidence as phrases
from replication.claims.table import digits, number_text, render
from replication.claims.verdicts import Verdict

TEMPLATE = (ROOT / "docs" / "article.md.in").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def given():
    return evaluated(), evidence().lengths


@pytest.mark.slow
def test_article_follows_the_numbers(given):
    rows, lengths = given
    text = render(TEMPLATE, rows, lengths)
    assert "{{" not in text and "{%" not in text and "nan" not in text
    assert f"judged {len(rows)} of its statements" in text
    body = re.findall(r"^\| (?:aging|slip) \|.*$", text, re.M)
    assert len(body) == lengths[0].sizes["run"]
    assert all(len(line.split("|")) == 11 for line in body)
    assert "figure_map" not in text and "figure_map" in render(TEMPLATE, rows, lengths, beyond=True)
    changed = json.loads(json.dumps(rows))
    for row in changed:
        if row["id"] == "onset-time":
            row["ours"] = 77.77
    assert "77.77 under a declared" in render(TEMPLATE, changed, lengths)


def test_template_states_no_result_of_its_own():
    """The template's only decimal numbers are parameters of the paper or of a figure."""
    text = re.sub(r"\{[{%#].*?[}%#]\}", "", TEMPLATE, flags=re.S)
    text = re.sub(r"\(https?://\S+\)|\[doi:\S+\]", "", text)
    assert set(re.findall(r"\d+\.\d+", text)) == {"0.005", "0.01", "0.02", "0.05", "0.1"}


@pytest.mark.slow
def test_article_without_runs():
    bare = evaluate(evidence(lengths=(), patches={}))
    text = render(TEMPLATE, bare, [])
    assert "not computed" in text and "no such run" in text
    assert len(text) > 3000


def test_formulas_of_claims_are_typeset(given):
    text = render("{{ claim('stability-lost-at-length').statement | typeset }}", *given)
    assert text == "The creep patch loses its stability when its length is $L_c = 2 \\pi/k_c$."


def test_unknown_name_is_an_error(given):
    with pytest.raises(jinja2.UndefinedError):
        render("{{ nonsense }}", *given)
    with pytest.raises(KeyError):
        render("{{ claim('nonsense').ours }}", *given)


def test_numbers_with_their_range():
    row = {"ours": -0.00342, "uncertainty": (-0.0067, 0.0755), "unit": "1"}
    assert number_text(row) == "-0.00342 (-0.0067 to 0.0755)"
    row = {"ours": 0.16201, "uncertainty": (0.16201, 0.16201), "unit": "m"}
    assert number_text(row) == "0.162 m" and digits(1e-5, 1) == "$10^{-5}$"
    assert digits(25342, 2) == r"$2.5\times 10^{4}$"


def test_citations_and_references_are_the_same():
    text, _, listed = TEMPLATE.partition("## References")
    entries = re.findall(r"^- ([^,]+),.*?\((\d{4})\)", listed, re.M | re.S)
    assert len(entries) == len(re.findall("^- ", listed, re.M)) > 4
    cited = re.findall(r"([A-Z]\w+)(?: and \w+)?, (\d{4})\b", text)
    assert {*cited, ("Aldam", "2017")} == set(entries)  # the paper itself, by its title


def test_figures_of_the_workflow_are_those_of_the_template():
    shown = re.findall(r"figures/(\w+)\.png", TEMPLATE)
    rules = (ROOT / "workflow/rules/claims.smk").read_text("utf-8")
    named = re.search(r"PAPERS_FIGURES = .*\nFIGURES_BEYOND = .*", rules)[0]
    assert shown == re.findall(r'"(\w+)"', named)


HEIGHTS = [0.005, 0.1]


def coarse(table):
    """One realisation of each fault of some heights, on 80 x 10 elements."""
    chosen = np.isin(table["height"].values, HEIGHTS) & (table["evolution"].values == "aging")
    rows = table.isel(run=np.flatnonzero(chosen))
    _, first = np.unique(rows["fault"].values, return_index=True)
    few = rows.isel(run=np.sort(first))
    return few.assign(n_x=("run", [80] * first.size), n_y=("run", [10] * first.size))


@pytest.fixture(scope="module")
def few():
    """Lengths at two heights for the study on a coarse mesh, at one height for the other."""
    papers, converged = (coarse(table) for table in evidence().lengths)
    return papers, converged.isel(run=np.flatnonzero(converged["height"].values == HEIGHTS[1]))


def assert_reads_well(text):
    assert "the paper's mesh" not in text
    assert not re.search(r"([-\d.]+) to \1(?!\S)", text)
    assert not re.search(r"\b(is|are) (cannot|not computed|nan|–)", text)
    assert not re.search(r"(?<!\d)1 (realisations|runs)|all 1\b|mean of 1\b|0 of 1\b", text)
    assert "None" not in text and "nan" not in text


@pytest.mark.slow
def test_article_of_coarse_runs(few):
    """They are true, and left out without a number."""
    claims = evaluate(evidence(lengths=few))
    text = render(TEMPLATE, claims, few, beyond=True)
    prose = "\n".join(line for line in text.splitlines() if not line.startswith("|"))
    assert_reads_well(prose)
    assert "numbers are reproduced" not in text and "{{" not in text
    assert "have a mesh of 80 x 10 elements, the paper's 400 x 150." in text
    assert "1 realisation each" in text
    for row in claims:
        assert_reads_well(row["reason"])
    by_id = {row["id"]: row for row in claims}
    assert "On a mesh of 80 x 10 elements it holds" in by_id["slow-creep"]["reason"]
    assert by_id["mesh-along"]["verdict"] == Verdict.UNCHECKED
    assert "these runs have another" in by_id["mesh-along"]["reason"]


def test_meshes_and_spans_in_words():
    fine, coarse = {"n_x": 400, "n_y": 150}, {"n_x": 80, "n_y": 10}
    assert phrases.mesh([fine, fine]) == "the paper's mesh" and phrases.caution([fine]) == ""
    assert phrases.mesh([coarse, fine]) == "meshes of 80 x 10 to 400 x 150 elements"
    assert "no results" in phrases.caution([fine, coarse])
    assert phrases.span([np.nan], str) == "" and phrases.span([2.0, 1.0], "{:g}".format) == "1 to 2"
