"""From the workflow's results to the tables of claims and the article: the steps of both."""

import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from ..analysis import lengths as table_of_lengths
from ..analysis.definitions import ExtractionSettings
from ..model.friction.law import Friction
from ..model.linearised import InterfaceState
from ..model.material import Material
from ..model.parameters import Loading
from . import article, table
from .evidence import Evidence
from .statements.two_bodies import PairEvidence

Rows = list[dict[str, Any]]


def of_paper(
    statements: Mapping[str, Any], material: Material, friction: Friction, loading: Loading,
    interface: InterfaceState, settings: ExtractionSettings, theory: xr.Dataset,
    dispersion: xr.Dataset, lengths: Iterable[xr.Dataset], longer: Sequence[xr.Dataset],
    longer_runs: Rows, patches: Iterable[xr.Dataset], patch_ids: Sequence[str],
) -> dict[str, str]:  # fmt: skip
    """The step ``claims``: a verdict on every statement of the paper.

    Parameters
    ----------
    statements : the claims, by subject.
    material, friction, loading, interface, theory, dispersion : as of :class:`.Evidence`.
    settings : how lengths are read.
    lengths : tables of the studies judged.
    longer, longer_runs : simulations in longer blocks, with those they are compared with.
    patches, patch_ids : stability of patches, with the names of their runs.
    """
    tables = list(lengths)
    if len(longer):
        tables.append(table_of_lengths.lengths_table(longer_runs, longer, settings))
    evidence = Evidence(
        material, friction, loading, interface, theory, dispersion, tuple(tables),
        patches=dict(zip(patch_ids, patches, strict=True)),
    )  # fmt: skip
    rows = table.evaluate(statements, evidence)
    return _files(rows) | {".json": table.to_json(rows)}


def of_pairs(statements: Mapping[str, Any], pairs: xr.Dataset, modes: xr.Dataset) -> dict[str, str]:
    """The step ``claims_pairs``: what the theory says of two bodies, by simulations of them."""
    return _files(table.evaluate(statements, PairEvidence(pairs, modes)))


def _files(rows: Rows) -> dict[str, str]:
    return {".csv": table.to_csv(rows), ".md": table.to_markdown(rows)}


def write_article(template: Path, claims: Path, lengths: Iterable[xr.Dataset]) -> dict[str, str]:
    """The step ``article``: its text, with numbers from the claims and lengths."""
    rows = json.loads(claims.read_text("utf-8"))
    return {".md": article.render(template.read_text("utf-8"), rows, list(lengths))}
