"""How hard the code and pages are to read: words, tokens a line, public classes.

The limits keep what has been reached; lower them when the code gets better.
"""

import ast
import io
import re
import tokenize
from pathlib import Path

ROOT = Path(__file__).parents[1]
TEXTS = {path: path.read_text(encoding="utf-8") for path in (ROOT / "src").rglob("*.py")}
TREES = {path: ast.parse(text) for path, text in TEXTS.items()}
NAMES = ("COMMENT", "NL", "NEWLINE", "INDENT", "DEDENT", "ENCODING", "ENDMARKER")
WITHOUT_MEANING = {getattr(tokenize, name) for name in NAMES}
WORDS = {
    ("what", "whatever"): 1.5,
    ("said", "says", "say", "told", "tells", "tell", "asked", "asks", "ask"): 0.5,
    ("stands", "stand", "lies", "lie", "goes", "go"): 0.5,
    ("whose", "which"): 12.0,
}
"""Most occurrences of words in a thousand words of docstrings."""
PHRASES = re.compile(
    r"\b(what (is|has|was|are)|whose|of which|says?|said|tells?|told|asks?|stands|lies)\b",
    re.IGNORECASE,
)
"""Relative clauses in place of a noun, and things that speak or stand."""
QUOTED = ("What is stable", "time asked for after it")
"""A heading, and the outcome of a run."""


def nodes(*kinds):
    for path, tree in TREES.items():
        for node in ast.walk(tree):
            if isinstance(node, kinds):
                yield path, node


def test_docstrings_have_few_words_that_make_readers_stop():
    kinds = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    texts = [ast.get_docstring(node) or "" for _, node in nodes(*kinds)]
    words = re.findall(r"[a-z']+", " ".join(texts).lower())
    found = {chosen: 1000.0 * sum(map(words.count, chosen)) / len(words) for chosen in WORDS}
    assert {k: v for k, v in found.items() if v > WORDS[k]} == {}


def test_pages_and_messages_have_no_phrase_that_makes_readers_stop():
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]
    pages = [page for page in pages if "_build" not in page.parts]
    lines = [(page, line) for page in pages for line in page.read_text("utf-8").splitlines()]
    assert len(pages) > 15
    docstrings = {id(node.value) for _, node in nodes(ast.Expr)}
    for path, node in nodes(ast.Constant):
        if isinstance(node.value, str) and id(node) not in docstrings:
            lines.append((path, node.value))
    found = [(path.name, line) for path, line in lines if PHRASES.search(line)]
    assert [own for own in found if not any(words in own[1] for words in QUOTED)] == []


def test_no_line_is_kept_from_the_formatter():
    assert [path.name for path, text in TEXTS.items() if "fmt: skip" in text] == []


def whole_texts(tokens):
    """Tokens, of which a formatted text is one, as in Python 3.11."""
    depth = 0
    for token in tokens:
        kind = tokenize.tok_name[token.type]
        depth -= kind == "FSTRING_END"
        if depth == 0 and kind != "FSTRING_END":
            yield token
        depth += kind == "FSTRING_START"


def test_a_line_has_few_tokens():
    """Without docstrings and comments."""
    texts = set()
    for path, node in nodes(ast.Expr):
        if isinstance(node.value, ast.Constant):
            texts |= {(path, line) for line in range(node.lineno, node.end_lineno + 1)}
    places = [
        (path, token.start[0])
        for path, text in TEXTS.items()
        for token in whole_texts(tokenize.generate_tokens(io.StringIO(text).readline))
        if token.type not in WITHOUT_MEANING
    ]
    own = [place for place in places if place not in texts]
    assert len(own) / len(set(own)) < 8.0


def test_few_classes_are_public():
    classes = [node.name for _, node in nodes(ast.ClassDef) if not node.name.startswith("_")]
    assert len(classes) <= 100
