"""Contents of a page: files as data addresses, arrays, JSON and captions."""

import base64
import io
import json
import mimetypes
from pathlib import Path
from typing import Any

import numpy as np
from docutils.core import publish_parts
from jinja2 import (
    Environment,
    FileSystemLoader,
    StrictUndefined,
    Template,
)
from markupsafe import Markup
from numpy.typing import ArrayLike
from PIL import Image

_DOTS = 96.0  # of a page for each inch

HERE = Path(__file__).parent
_CAPTIONS = {
    "math_output": "MathML",  # browsers show it without any script
    "report_level": 2,
    "halt_level": 2,  # a mistake in a caption stops the report
    "file_insertion_enabled": False,
    "raw_enabled": False,
}
"""Settings of docutils."""


def template(name: str) -> Template:
    """The template of a page; inserted texts are escaped unless they are marked as HTML."""
    environment = Environment(
        loader=FileSystemLoader(HERE),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(name)


def source(name: str) -> Markup:
    """A script or style sheet of the pages."""
    return Markup((HERE / name).read_text(encoding="utf-8"))


def data_address(content: bytes, name: str) -> str:
    """A ``data:`` address that contains a whole file.

    Parameters
    ----------
    content : bytes
        The file.
    name : str
        Its name; the suffix gives the type.

    Returns
    -------
    str
        The address.
    """
    kind = mimetypes.guess_type(name)[0] or "application/octet-stream"
    return f"data:{kind};base64,{base64.b64encode(content).decode('ascii')}"


def width(picture: bytes) -> int:
    """The physical width of a picture in the page's dots; a file without one has a page's dots."""
    with Image.open(io.BytesIO(picture)) as opened:
        dots = opened.info.get("dpi", (_DOTS, _DOTS))[0]
        return round(opened.width * _DOTS / float(dots))


def download(name: str, content: bytes) -> dict[str, str]:
    """A file that readers can download from the page.

    Parameters
    ----------
    name : str
        Its name.
    content : bytes
        The file.

    Returns
    -------
    dict
        ``name`` and ``address``.
    """
    return {"name": name, "address": data_address(content, name)}


def float32(values: ArrayLike) -> str:
    """Little-endian 32-bit floats in base64, which the page reads as a Float32Array."""
    numbers = np.asarray(values, dtype="<f4")
    return base64.b64encode(numbers.tobytes()).decode("ascii")


def script_json(value: Any) -> Markup:
    """JSON for a ``<script>`` element; no text in it can end the element or begin a comment."""
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    return Markup(text.replace("<", "\\u003c"))


def caption_html(template: str, params: dict[str, Any]) -> str:
    """A caption as HTML.

    Parameters
    ----------
    template : str
        reStructuredText with the placeholders of Snakemake's report,
        ``snakemake.params.NAME`` and ``snakemake.wildcards.NAME``.
    params : dict
        Values of the placeholders by NAME.

    Returns
    -------
    str
        HTML.

    Raises
    ------
    jinja2.UndefinedError
        If a placeholder has no value.
    docutils.utils.SystemMessage
        If the text has a mistake.
    """
    parsed = Environment(undefined=StrictUndefined).from_string(template)
    text = parsed.render(snakemake={"params": params, "wildcards": params})
    return publish_parts(text, writer="html5", settings_overrides=_CAPTIONS)["body"]
