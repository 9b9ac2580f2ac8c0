"""The article on paper has the text, numbers, figures and formulas of its Markdown."""

import io
import re

import pypdf
import pytest
from reference_evidence import REFERENCE, ROOT

from replication.claims import printing

TEXT = (REFERENCE / "article.md").read_text("utf-8")
SMALL = """# [Re] A title

M. Aldam was first.

## Abstract

Short: $L_c$ falls.

## Results

![Figure 1](figures/figure_1.png)

**Figure 1.** Two of them, $L_s/L_c = 0.5$.

**Table 1.** Numbers.

| H (m) | strength |
|---|---|
| 0.1 | $10^{-5}$ |

See [two bodies](loadings.md#two-deformable-bodies) and [a page](https://example.org), `zeta/a`.

## References

- Aldam, M.
"""


@pytest.fixture(scope="module")
def small():
    return printing.parsed(SMALL, ["A. Author"])


def test_captions_symbols_and_links(small):
    tex = printing.as_tex(small)
    assert r"\title{{[}Re{]} A title}" in tex and r"\author{A. Author}" in tex
    assert re.search(r"begin\{abstract\}\nShort: \\\(L_c\\\) falls", tex)
    assert r"\caption{\textbf{Figure 1.} Two of them, \(L_s/L_c = 0.5\).}" in tex
    assert r"\caption{\textbf{Table 1.} Numbers.}" in tex and r"\(10^{-5}\)" in tex
    assert "See two bodies and \\href{https://example.org}{a page}, \\texttt{zeta/a}" in tex
    assert "M. Aldam" in tex and "Aldam, M." in tex


@pytest.mark.slow
def test_pdf_has_all_pictures_numbers_and_headings():
    pictures = {name: REFERENCE / name for name in re.findall(r"\]\((\w+\.png)\)", TEXT)}
    pdf = printing.as_pdf(printing.parsed(TEXT, ["A. Author"]), pictures)
    pages = pypdf.PdfReader(io.BytesIO(pdf)).pages
    assert sum(len(page.images) for page in pages) == len(pictures) > 4
    words = re.sub(r"\s+", " ", " ".join(page.extract_text() for page in pages))
    assert not re.search(r"\{\{|\{%|\\\\|\$|\*\*", words)
    abstract = TEXT.partition("## Abstract")[2].partition("##")[0]
    table = "\n".join(re.findall(r"^\| (?:aging|slip) .*$", TEXT, re.M))
    for number in re.findall(r"(?<![\w.-])\d+(?:\.\d+)?(?![\w.]*\w)", abstract + table):
        assert number in words, number
    for heading in re.findall(r"^## (.+)$", TEXT, re.M):
        assert heading in words, heading


def test_printed_figures_are_those_of_the_template():
    shown = re.findall(r"figures/(\w+)\.png", (ROOT / "docs/article.md.in").read_text("utf-8"))
    rules = (ROOT / "workflow/rules/claims.smk").read_text("utf-8")
    named = re.findall(r'"(\w+)"', re.search(r"PAPERS_FIGURES = .*\nPRINTED = .*", rules)[0])
    assert shown == named
