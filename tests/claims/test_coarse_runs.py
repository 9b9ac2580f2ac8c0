"""Sentences about a configuration with few, coarse runs: true, and left out without a number."""

import re

import numpy as np
import pytest
from reference_evidence import ROOT, evaluate, evidence

from replication.claims import evidence as phrases
from replication.claims.table import render
from replication.claims.verdicts import Verdict

TEMPLATE = (ROOT / "docs" / "article.md.in").read_text(encoding="utf-8")
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


@pytest.fixture(scope="module")
def claims(few):
    return evaluate(evidence(lengths=few))


def assert_reads_well(text):
    assert "the paper's mesh" not in text
    assert not re.search(r"([-\d.]+) to \1(?!\S)", text)
    assert not re.search(r"\b(is|are) (cannot|not computed|nan|–)", text)
    assert not re.search(r"(?<!\d)1 (realisations|runs)|all 1\b|mean of 1\b|0 of 1\b", text)
    assert "None" not in text and "nan" not in text


@pytest.mark.slow
def test_article_of_coarse_runs(claims, few):
    text = render(TEMPLATE, claims, few, beyond=True)
    prose = "\n".join(line for line in text.splitlines() if not line.startswith("|"))
    assert_reads_well(prose)
    assert "numbers are reproduced" not in text and "{{" not in text
    assert "have a mesh of 80 x 10 elements, the paper's 400 x 150." in text
    assert "1 realisation each" in text


@pytest.mark.slow
def test_reasons_of_coarse_runs(claims):
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
