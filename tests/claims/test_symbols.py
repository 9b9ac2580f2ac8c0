"""Symbols in the words of claims, as mathematics; words that look like them stay words."""

import re
from xml.etree import ElementTree

import pytest

from nucleation.claims import table
from nucleation.claims.symbols import as_html, as_markdown


@pytest.mark.parametrize(
    ("plain", "typeset"),
    [
        ("two have G1 = M/(2 mu).", r"two have $G_1 = M/(2 \mu)$."),
        (
            "eta = pi/(1 - nu), and 2 pi sqrt{2 H/[zeta (1 - nu)]} of it",
            r"$\eta = \pi/(1 - \nu)$, and $2 \pi \sqrt{2 H/[\zeta (1 - \nu)]}$ of it",
        ),
        ("at v = 1e-5 v0 and 2Hk -> 0 (see H)", r"at $v = 10^{-5} v_0$ and $2Hk \to 0$ (see $H$)"),
        ("For H = 0.005 m, 10 % of 4/3", r"For $H = 0.005$ m, 10 % of 4/3"),
        (
            "against |f beta|, |Lambda/Lambda_theory - 1|",
            r"against $\lvert f \beta\rvert$, $\lvert \Lambda/\Lambda_{\mathrm{theory}} - 1\rvert$",
        ),
        ("it is > 1 and < 0, [V (V + Lambda ell)", r"it is > 1 and < 0, [$V (V + \Lambda \ell)$"),
        ("smaller than L_c^M", "smaller than $L_c^M$"),
        ("f beta = 0.02, zeta/a", r"$f \beta = 0.02$, $\zeta/a$"),
        ("a patch of a run", "a patch of a run"),
        ("a sigma0 and a typical V", r"$a \sigma_0$ and a typical $V$"),
        ("largest |ratio - 1|, theory_x.nc", r"largest \|ratio - 1\|, theory\_x.nc"),
    ],
)
def test_markdown(plain, typeset):
    assert as_markdown(plain) == typeset


def test_html_is_mathml_with_indices_and_nothing_else_unescaped():
    assert as_html("L_c^M < 2 mu & <b>") == (
        "<math><msubsup><mi>L</mi><mi>c</mi><mi>M</mi></msubsup><mo>&lt;</mo><mn>2</mn>"
        "<mi>μ</mi></math> &amp; &lt;b>"
    )


def test_roots_and_powers_in_html():
    assert as_html("sqrt(v^2 + v0^2)/V is") == (
        "<math><msqrt><msup><mi>v</mi><mn>2</mn></msup><mo>+</mo>"
        "<msubsup><mi>v</mi><mn>0</mn><mn>2</mn></msubsup></msqrt><mo>/</mo><mi>V</mi></math> is"
    )


@pytest.mark.parametrize("text", ["phi(v) = D is", "|v|/V is"])
def test_brackets_and_bars_are_as_high_as_the_line(text):
    shown = as_html(text)
    assert shown.count('<mo stretchy="false">') == 2 and shown.count("<mo>") <= 1


def test_formulas_of_all_claims_are_well_formed_and_whole():
    """No sign of a formula stands beside one, as when each letter was typeset for itself."""
    for claims in table.SUBJECTS.values():
        for claim in claims:
            for text in (claim.statement, claim.method):
                ElementTree.fromstring(f"<p>{as_html(text)}</p>")
                assert not re.search(r"\$ ?[=/+<]|[=/+] ?\$", as_markdown(text)), text


def test_no_symbol_of_any_claim_is_left_in_letters():
    for claims in table.SUBJECTS.values():
        for claim in claims:
            words = re.sub(r"\$[^$]*\$", "", as_markdown(claim.statement))
            assert not re.findall(r"\b(?:mu|nu|zeta|beta|sigma0|ell|L_c|k_c|G1|G2)\b", words), words
