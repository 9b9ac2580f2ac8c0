"""Symbols in the words of claims, typeset: ``L_c^M`` and ``sigma0`` as mathematics.

Statements are written as plain text, which CSV and terminals show. Here the symbols in them become
MathML for pages, and mathematics between dollars for Markdown.
"""

from __future__ import annotations

import html
import re
from collections.abc import Callable

GREEK = ("mu", "nu", "zeta", "beta", "phi", "eta", "psi", "Lambda", "lambda", "rho", "omega", "pi")

LETTERS = (
    "L_c", "k_c", "K_c", "c_s", "G1", "G2", "G_1", "G_2", "f0", "v0", "f_d", "F_N", "H", "L", "V",
    "D", "M", "k", "kH", "Hk", "ell", "sigma0", "sigma_yy", "sigma_xy", "dphi/dt",
)  # fmt: skip
"""Symbols beside the Greek letters; ``a`` and ``f`` are such next to others alone."""

TEX = {
    "ell": r"\ell", "sigma0": r"\sigma_0", "sigma_yy": r"\sigma_{yy}", "sigma_xy": r"\sigma_{xy}",
    "G1": "G_1", "G2": "G_2", "f0": "f_0", "v0": "v_0", "F_N": "F_N", "dphi/dt": r"\dot\phi",
} | {name: f"\\{name}" for name in GREEK}  # fmt: skip

NAMES = sorted({*GREEK, *LETTERS}, key=len, reverse=True)
SYMBOL = re.compile(rf"(?<![\w'.])({'|'.join(map(re.escape, NAMES))})(?:\^(\w))?(?![\w'])")
WORDS = re.compile(
    r"(?<![\w'])a(?= (?:zeta|ell|sigma0|Lambda)\b| ?[=)+])|(?<=/)a\b|(?<![\w'])f(?= beta)|"
    r"(?<![\w'])v(?![\w'^])"
)
"""Symbols that are words too, told by what stands beside them."""
SIGNS = {"->": "→", ">>": "≫", "sqrt(": "√(", "sqrt{": "√{"}


def as_html(text: str) -> str:
    """A text as HTML with its symbols in MathML, which browsers show without any script."""
    return _typeset(html.escape(text, quote=False).replace("&gt;", ">"), _mathml)


def as_markdown(text: str) -> str:
    """A text as Markdown with its symbols between dollars; all else is escaped."""
    return _typeset(text, lambda tex: f"${tex}$", _escaped)


def _typeset(
    text: str, symbol: Callable[[str], str], plain: Callable[[str], str] = lambda part: part
) -> str:
    for sign, character in SIGNS.items():
        text = text.replace(sign, character)
    found = [*SYMBOL.finditer(text), *WORDS.finditer(text)]
    parts, end = [], 0
    for match in sorted(found, key=lambda match: match.start()):
        groups = match.groups() or (match[0], None)
        tex = TEX.get(groups[0], groups[0]) + (f"^{groups[1]}" if groups[1] else "")
        parts += [plain(text[end : match.start()]), symbol(tex)]
        end = match.end()
    return "".join([*parts, plain(text[end:])])


def _mathml(tex: str) -> str:
    """A symbol in LaTeX as MathML: a letter with its indices."""
    base, _, power = tex.partition("^")
    base, _, index = base.partition("_")
    dotted = base.startswith(r"\dot")
    name = base.removeprefix(r"\dot").removeprefix("\\")
    letter = f"<mi>{UNICODE.get(name, name)}</mi>"
    if dotted:
        letter = f"<mover>{letter}<mo>˙</mo></mover>"
    index = index.strip("{}")
    low = f"<mn>{index}</mn>" if index.isdigit() else f"<mi>{index}</mi>"
    if index and power:
        letter = f"<msubsup>{letter}{low}<mi>{power}</mi></msubsup>"
    elif index:
        letter = f"<msub>{letter}{low}</msub>"
    elif power:
        letter = f"<msup>{letter}<mi>{power}</mi></msup>"
    return f"<math>{letter}</math>"


UNICODE = {
    "mu": "μ", "nu": "ν", "zeta": "ζ", "beta": "β", "phi": "φ", "eta": "η", "psi": "ψ", "pi": "π",
    "Lambda": "Λ", "lambda": "λ", "rho": "ρ", "omega": "ω", "ell": "ℓ", "sigma": "σ",
}  # fmt: skip


def _escaped(text: str) -> str:
    """Plain text of a cell of a Markdown table."""
    return re.sub(r"([|*_$])", r"\\\1", text).replace("\n", " ")
