"""Sentences of pages with the numbers of the tables in results/reference."""

import functools

import pandas as pd

from .samples import DOCS, ROOT

REFERENCE = ROOT / "results" / "reference"


@functools.cache
def page(name):
    """The text of a page in one line."""
    path = ROOT / name if name == "README.md" else DOCS / name
    return " ".join(path.read_text(encoding="utf-8").split())


def says(name, *sentences):
    """Fails unless a page has these sentences."""
    for sentence in sentences:
        assert sentence in page(name), sentence


@functools.cache
def table(name):
    """A table of the reference, with L/L_c where it has lengths."""
    found = pd.read_csv(REFERENCE / f"{name}.csv")
    if name == "lengths":
        found = found.merge(pd.read_csv(REFERENCE / "measures.csv"), on="id")
    if "critical_length" in found and "length" in found:
        found["ratio"] = found["length"] / found["critical_length"]
    return found


def span(values, digits=2):
    """The least and the largest of some values, in words."""
    return f"{values.min():.{digits}f} to {values.max():.{digits}f}"
