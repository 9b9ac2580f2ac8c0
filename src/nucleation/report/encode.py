"""Putting things into a page: files as data addresses, typed arrays, captions."""

import base64
import json
import mimetypes
from pathlib import Path
from typing import Any

import numpy as np
from docutils.core import publish_parts
from jinja2 import Environment, FileSystemLoader, StrictUndefined, Template
from markupsafe import Markup
from numpy.typing import ArrayLike

HERE = Path(__file__).parent
CAPTIONS = {
    "math_output": "MathML",  # shown by browsers without any script
    "report_level": 2,
    "halt_level": 2,  # a mistake in a caption stops the report
    "file_insertion_enabled": False,
    "raw_enabled": False,
}
"""Settings of docutils."""


def template(name: str) -> Template:
    """A template of a page; what is filled in stays text unless it is marked as HTML."""
    return Environment(
        loader=FileSystemLoader(HERE), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    ).get_template(name)  # fmt: skip


def source(name: str) -> Markup:
    """A script or style sheet of the pages."""
    return Markup((HERE / name).read_text(encoding="utf-8"))


def data_address(content: bytes, name: str) -> str:
    """A ``data:`` address that holds a whole file, of the type its name says."""
    kind = mimetypes.guess_type(name)[0] or "application/octet-stream"
    return f"data:{kind};base64,{base64.b64encode(content).decode('ascii')}"


def download(name: str, content: bytes) -> dict[str, str]:
    """A file that the page offers: its name and its address."""
    return {"name": name, "address": data_address(content, name)}


def float32(values: ArrayLike) -> str:
    """Values as little-endian 32-bit floats in base64, which the page reads as a Float32Array."""
    return base64.b64encode(np.asarray(values, dtype="<f4").tobytes()).decode("ascii")


def script_json(value: Any) -> Markup:
    """JSON that can stand inside a ``<script>`` element: no text in it can end the element.

    Nor can any begin a comment, after which the element's own end would not be found.
    """
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    return Markup(text.replace("<", "\\u003c"))


def caption_html(template: str, params: dict[str, Any]) -> str:
    """A caption as HTML, from reStructuredText with Jinja2's placeholders.

    They are ``snakemake.params.NAME`` and ``snakemake.wildcards.NAME``, as in Snakemake's report.

    Raises
    ------
    jinja2.UndefinedError
        For a placeholder without a value.
    docutils.utils.SystemMessage
        For a mistake in the text.
    """
    text = (
        Environment(undefined=StrictUndefined)
        .from_string(template)
        .render(snakemake={"params": params, "wildcards": params})
    )
    return publish_parts(text, writer="html5", settings_overrides=CAPTIONS)["body"]
