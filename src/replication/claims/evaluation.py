"""From the workflow's results to the tables of claims and the article: the steps of both."""

import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.model.friction.law import Friction
from nucleation.model.linearised import InterfaceState
from nucleation.model.material import Material
from nucleation.model.parameters import Loading

from ..tables import lengths as table_of_lengths
from . import article, table
from .claim import Row
from .evidence import Evidence
from .table import Entry

Statements = Mapping[str, Mapping[str, Entry]]


def of_paper(
    statements: Statements,
    material: Material,
    friction: Friction,
    loading: Loading,
    interface: InterfaceState,
    settings: ExtractionSettings,
    theory: xr.Dataset,
    dispersion: xr.Dataset,
    lengths: Iterable[xr.Dataset],
    longer: Sequence[xr.Dataset],
    longer_runs: list[dict[str, Any]],
    patches: Iterable[xr.Dataset],
    patch_ids: Sequence[str],
) -> dict[str, str]:
    """The step ``claims``: a verdict on every statement of the paper.

    Parameters
    ----------
    statements : mapping
        The claims by subject and id.
    material, friction, loading, interface, theory, dispersion
        As in :class:`.Evidence`.
    settings : ExtractionSettings
        How lengths are read from a run.
    lengths : iterable of Dataset
        Tables of lengths, one for each study.
    longer : sequence of Dataset
        Simulations with longer blocks, and the simulations that they are compared with.
    longer_runs : list of dict
        The runs of `longer`.
    patches : iterable of Dataset
        Stability of patches.
    patch_ids : sequence of str
        Names of the runs with these patches.

    Returns
    -------
    dict
        The table's text by file extension.
    """
    tables = list(lengths)
    if len(longer):
        tables.append(table_of_lengths.lengths_table(longer_runs, longer, settings))
    evidence = Evidence(
        material=material,
        friction=friction,
        loading=loading,
        interface=interface,
        theory=theory,
        dispersion=dispersion,
        lengths=tuple(tables),
        patches=dict(zip(patch_ids, patches, strict=True)),
    )
    rows = table.evaluate(statements, evidence)
    return _files(rows) | {".json": table.to_json(rows)}


def of_pairs(
    statements: Statements,
    pairs: xr.Dataset,
    modes: xr.Dataset,
) -> dict[str, str]:
    """The step ``claims_pairs``: verdicts on the theory of two bodies, by simulations.

    Parameters
    ----------
    statements : mapping
        The claims by subject and id.
    pairs, modes : Dataset
        As in :data:`~replication.claims.pair_evidence.Tables`.

    Returns
    -------
    dict
        The table's text by file extension.
    """
    return _files(table.evaluate(statements, {"pairs": pairs, "modes": modes}))


def _files(rows: list[Row]) -> dict[str, str]:
    return {".csv": table.to_csv(rows), ".md": table.to_markdown(rows)}


def write_article(
    template: Path,
    claims: Path,
    lengths: Iterable[xr.Dataset],
    beyond: bool = False,
) -> dict[str, str]:
    """The step ``article``: its text with numbers from the claims and lengths.

    Parameters
    ----------
    template : path
        The article's template, ``docs/article.md.in``.
    claims : path
        The table of claims as JSON.
    lengths : iterable of Dataset
        Tables of lengths, one for each study.
    beyond : bool
        As in :func:`.article.render`.

    Returns
    -------
    dict
        The text by file extension.
    """
    rows = json.loads(claims.read_text("utf-8"))
    text = article.render(template.read_text("utf-8"), rows, lengths, beyond)
    return {".md": text}
