"""Captions: reStructuredText templates, the same that Snakemake's own report shows."""

from types import SimpleNamespace
from typing import Any

from docutils.core import publish_parts
from jinja2 import Environment, StrictUndefined

SETTINGS = {
    "math_output": "MathML",  # shown by browsers without any script
    "report_level": 2,
    "halt_level": 2,  # a mistake in a caption stops the report
    "initial_header_level": 3,
    "file_insertion_enabled": False,
    "raw_enabled": False,
}


def caption_html(template: str, params: dict[str, Any], config: dict[str, Any]) -> str:
    """A caption as HTML.

    Parameters
    ----------
    template : str
        reStructuredText with Jinja2's placeholders for ``snakemake.params`` and
        ``snakemake.config``, as in Snakemake's reports.
    params : dict
        Parameters of the rule that drew the figure.
    config : dict
        The configuration as it was given.

    Raises
    ------
    jinja2.UndefinedError
        For a placeholder without a value.
    docutils.utils.SystemMessage
        For a mistake in the text.
    """
    snakemake = SimpleNamespace(params=SimpleNamespace(**params), config=config)
    text = Environment(undefined=StrictUndefined).from_string(template).render(snakemake=snakemake)
    return publish_parts(text, writer="html5", settings_overrides=SETTINGS)["body"]
