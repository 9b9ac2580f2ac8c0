"""Putting the report's page together: the step ``report``."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import xarray as xr
from markupsafe import Markup

from ..figures import catalogue
from ..figures.paper import table_s1
from ..model.friction.law import Friction
from ..report import calculator, encode, tables


class Picture(NamedTuple):
    """A figure or an animation of the page: files, caption's template and its parameters."""

    name: str
    entry: catalogue.Entry
    files: list[Path]  # the first is shown, the others can be downloaded
    caption: str
    params: dict[str, Any]


class Content(NamedTuple):
    """Everything the page shows, read from files."""

    fault: dict[str, Any]  # with which the calculator begins, as theory.fault.Fault has it
    friction: Friction
    config: dict[str, Any]  # as given
    provenance: dict[str, str]  # of nucleation.datasets.provenance.attributes
    results: dict[str, xr.Dataset]  # datasets by name
    pictures: list[Picture]
    claims: list[dict[str, Any]] | None = None
    own: tables.OwnStudies | None = None  # with which the page begins


def write(
    origin: Mapping[str, str], figures: Sequence[Path], names: Sequence[str],
    captions: Sequence[Path], caption_values: Mapping[str, dict[str, Any]],
    datasets: Sequence[xr.Dataset], dataset_names: Sequence[str],
    claims: Sequence[Path], page_files: Sequence[Path], studies: dict[str, str],
    warnings: dict[str, list[str]], leads: bool, fault: dict[str, Any], friction: Friction,
    config: dict[str, Any],
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
    fault, friction, config : what the calculator begins with; of the configuration.
    """
    results = dict(zip(dataset_names, datasets, strict=True))
    entries = catalogue.FIGURES | catalogue.of_studies(studies)
    pictures = [
        Picture(
            name, entries[name],
            [file for file in (path, path.with_suffix(".pdf")) if file.is_file()],
            caption.read_text("utf-8"), caption_values.get(name, {}),
        )
        for name, path, caption in zip(names, figures, captions, strict=True)
    ]  # fmt: skip
    content = Content(
        fault, friction, config, dict(origin), results, pictures,
        claims=json.loads(claims[0].read_text("utf-8")) if claims else None,
        own=tables.OwnStudies(studies, warnings) if leads else None,
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
    groups = _groups(content)
    pictures = {p["name"]: p for group in groups.values() for p in group}
    first, studies, fault_rows, runs = None, [], [], []
    if lengths is not None:
        runs = tables.run_rows(lengths, tables.LENGTH_COLUMNS)
    if lengths is not None and content.own is None:
        first = tables.of_paper(lengths)
    elif lengths is not None and content.own is not None:
        studies, fault_rows = tables.of_studies(content.own, lengths), tables.fault_rows(lengths)
        groups.pop(catalogue.OWN, None)
    if first and "figure_3" in pictures:
        groups[catalogue.PAPER].remove(pictures["figure_3"])
    printed = {claim["id"]: claim["paper"] for claim in content.claims or []}.get("length-shown")
    return encode.template("template.html").render(
        calculator.shown(content.fault), level=3, answer=first, printed=printed, groups=groups,
        pictures=pictures, studies=studies, fault_rows=fault_rows, lengths=runs,
        claims=tables.claim_rows(content.claims or []),
        counts=tables.verdict_counts(content.claims or []),
        table_s1=_parameters(content.friction),
        seconds=0.0 if lengths is None else float(lengths["wall_seconds"].sum()),
        origin=_origin(content),
    )  # fmt: skip


def _groups(content: Content) -> dict[str, list[dict[str, Any]]]:
    """The pictures by category."""
    groups: dict[str, list[dict[str, Any]]] = {}
    for picture in content.pictures:
        shown, *others = picture.files
        downloads = [
            encode.download(f"{picture.name}{path.suffix}", path.read_bytes()) for path in others
        ]
        downloads += [
            encode.download(data.name, tables.csv_of(content.results[data.dataset], data.variables))
            for data in picture.entry.data
        ]
        groups.setdefault(picture.entry.category, []).append(
            {
                "name": picture.name,
                "title": picture.entry.title,
                "moves": shown.suffix == ".gif",
                "image": encode.data_address(shown.read_bytes(), shown.name),
                "caption": Markup(encode.caption_html(picture.caption, picture.params)),
                "downloads": downloads,
            }
        )
    return groups


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
