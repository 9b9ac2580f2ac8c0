"""The article on paper: its Markdown as LaTeX, and as PDF by pandoc and Typst, without a TeX.

Pandoc reads the Markdown and writes LaTeX for journals and Typst for the PDF. In between, pictures
and tables take the paragraph beside them, **Figure 1.** or **Table 1.**, as their caption, and
links to pages of this project become text.
"""

import json
import re
import shutil
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import xarray as xr
import yaml

from ..configuration.installed import require
from . import article

try:
    import pypandoc
    import typst
except ModuleNotFoundError:
    require("article")  # says what to install
    raise

FORMAT = "markdown-implicit_figures"
STYLE = """
#set document(date: none)
#set par(leading: 0.6em, spacing: 0.9em)
#show heading: set block(above: 1.4em, below: 0.7em)
#show link: set text(fill: rgb("#00467f"))
#show raw: set text(size: 0.95em)
#show figure: set block(above: 1.5em, below: 1.5em)
#show figure.where(kind: table): set text(size: 0.85em)
#show figure.where(kind: image): set figure(placement: auto)
#show heading: it => place.flush() + it
#show table.cell: set align(left)
#show table: set par(justify: false)
#show table: set text(hyphenate: false)
#show figure.caption: it => block(width: 100%, align(left, text(size: 0.9em, it.body)))
#set figure(gap: 0.8em)
#set table(inset: (x: 3pt, y: 3pt), stroke: (_, y) => if y == 0 { (bottom: 0.5pt) })
"""
PAGE = {"papersize": "a4", "fontsize": "10pt", "page-numbering": "1", "lang": "en", "region": "GB"}
MARGINS = {"x": "25mm", "y": "22mm"}
TEX = r"\usepackage[labelformat=empty,justification=raggedright]{caption}"
TEX_PAGE = {"papersize": "a4", "geometry": "margin=25mm", "lang": "en-GB", "colorlinks": "true"}

Blocks = list[dict[str, Any]]


def write(
    template: Path, citation: Path, claims: Path, lengths: Iterable[xr.Dataset],
    figures: Iterable[Path], names: Iterable[str],
) -> dict[str, Any]:  # fmt: skip
    """The step ``replication``: the article with all its figures, as Markdown, LaTeX and PDF.

    Parameters
    ----------
    template, claims, lengths : as of :func:`nucleation.claims.article.render`, in files.
    citation : CITATION.cff, for the authors.
    figures, names : pictures, and what the article calls them.
    """
    rows = json.loads(claims.read_text("utf-8"))
    text = article.render(template.read_text("utf-8"), rows, list(lengths), beyond=True)
    authors = [
        author.get("name") or f"{author['given-names']} {author['family-names']}"
        for author in yaml.safe_load(citation.read_text("utf-8"))["authors"]
    ]
    pictures = {
        f"figures/{name}.png": path.with_suffix(".png")
        for name, path in zip(names, figures, strict=True)
    }
    source = parsed(text, authors)
    pdf = as_pdf(source, pictures)
    return {".pdf": lambda path: path.write_bytes(pdf), ".tex": as_tex(source), ".md": text}


def as_tex(source: dict[str, Any]) -> str:
    """LaTeX of a document as pandoc has it."""
    return _written(source, "latex", TEX, TEX_PAGE)


def as_pdf(source: dict[str, Any], pictures: Mapping[str, Path]) -> bytes:
    """PDF of a document as pandoc has it, with pictures by the paths that it has."""
    with tempfile.TemporaryDirectory() as directory:
        for name, path in pictures.items():
            (place := Path(directory, name)).parent.mkdir(exist_ok=True)
            shutil.copyfile(path, place)
        main = Path(directory, "article.typ")
        main.write_text(_written(source, "typst", STYLE, PAGE), "utf-8")
        return bytes(typst.compile(str(main), root=directory, ignore_system_fonts=True))


def _written(source: dict[str, Any], to: str, header: str, variables: Mapping[str, str]) -> str:
    variables = {**variables, "header-includes": header}
    options = [f"--variable={name}={value}" for name, value in variables.items()]
    options += ["--standalone", "--shift-heading-level-by=-1"]
    return str(pypandoc.convert_text(json.dumps(source), to, "json", extra_args=options))


def parsed(text: str, authors: list[str]) -> dict[str, Any]:
    """The article as pandoc has it: title and abstract apart, captions in place."""
    title, _, body = text.partition("\n")
    source = json.loads(pypandoc.convert_text(body, "json", FORMAT))
    sections: dict[str, Blocks] = {"": []}
    for block in source["blocks"]:
        if block["t"] == "Header" and block["c"][0] == 2:
            sections[block["c"][1][0]] = []
        next(reversed(sections.values())).append(block)
    for blocks in sections.values():
        blocks[1:] = list(_captioned(_unlinked(blocks[1:])))
    abstract = sections.pop("abstract")[1:]
    margins = {side: _text(width) for side, width in MARGINS.items()}
    source["meta"] = {
        "title": _text(title.lstrip("# ")),
        "author": {"t": "MetaList", "c": [*map(_text, authors)]},
        "abstract": {"t": "MetaBlocks", "c": abstract},
        "margin": {"t": "MetaMap", "c": margins},
    }
    source["blocks"] = [block for blocks in sections.values() for block in blocks]
    return dict(source)


def _text(text: str) -> dict[str, str]:
    return {"t": "MetaString", "c": text}


def _captioned(blocks: Blocks) -> Iterator[dict[str, Any]]:
    """Pictures with the paragraph below them, and tables with the one above, as their caption."""
    waiting = [*blocks]
    while waiting:
        block, after = waiting.pop(0), waiting[0] if waiting else None
        if [part["t"] for part in block["c"] or () if block["t"] == "Para"] == ["Image"]:
            caption = [{"t": "Plain", "c": waiting.pop(0)["c"]}]
            picture = {"t": "Plain", "c": block["c"]}
            yield {"t": "Figure", "c": [["", [], []], [None, caption], [picture]]}
        elif after and after["t"] == "Table" and block["t"] == "Para":
            after["c"][1] = [None, [{"t": "Plain", "c": block["c"]}]]
        else:
            yield block


def _unlinked(part: Any) -> Any:
    """A part of the document without its links to pages of this project."""
    if isinstance(part, dict):
        return {name: _unlinked(value) for name, value in part.items()}
    if not isinstance(part, list):
        return part
    found: list[Any] = []
    for item in part:
        kind = item.get("t") if isinstance(item, dict) else None
        inside = kind == "Link" and not re.match("https?:", item["c"][2][0])
        found += _unlinked(item["c"][1]) if inside else [_unlinked(item)]
    return found
