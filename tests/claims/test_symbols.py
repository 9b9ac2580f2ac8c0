"""Symbols in the words of claims, as mathematics; words that look like them stay words."""

import re

import pytest

from nucleation.claims import table
from nucleation.claims.symbols import as_html, as_markdown


@pytest.mark.parametrize(
    ("plain", "typeset"),
    [
        ("G1 = M/(2 mu).", r"$G_1$ = $M$/(2 $\mu$)."),
        ("smaller than L_c^M", "smaller than $L_c^M$"),
        ("f beta = 0.02, zeta/a", r"$f$ $\beta$ = 0.02, $\zeta$/$a$"),
        ("a patch of a run", "a patch of a run"),
        ("a sigma0 and a typical V", r"$a$ $\sigma_0$ and a typical $V$"),
        ("largest |ratio - 1|, theory_x.nc", r"largest \|ratio - 1\|, theory\_x.nc"),
    ],
)
def test_markdown(plain, typeset):
    assert as_markdown(plain) == typeset


def test_html_is_mathml_with_indices_and_nothing_else_unescaped():
    assert as_html("L_c^M < 2 mu & <b>") == (
        "<math><msubsup><mi>L</mi><mi>c</mi><mi>M</mi></msubsup></math> &lt; 2 "
        "<math><mi>μ</mi></math> &amp; &lt;b>"
    )


def test_no_symbol_of_any_claim_is_left_in_letters():
    for claims in table.SUBJECTS.values():
        for claim in claims:
            words = re.sub(r"\$[^$]*\$", "", as_markdown(claim.statement))
            assert not re.findall(r"\b(?:mu|nu|zeta|beta|sigma0|ell|L_c|k_c|G1|G2)\b", words), words
