"""How hard the code is to read: words of docstrings, tokens a line, sections of parameters.

The limits keep what has been reached; lower them when the code gets better.
"""

import ast
import io
import re
import tokenize
from pathlib import Path

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src"
MODULES = sorted(SOURCE.rglob("*.py"))
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

TOKENS_A_LINE = 8.0
PUBLIC_CLASSES = 100


def trees():
    for path in MODULES:
        yield path, ast.parse(path.read_text(encoding="utf-8"))


def docstrings():
    kinds = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    for _, tree in trees():
        for node in ast.walk(tree):
            if isinstance(node, kinds) and ast.get_docstring(node):
                yield node, ast.get_docstring(node)


def test_docstrings_have_few_words_that_make_readers_stop():
    words = [word for _, text in docstrings() for word in re.findall(r"[a-z']+", text.lower())]
    found = {chosen: 1000.0 * sum(map(words.count, chosen)) / len(words) for chosen in WORDS}
    assert {k: v for k, v in found.items() if v > WORDS[k]} == {}


def test_pages_have_no_phrase_that_makes_readers_stop():
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]
    found = [
        f"{page.name}: {line}"
        for page in pages
        if "_build" not in page.parts
        for line in page.read_text(encoding="utf-8").splitlines()
        if PHRASES.search(line) and not any(words in line for words in QUOTED)
    ]
    assert len(pages) > 15 and found == []


def test_messages_have_no_phrase_that_makes_readers_stop():
    found = []
    for path, tree in trees():
        texts = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
        for node in ast.walk(tree):
            is_text = isinstance(node, ast.Constant) and isinstance(node.value, str)
            if is_text and id(node) not in texts and PHRASES.search(node.value):
                found.append(f"{path.name}:{node.lineno}: {node.value}")
    assert found == []


def test_no_line_is_kept_from_the_formatter():
    marked = [path.name for path in MODULES if "fmt: skip" in path.read_text(encoding="utf-8")]
    assert marked == []


def whole_texts(tokens):
    """Tokens, of which a formatted text is one, as in Python 3.11."""
    depth = 0
    for token in tokens:
        kind = tokenize.tok_name[token.type]
        depth -= kind == "FSTRING_END"
        if depth == 0 and kind != "FSTRING_END":
            yield token
        depth += kind == "FSTRING_START"


def tokens_and_lines():
    """The number of tokens, and of lines with one, without docstrings and comments."""
    tokens = lines = 0
    for path, tree in trees():
        texts = set()
        for node in ast.walk(tree):
            if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
                texts |= set(range(node.lineno, node.end_lineno + 1))
        text = path.read_text(encoding="utf-8")
        own = [
            token.start[0]
            for token in whole_texts(tokenize.generate_tokens(io.StringIO(text).readline))
            if token.type not in WITHOUT_MEANING and token.start[0] not in texts
        ]
        tokens += len(own)
        lines += len(set(own))
    return tokens, lines


def test_a_line_has_few_tokens():
    tokens, lines = tokens_and_lines()
    assert tokens / lines < TOKENS_A_LINE


def test_few_classes_are_public():
    classes = [
        node.name
        for _, tree in trees()
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    ]
    assert len(classes) <= PUBLIC_CLASSES
