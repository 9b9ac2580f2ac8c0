"""Formulas in the words of claims, typeset: ``L_c^M = pi M ell/(zeta sigma0)`` as mathematics.

Statements are written as plain text, which CSV and terminals show. Here the formulas and symbols in
them become MathML for pages, and mathematics between dollars for Markdown. A formula is what stands
together of symbols, numbers, signs and brackets that close; a number alone is a word.
"""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Iterator
from typing import NamedTuple

GREEK = {
    "mu": "μ", "nu": "ν", "zeta": "ζ", "beta": "β", "phi": "φ", "eta": "η", "psi": "ψ",
    "Lambda": "Λ", "lambda": "λ", "rho": "ρ", "omega": "ω", "pi": "π", "ell": "ℓ", "sigma": "σ",
}  # fmt: skip

LETTERS = (
    "L_c", "L_s", "k_c", "K_c", "c_s", "G1", "G2", "G_1", "G_2", "f0", "v0", "phi0", "f_d", "F_N",
    "H", "L", "V", "D", "M", "k", "kH", "Hk", "sigma0", "sigma_yy", "sigma_xy", "Lambda_theory",
    "g'", "Re", "Im", "infinity", "dphi/dt", "df/dlogV",
)  # fmt: skip
"""Symbols beside the Greek letters; ``a``, ``f``, ``i``, ``t`` and ``v`` are such next to others
alone."""

SPECIAL = {
    "dphi/dt": (r"\dot\phi", "<mover><mi>φ</mi><mo>˙</mo></mover>"),
    "df/dlogV": (
        r"df/d\log V", "<mi>d</mi><mi>f</mi><mo>/</mo><mi>d</mi><mi>log</mi><mi>V</mi>"
    ),
    "infinity": (r"\infty", "<mi>∞</mi>"),
    "g'": ("g'", "<mi>g′</mi>"),
    "Re": (r"\operatorname{Re}", "<mi>Re</mi>"),
    "Im": (r"\operatorname{Im}", "<mi>Im</mi>"),
}  # fmt: skip
"""In TeX and in MathML, what is no letter with an index."""

NAMES = sorted({*GREEK, *LETTERS} - {"sigma"}, key=len, reverse=True)
SYMBOL = re.compile(rf"({'|'.join(map(re.escape, NAMES))})(?:\^(\w))?(?![\w'])")
LETTER = re.compile(
    r"(a)(?= (?:zeta|ell|sigma0|Lambda)\b| ?[=)+])|(?<=/)(a)(?![\w'])|(?<=-)(a)(?= zeta)|"
    r"(f)(?= beta)|(v)(?:\^(\w))?(?![\w'])|(?<=\+ )(i)\b|(?<=\d)(i)\b|(i)(?= V/)|(t)(?= =)"
)
"""Symbols that are words too, told by what stands beside them."""
NUMBER = re.compile(r"(\d+(?:\.\d+)?)(?:e([-+]?\d+))?(?![\d.]*\d)")
POWER = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)e([-+]?\d+)(?!\w)")
OPERATORS = {
    "->": (r"\to", "→"), ">>": (r"\gg", "≫"), "=": ("=", "="), "<": ("<", "&lt;"),
    ">": (">", ">"), "+": ("+", "+"), "-": ("-", "−"), "/": ("/", "/"),
}  # fmt: skip
BRACKETS = {"(": ")", "[": "]", "{": "}"}
ROOT = "sqrt"
SIGN = re.compile(rf"{ROOT}(?=[({{])|->|>>|[=<>+/|()\[\]{{}}-]")
SIGNS = {"->": "→", ">>": "≫", "sqrt(": "√(", "sqrt{": "√{"}
"""Signs outside of formulas."""


class Token(NamedTuple):
    """A piece of a formula: its place in the text, what it is, and how it is written."""

    start: int
    end: int
    kind: str  # symbol, number, sign, open, close, bar or root
    tex: str
    mathml: str


def as_html(text: str) -> str:
    """A text as HTML with its formulas in MathML, which browsers show without any script."""
    return _typeset(text, lambda tokens: f"<math>{_mathml(tokens)}</math>", _html)


def as_markdown(text: str) -> str:
    """A text as Markdown with its formulas between dollars; all else is escaped."""
    return _typeset(text, lambda tokens: f"${_tex(text, tokens)}$", _escaped)


def as_parts(text: str) -> list[str]:
    """Plain texts and formulas in TeX by turns; 1e-5 is a formula here, and the panel (a) none."""

    def marked(piece: str) -> str:
        return _typeset(piece, lambda tokens: f"\0{_tex(piece, tokens)}\0", str)

    pieces = re.split(r"(\([a-z]\))", text)
    pieces[::2] = map(marked, pieces[::2])
    parts = "".join(pieces).split("\0")
    for i in range(0, len(parts), 2):
        parts[i] = POWER.sub(lambda number: f"\0{_number(*number.groups())[0]}\0", parts[i])
    return "\0".join(parts).split("\0")


def _typeset(text: str, formula: Callable[[list[Token]], str], plain: Callable[[str], str]) -> str:
    parts, end = [], 0
    for tokens in _formulas(text):
        parts += [plain(text[end : tokens[0].start]), formula(tokens)]
        end = tokens[-1].end
    return "".join([*parts, plain(text[end:])])


# ---- what a formula is


def _formulas(text: str) -> Iterator[list[Token]]:
    """The formulas of a text, each the longest one that can be read from where it begins."""
    run: list[Token] = []
    for token in [*_tokens(text), None]:
        if run and (token is None or text[run[-1].end : token.start].strip(" ")):
            yield from _readable(run)
            run = []
        if token is not None:
            run.append(token)


def _readable(run: list[Token]) -> Iterator[list[Token]]:
    """The longest parts of a run of pieces that are formulas, from left to right."""
    for size in range(len(run), 0, -1):
        for first in range(len(run) - size + 1):
            part = run[first : first + size]
            if _is_formula(part):
                yield from _readable(run[:first])
                yield part
                yield from _readable(run[first + size :])
                return


def _is_formula(tokens: list[Token]) -> bool:
    """Whether there is a symbol, brackets close, and no sign between two things lacks one."""
    kinds = [token.kind for token in tokens]
    if "symbol" not in kinds or kinds.count("bar") % 2 or kinds[-1] in ("sign", "root"):
        return False
    if kinds[0] == "sign" and tokens[0].tex not in ("-", "+"):
        return False
    waiting: list[str] = []
    for token in tokens:
        if token.kind == "open":
            waiting.append(BRACKETS[token.tex])
        elif token.kind == "close" and (not waiting or waiting.pop() != token.tex):
            return False
    return not waiting


def _tokens(text: str) -> Iterator[Token]:
    """The pieces of which formulas are made; words between them are left out."""
    at, inside = 0, False  # inside a word, no piece begins
    while at < len(text):
        found = None if inside else _piece(text, at)
        if found is None:
            inside = text[at].isalnum() or text[at] in "_'."
            inside = inside and not (text[at] == "." and not text[at + 1 : at + 2].isalnum())
            at += 1
        else:
            yield found
            at, inside = found.end, False


def _piece(text: str, at: int) -> Token | None:
    if match := SIGN.match(text, at):
        return _sign(match)
    if match := SYMBOL.match(text, at):
        return Token(at, match.end(), "symbol", *_symbol(match[1], match[2]))
    if match := LETTER.match(text, at):
        *names, power = (match[n] for n in (1, 2, 3, 4, 5, 7, 8, 9, 10, 6))
        return Token(at, match.end(), "symbol", *_symbol(next(filter(None, names)), power))
    if match := NUMBER.match(text, at):
        after = text[match.end() : match.end() + 1]
        known = SYMBOL.match(text, match.end()) or LETTER.match(text, match.end())
        if not after.isalpha() or known:
            return Token(at, match.end(), "number", *_number(match[1], match[2]))
    return None


# ---- how its pieces are written


def _sign(match: re.Match[str]) -> Token:
    sign, place = match[0], match.span()
    if sign == ROOT:
        return Token(*place, "root", r"\sqrt", "msqrt")
    if sign == "|":
        return Token(*place, "bar", "|", '<mo stretchy="false">|</mo>')
    if sign in OPERATORS:
        tex, character = OPERATORS[sign]
        return Token(*place, "sign", tex, f"<mo>{character}</mo>")
    # as high as the line: without a font for mathematics browsers stretch them to twice of it
    mathml = f'<mo stretchy="false">{sign}</mo>'
    return Token(*place, "open" if sign in BRACKETS else "close", sign, mathml)


def _symbol(name: str, power: str | None) -> tuple[str, str]:
    """A letter with its indices in TeX and MathML, or several letters side by side."""
    if name in SPECIAL:
        return SPECIAL[name]
    base, _, index = name.partition("_")
    if not index and (match := re.fullmatch(r"(\D+)(\d)", name)):
        base, index = match.groups()
    letters = [base] if base in GREEK else list(base)
    tex = "".join(f"\\{letter}" if letter in GREEK else letter for letter in letters)
    *others, mathml = [f"<mi>{GREEK.get(letter, letter)}</mi>" for letter in letters]
    if index:
        word = index if len(index) < 3 else rf"\mathrm{{{index}}}"
        tex += f"_{index}" if len(index) == 1 else f"_{{{word}}}"
    low = f"<mn>{index}</mn>" if index.isdigit() else f"<mi>{index}</mi>"
    if power:
        tex += f"^{power}"
    high = f"<mn>{power}</mn>" if power and power.isdigit() else f"<mi>{power}</mi>"
    if index and power:
        mathml = f"<msubsup>{mathml}{low}{high}</msubsup>"
    elif index:
        mathml = f"<msub>{mathml}{low}</msub>"
    elif power:
        mathml = f"<msup>{mathml}{high}</msup>"
    return tex, "".join([*others, mathml])


def _number(digits: str, exponent: str | None) -> tuple[str, str]:
    if exponent is None:
        return digits, f"<mn>{digits}</mn>"
    power = int(exponent)
    high = f"<mn>{power}</mn>".replace("-", "−")
    tex, mathml = f"10^{{{power}}}", f"<msup><mn>10</mn>{high}</msup>"
    if float(digits) != 1.0:
        tex, mathml = rf"{digits}\times {tex}", f"<mn>{digits}</mn><mo>×</mo>{mathml}"
    return tex, mathml


def _tex(text: str, tokens: list[Token]) -> str:
    """The TeX of a formula, spaced as its text; a bar is no column of a table."""
    parts, open_bar, ends = [], False, 0
    for token, before in zip(tokens, [None, *tokens], strict=False):
        if before is not None:
            parts.append(text[before.end : token.start])
            glued = parts[-1] == "" and parts[-2][-1:].isalpha() and "\\" in parts[-2]
            parts[-1] = " " if glued and token.tex[:1].isalpha() else parts[-1]
        if token.kind == "bar":
            open_bar = not open_bar
            parts.append(r"\lvert " if open_bar else r"\rvert")
        elif before is not None and before.kind == "root":
            ends = _closing(tokens, token)
            parts.append("{")
        elif token.start == ends and token.kind == "close":
            parts.append("}")
        else:
            parts.append(rf"\{token.tex}" if token.tex in "{}" else token.tex)
    return "".join(parts)


def _mathml(tokens: list[Token]) -> str:
    """The MathML of a formula; what stands under a root is inside its element."""
    parts, roots = [], []
    for token, before in zip(tokens, [None, *tokens], strict=False):
        if token.kind == "root":
            parts.append("<msqrt>")
        elif before is not None and before.kind == "root":
            roots.append(_closing(tokens, token))
        elif token.kind == "close" and token.start in roots:
            parts.append("</msqrt>")
        else:
            parts.append(token.mathml)
    return "".join(parts)


def _closing(tokens: list[Token], opening: Token) -> int:
    """Where the bracket that closes another one stands."""
    depth = 0
    for token in tokens:
        if token.start < opening.start:
            continue
        depth += {"open": 1, "close": -1}.get(token.kind, 0)
        if depth == 0:
            return token.start
    raise ValueError(f"{opening.tex} is not closed")


def _html(text: str) -> str:
    for sign, character in SIGNS.items():
        text = text.replace(sign, character)
    return html.escape(text, quote=False).replace("&gt;", ">")


def _escaped(text: str) -> str:
    """Plain text of a cell of a Markdown table."""
    for sign, character in SIGNS.items():
        text = text.replace(sign, character)
    return re.sub(r"([|*_$])", r"\\\1", text).replace("\n", " ")
