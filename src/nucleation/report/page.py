"""Putting the report's page together: the step ``report``."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import plotly.offline
import xarray as xr
from markupsafe import Markup

from ..figures import catalogue
from ..figures.paper import table_s1
from ..model.friction.law import Friction
from ..model.linearised import InterfaceState
from ..model.material import Material
from ..report import answer, encode, faults, stability, tables
from ..types import Array

HEIGHTS = np.geomspace(1e-3, 10.0, 721)
"""Heights (m) of the theory's curve in the page; of studies of one's own it reaches further."""

SEEN = (2e-3, 1.0)
"""Heights (m) that the page shows first."""

SCRIPTS = ("page.js", "plots.js", "tables.js", "theory.js", "stability.js", "explorer.js")
"""What runs in the page, in this order; the first has what the others share."""


class Picture(NamedTuple):
    """A figure or an animation of the page: files, caption's template and its parameters."""

    name: str
    title: str
    category: str
    files: list[Path]  # the first is shown, the others can be downloaded
    caption: str
    params: dict[str, Any]
    data: tuple[catalogue.Data, ...] = ()


class Content(NamedTuple):
    """Everything the page shows, read from files."""

    material: Material
    friction: Friction
    interface: InterfaceState
    config: dict[str, Any]  # as given
    provenance: dict[str, str]  # of nucleation.datasets.provenance.attributes
    results: dict[str, xr.Dataset]  # datasets by name
    pictures: list[Picture]
    claims: list[dict[str, Any]] | None = None
    own: answer.OwnStudies | None = None  # with which the page begins


def write(
    origin: Mapping[str, str], figures: Sequence[Path], names: Sequence[str],
    captions: Sequence[Path], caption_values: Mapping[str, dict[str, Any]],
    datasets: Sequence[xr.Dataset], dataset_names: Sequence[str],
    claims: Sequence[Path], page_files: Sequence[Path], studies: dict[str, str],
    warnings: dict[str, list[str]], leads: bool, material: Material, friction: Friction,
    interface: InterfaceState, config: dict[str, Any],
) -> dict[str, str]:  # fmt: skip
    """The page as HTML, from the workflow's results.

    Parameters
    ----------
    origin : of the page, from :func:`nucleation.datasets.provenance.attributes`.
    figures, names : pictures and their names in the catalogue.
    captions, caption_values : templates in the same order, and what is filled in, by name.
    datasets, dataset_names : tables behind the figures.
    claims : the claims as JSON, or none.
    page_files : on which the page depends as well.
    studies, warnings, leads : studies of the user's own, and whether the page begins with them.
    material, friction, interface, config : of the configuration.
    """
    results = dict(zip(dataset_names, datasets, strict=True))
    entries = catalogue.FIGURES | catalogue.of_studies(studies)
    pictures = [
        Picture(
            name, entries[name].title, entries[name].category,
            [file for file in (path, path.with_suffix(".pdf")) if file.is_file()],
            caption.read_text("utf-8"), caption_values.get(name, {}), entries[name].data,
        )
        for name, path, caption in zip(names, figures, captions, strict=True)
    ]  # fmt: skip
    content = Content(
        material, friction, interface, config, dict(origin), results, pictures,
        claims=json.loads(claims[0].read_text("utf-8")) if claims else None,
        own=answer.OwnStudies(studies, warnings) if leads else None,
    )  # fmt: skip
    return {".html": build(content)}


def build(content: Content) -> str:
    """The whole page as HTML.

    Parameters
    ----------
    content : Content
        What is shown; sections without content are left out.
    """
    lengths = content.results.get("lengths")
    groups, data = _groups(content), _data(content, lengths)
    pictures = {p["name"]: p for group in groups.values() for p in group}
    first, studies, fault_rows, runs = None, [], [], []
    if lengths is not None:
        runs = tables.run_rows(lengths, tables.LENGTH_COLUMNS)
    if lengths is not None and content.own is None:
        first = answer.of_paper(lengths)
    elif lengths is not None and content.own is not None:
        studies, fault_rows = answer.of_studies(content.own, lengths), tables.fault_rows(lengths)
        groups.pop(catalogue.OWN, None)
    if first and "figure_3" in pictures:
        groups[catalogue.PAPER].remove(pictures["figure_3"])
    printed = {claim["id"]: claim["paper"] for claim in content.claims or []}.get("length-shown")
    return encode.template("template.html").render(
        data, answer=first, printed=printed, groups=groups, pictures=pictures,
        studies=studies, fault_rows=fault_rows, lengths=runs,
        styles=encode.source("page.css"),
        scripts=[Markup(plotly.offline.get_plotlyjs()), *map(encode.source, SCRIPTS)],
        data=encode.script_json(data),
        claims=tables.claim_rows(content.claims or []),
        counts=tables.verdict_counts(content.claims or []),
        table_s1=_parameters(content.friction),
        seconds=0.0 if lengths is None else float(lengths["wall_seconds"].sum()),
        origin=_origin(content),
    )  # fmt: skip


def _data(content: Content, lengths: xr.Dataset | None) -> dict[str, Any]:
    """What the page's code reads."""
    heights, seen = _heights(content, lengths)
    known = faults.faults(lengths) if lengths is not None else []
    height = {
        "key": "H", "label": "Height of the block, for the values below", "symbol": "H",
        "unit": "m", "factor": 1, "low": float(f"{heights[0]:.4g}"),
        "high": float(f"{heights[-1]:.4g}"), "log": True,
        "value": 0.1 if content.own is None else float(f"{np.sqrt(seen[0] * seen[1]):.2g}"),
    }  # fmt: skip
    return {
        "faults": [fault.in_page() for fault in known if fault.rigid] if len(known) > 1 else [],
        "seen": seen,
        "controls": [*faults.controls(content.material, content.interface), height],
        "heights": heights.tolist(),
        "points": tables.point_series(lengths) if lengths is not None else [],
        "stability": stability.in_page(),
    }


def _heights(content: Content, lengths: xr.Dataset | None) -> tuple[Array, list[float]]:
    """Heights (m) of the theory's curves, and the ends of those that are shown first."""
    if content.own is None or lengths is None:
        return HEIGHTS, list(SEEN)
    low, high = float(lengths["height"].min()), float(lengths["height"].max())
    ends = min(HEIGHTS[0], low / 10.0), max(HEIGHTS[-1], high * 10.0)
    points = int(HEIGHTS.size * np.log(ends[1] / ends[0]) / np.log(HEIGHTS[-1] / HEIGHTS[0]))
    return np.geomspace(*ends, points), [low / 3.0, 3.0 * high]


def _groups(content: Content) -> dict[str, list[dict[str, Any]]]:
    """The pictures by category."""
    groups: dict[str, list[dict[str, Any]]] = {}
    for picture in content.pictures:
        shown, *others = picture.files
        downloads = [
            encode.download(f"{picture.name}{path.suffix}", path.read_bytes()) for path in others
        ]
        downloads += [_table(content.results, data) for data in picture.data]
        groups.setdefault(picture.category, []).append(
            {
                "name": picture.name,
                "title": picture.title,
                "moves": shown.suffix == ".gif",
                "image": encode.data_address(shown.read_bytes(), shown.name),
                "caption": Markup(encode.caption_html(picture.caption, picture.params)),
                "downloads": downloads,
            }
        )
    return groups


def _table(results: Mapping[str, xr.Dataset], data: catalogue.Data) -> dict[str, str]:
    text = tables.csv_text(results[data.dataset], data.variables)
    return encode.download(data.name, text.encode())


def _origin(content: Content) -> dict[str, Any]:
    """Versions, the configuration, and which code made each dataset."""
    configuration = json.dumps(content.config, indent=2)
    return {
        "versions": json.loads(content.provenance["versions"]),
        "created": content.provenance["created"],
        "digest": content.provenance["code_digest"],
        "datasets": [
            {"Dataset": name, **_origin_of(dataset)} for name, dataset in content.results.items()
        ],
        "config": configuration,
        "download": encode.download("configuration.json", configuration.encode()),
    }


def _origin_of(dataset: xr.Dataset) -> dict[str, str]:
    keys = {"Code digest": "code_digest", "Made": "created", "Made again by": "command"}
    said = {title: dataset.attrs.get(key, "") for title, key in keys.items()}
    return said | {"Code digest": said["Code digest"][:16]}


def _parameters(friction: Friction) -> list[dict[str, str]]:
    """Table S1."""
    return [
        {
            "Parameter": Markup("<i>{}</i>").format(row.symbol),
            "Value": table_s1.value_text(row.value),
            "Unit": row.unit,
            "Description": row.description,
        }
        for row in table_s1.rows(friction)
    ]
