"""Sphinx: these pages, the tutorials (executed) and the reference of the API (`make docs`)."""

import re
import runpy
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "src"))

import docutils.nodes  # noqa: E402
import numpydoc.numpydoc  # noqa: E402
from docutils.utils.math import pick_math_environment  # noqa: E402
from docutils.utils.math.latex2mathml import tex2mathml  # noqa: E402
from sphinx.errors import ConfigError  # noqa: E402

from nucleation import __version__  # noqa: E402

# It looks for signatures in docstrings, where ours have none, and those of builtins that a module
# imports (deque) make Sphinx fail.
numpydoc.numpydoc.mangle_signature = lambda *_: None

project = "nucleation"
author = "The nucleation developers"
copyright = "the nucleation developers"
release = version = __version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.viewcode",
    "numpydoc",
]
exclude_patterns = ["_build", "_templates", "calculator"]
templates_path = ["_templates"]

# Pages are read on the forge as well: plain Markdown, mathematics between dollars.
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
# Notebooks are committed without outputs and executed at every build; an error stops the build.
nb_execution_mode = "force"
nb_execution_timeout = 900  # per cell; the longest takes some 20 s
nb_execution_raise_on_error = True
nb_merge_streams = True

autosummary_generate = True
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True, "show-inheritance": True}
autodoc_typehints = "none"  # the docstrings name types, with units and shapes
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

html_math_renderer = "mathml"
html_theme = "furo"
html_title = "nucleation"
html_static_path = ["_static"]
html_css_files = ["mathematics.css"]
html_search_scorer = str(ROOT / "docs" / "search_scores.js")
html_show_sphinx = False

MOVED = ROOT / "docs" / "moved.txt"
"""One line for each page that is gone: its name, and the page and heading that replace it."""
REDIRECT = """<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<title>Moved to {page}</title>
<script>location.replace("{page}.html" + (location.hash || "#{heading}"))</script>
<noscript><meta http-equiv="refresh" content="0; url={address}"></noscript>
<p>This page has moved to <a href="{address}">{page}</a>.</p>
</html>
"""


def formulas(app, what, name, obj, options, lines):
    """Indented lines in a module's text are formulas: shown as they stand."""
    if what == "module":
        for i in range(len(lines) - 1, 0, -1):
            if lines[i].startswith("    ") and not lines[i - 1]:
                lines[i:i] = ["::", ""]


def mathematics(writer, node):
    """A formula as MathML, which browsers show without scripts and without the network."""
    block = isinstance(node, docutils.nodes.math_block)
    text = node.astext()
    environment = pick_math_environment(text) if block else ""
    if environment.startswith("align"):
        text = rf"\begin{{{environment}}}{text}\end{{{environment}}}"
    text = re.sub(r"\\tag\{(.+?)\}", r"\\qquad(\1)", text.replace(r"\dots", r"\ldots"))
    shown = tex2mathml(text, as_block=block)
    writer.body.append(f'<div class="math">{shown}</div>' if block else shown)
    raise docutils.nodes.SkipNode


def calculator(app, error):
    """The script of the calculator, after what it takes from the library."""
    if error is None and app.builder.name == "html":
        sources = ROOT / "docs" / "calculator"
        data = runpy.run_path(sources / "tables.py")["script_data"]()
        script = (sources / "calculator.js").read_text(encoding="utf-8")
        built = Path(app.outdir, "_static", "calculator.js")
        built.write_text(data + script, encoding="utf-8")


def redirects(app, error):
    """Pages at the addresses of :data:`MOVED`, which lead to the page that has their content now.

    An address with a heading leads to the same heading there.
    """
    if error is not None or app.builder.name != "html":
        return
    for line in MOVED.read_text(encoding="utf-8").splitlines():
        old, new = line.split()
        page, _, heading = new.partition("#")
        address = f"{page}.html#{heading}".removesuffix("#")
        if not Path(app.outdir, f"{page}.html").is_file():
            raise ConfigError(f"{MOVED.name}: {old} leads to {page}, which is no page")
        if Path(app.srcdir, f"{old}.md").exists():
            raise ConfigError(f"{MOVED.name}: {old} is a page again")
        stub = REDIRECT.format(page=page, heading=heading, address=address)
        Path(app.outdir, f"{old}.html").write_text(stub, encoding="utf-8")


def links_from_source(app, env):
    """Source pages lead back to where an object is described: its module's page, or the API's."""
    objects = env.get_domain("py").objects
    described = {name: place for name, place in objects.items() if not place.aliased}
    modules = getattr(env, "_viewcode_modules", {})
    for module, entry in modules.items():
        if not entry:
            continue
        code, tags, used, also = entry
        prefix = module if any(f"{module}.{name}" in described for name in used) else also
        places = {name: described.get(f"{prefix}.{name}") for name in used}
        pages = {name: place.docname for name, place in places.items() if place}
        modules[module] = (code, tags, pages, prefix)


def setup(app):
    shutil.rmtree(ROOT / "docs" / "generated", ignore_errors=True)  # pages of modules that are gone
    app.connect("env-check-consistency", links_from_source)
    app.connect("build-finished", calculator)
    app.connect("build-finished", redirects)
    app.connect("autodoc-process-docstring", formulas)
    app.add_html_math_renderer("mathml", (mathematics, None), (mathematics, None))
