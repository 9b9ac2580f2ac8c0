"""The article on paper: its Markdown as LaTeX, and as PDF by pandoc and Typst, without a TeX.

Pandoc reads the Markdown and writes LaTeX for journals and Typst for the PDF. Between the two
steps, the paragraph next to a picture or table (**Figure 1.** or **Table 1.**) becomes its caption,
and links to pages of this project become text.
"""

import json
import re
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import xarray as xr
import yaml

from nucleation.installed import require

from .evaluation import write_article

try:
    import pypandoc
    import typst
except ModuleNotFoundError:
    require("article")  # its error names the extra to install
    raise

_FORMAT = "markdown-implicit_figures"
_STYLE = """
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
_PAGE = {
    "papersize": "a4",
    "fontsize": "10pt",
    "page-numbering": "1",
    "lang": "en",
    "region": "GB",
}
_MARGINS = {"x": "25mm", "y": "22mm"}
_TEX = r"\usepackage[labelformat=empty,justification=raggedright]{caption}"
_TEX_PAGE = {
    "papersize": "a4",
    "geometry": "margin=25mm",
    "lang": "en-GB",
    "colorlinks": "true",
}

_Node = dict[str, Any]
"""A node of a document: its type ``t`` and contents ``c``."""


def write(
    template: Path,
    citation: Path,
    claims: Path,
    lengths: Iterable[xr.Dataset],
    figures: Iterable[Path],
    names: Iterable[str],
) -> dict[str, str | Callable[[Path], int]]:
    """The step ``replication``: the article with all its figures, as Markdown, LaTeX and PDF.

    Parameters
    ----------
    template : path
        The article's template, ``docs/article.md.in``.
    citation : path
        CITATION.cff, with the authors.
    claims : path
        The table of claims as JSON.
    lengths : iterable of Dataset
        Tables of lengths, one for each study.
    figures : iterable of path
        Pictures.
    names : iterable of str
        The pictures' names in the article.

    Returns
    -------
    dict
        By file extension the text, or a function that writes the file.
    """
    text = write_article(template, claims, lengths, beyond=True)[".md"]
    pictures = {}
    for name, path in zip(names, figures, strict=True):
        pictures[f"figures/{name}.png"] = path.with_suffix(".png")
    source = parsed(text, _authors(citation))
    pdf = as_pdf(source, pictures)
    return {
        ".pdf": lambda path: path.write_bytes(pdf),
        ".tex": as_tex(source),
        ".md": text,
    }


def _authors(citation: Path) -> list[str]:
    authors = yaml.safe_load(citation.read_text("utf-8"))["authors"]
    names = []
    for author in authors:
        name = author.get("name")
        names.append(name or f"{author['given-names']} {author['family-names']}")
    return names


def as_tex(source: _Node) -> str:
    """A document as LaTeX."""
    return _written(source, "latex", _TEX, _TEX_PAGE)


def as_pdf(
    source: _Node,
    pictures: Mapping[str, Path],
) -> bytes:
    """A document as PDF.

    Parameters
    ----------
    source : dict
        Result of :func:`parsed`.
    pictures : mapping
        Files of the pictures, by the paths that the document uses.
    """
    with tempfile.TemporaryDirectory() as directory:
        for name, path in pictures.items():
            copy = Path(directory, name)
            copy.parent.mkdir(exist_ok=True)
            shutil.copyfile(path, copy)
        main = Path(directory, "article.typ")
        main.write_text(_written(source, "typst", _STYLE, _PAGE), "utf-8")
        pdf = typst.compile(str(main), root=directory, ignore_system_fonts=True)
        return bytes(pdf)


def _written(
    source: _Node,
    to: str,
    header: str,
    variables: Mapping[str, str],
) -> str:
    options = [f"--variable={name}={value}" for name, value in variables.items()]
    options += [
        f"--variable=header-includes={header}",
        "--standalone",
        "--shift-heading-level-by=-1",
    ]
    text = pypandoc.convert_text(
        json.dumps(source),
        to,
        "json",
        extra_args=options,
    )
    return str(text)


def parsed(
    text: str,
    authors: list[str],
) -> _Node:
    """The article as a document of pandoc's, with title, abstract and captions.

    Parameters
    ----------
    text : str
        Markdown.
    authors : list of str
        Names of the authors.
    """
    title, _, body = text.partition("\n")
    source = json.loads(pypandoc.convert_text(body, "json", _FORMAT))
    sections = _sections(source["blocks"])
    abstract = sections.pop("abstract")[1:]
    margins = {side: _text(width) for side, width in _MARGINS.items()}
    source["meta"] = {
        "title": _text(title.lstrip("# ")),
        "author": {"t": "MetaList", "c": [_text(author) for author in authors]},
        "abstract": {"t": "MetaBlocks", "c": abstract},
        "margin": {"t": "MetaMap", "c": margins},
    }
    source["blocks"] = [block for blocks in sections.values() for block in blocks]
    return dict(source)


def _sections(blocks: list[_Node]) -> dict[str, list[_Node]]:
    """The blocks of each section, its heading first; those above the first heading at ``""``."""
    current: list[_Node] = []
    sections = {"": current}
    for block in blocks:
        if block["t"] == "Header" and block["c"][0] == 2:
            current = []
            sections[block["c"][1][0]] = current
        current.append(block)
    for section in sections.values():
        section[1:] = _captioned(_unlinked(section[1:]))
    return sections


def _text(text: str) -> dict[str, str]:
    return {"t": "MetaString", "c": text}


def _captioned(blocks: list[_Node]) -> Iterator[_Node]:
    """The blocks, with the paragraph below a picture or above a table as its caption."""
    waiting = [*blocks]
    while waiting:
        block = waiting.pop(0)
        if _is_picture(block):
            caption = [_plain(waiting.pop(0))]
            content = [["", [], []], [None, caption], [_plain(block)]]
            yield {"t": "Figure", "c": content}
        elif block["t"] == "Para" and waiting and waiting[0]["t"] == "Table":
            table = waiting[0]
            table["c"][1] = [None, [_plain(block)]]
        else:
            yield block


def _is_picture(block: _Node) -> bool:
    """Whether a block is a paragraph with nothing but a picture."""
    if block["t"] != "Para":
        return False
    return [part["t"] for part in block["c"]] == ["Image"]


def _plain(paragraph: _Node) -> _Node:
    return {"t": "Plain", "c": paragraph["c"]}


def _unlinked(part: Any) -> Any:
    """A part of the document in which links to pages of this project are text."""
    if isinstance(part, dict):
        return {name: _unlinked(value) for name, value in part.items()}
    if not isinstance(part, list):
        return part
    found: list[Any] = []
    for item in part:
        if _is_internal_link(item):
            found += _unlinked(item["c"][1])
        else:
            found.append(_unlinked(item))
    return found


def _is_internal_link(item: Any) -> bool:
    if not isinstance(item, dict) or item.get("t") != "Link":
        return False
    address = item["c"][2][0]
    return not re.match("https?:", address)
