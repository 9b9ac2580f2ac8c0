"""The page of the report (rule ``report``)."""

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
from . import calculator, encode, summary, tables, verdicts


class Picture(NamedTuple):
    """A figure or an animation of the page."""

    name: str
    entry: catalogue.Entry
    files: list[Path]  # the first is shown, the others can be downloaded
    caption: str  # template
    params: dict[str, Any]  # values of the caption's placeholders


class Content(NamedTuple):
    """Everything that the page shows."""

    fault: dict[str, Any]  # the calculator's first one, parameters of a Fault
    friction: Friction
    config: dict[str, Any]  # the complete configuration
    provenance: dict[str, str]  # from nucleation.datasets.provenance.attributes
    results: dict[str, xr.Dataset]  # datasets by name
    pictures: list[Picture]
    patch_tables: Path  # of the calculator
    claims: list[dict[str, Any]] | None = None
    own: summary.OwnStudies | None = None  # the first section, if the studies are the user's


def write(
    origin: Mapping[str, str],
    figures: Sequence[Path],
    names: Sequence[str],
    captions: Sequence[Path],
    caption_values: Mapping[str, dict[str, Any]],
    datasets: Sequence[xr.Dataset],
    dataset_names: Sequence[str],
    claims: Sequence[Path],
    patch_tables: Path,
    page_files: Sequence[Path],
    studies: dict[str, str],
    warnings: dict[str, list[str]],
    leads: bool,
    fault: dict[str, Any],
    friction: Friction,
    config: dict[str, Any],
) -> dict[str, str]:
    """Make the page from the results of the workflow.

    Parameters
    ----------
    origin : mapping
        Origin of the page, from :func:`nucleation.datasets.provenance.attributes`.
    figures : sequence of Path
        Pictures.
    names : sequence of str
        Their names in the catalogue.
    captions : sequence of Path
        Their captions' templates.
    caption_values : mapping
        Values of the captions' placeholders, by name of the picture.
    datasets : sequence of Dataset
        Tables of the figures.
    dataset_names : sequence of str
        Their names.
    claims : sequence of Path
        The claims as JSON, or nothing.
    patch_tables : Path
        Tables of L_run and W_c for the calculator.
    page_files : sequence of Path
        Templates and scripts. They are sources of the page, so that a change makes it again.
    studies : dict
        Description of each study of the user.
    warnings : dict
        Warnings about each of them.
    leads : bool
        Whether the page begins with these studies.
    fault : dict
        The calculator's first fault.
    friction : Friction
        The configuration's friction law.
    config : dict
        The complete configuration.

    Returns
    -------
    dict
        The page by suffix.
    """
    results = dict(zip(dataset_names, datasets, strict=True))
    entries = catalogue.FIGURES | catalogue.of_studies(studies)
    pictures = []
    for name, path, caption in zip(names, figures, captions, strict=True):
        files = [file for file in (path, path.with_suffix(".pdf")) if file.is_file()]
        text = caption.read_text("utf-8")
        pictures.append(
            Picture(
                name,
                entries[name],
                files,
                text,
                caption_values.get(name, {}),
            )
        )
    content = Content(
        fault=fault,
        friction=friction,
        config=config,
        provenance=dict(origin),
        results=results,
        pictures=pictures,
        patch_tables=patch_tables,
        claims=json.loads(claims[0].read_text("utf-8")) if claims else None,
        own=summary.OwnStudies(studies, warnings) if leads else None,
    )
    return {".html": build(content)}


def build(content: Content) -> str:
    """The whole page as HTML; sections without content are left out."""
    lengths = content.results.get("lengths")
    groups = _groups(content)
    pictures = {picture["name"]: picture for group in groups.values() for picture in group}
    claims = content.claims or []
    answer: dict[str, Any] | None = None
    studies: list[dict[str, Any]] = []
    fault_rows: list[dict[str, str]] = []
    run_rows: list[dict[str, str]] = []
    seconds = 0.0
    if lengths is not None:
        run_rows = tables.run_rows(lengths, tables.LENGTH_COLUMNS)
        seconds = float(lengths["wall_seconds"].sum())
        if content.own is None:
            answer = summary.of_paper(lengths)
        else:
            studies = summary.of_studies(content.own, lengths)
            fault_rows = tables.fault_rows(lengths)
            groups.pop(catalogue.OWN, None)
    if answer and "figure_3" in pictures:
        groups[catalogue.PAPER].remove(pictures["figure_3"])
    printed = {claim["id"]: claim["paper"] for claim in claims}
    return encode.template("template.html").render(
        calculator.shown(content.patch_tables, content.fault),
        level=3,
        answer=answer,
        printed=printed.get("length-shown"),
        groups=groups,
        pictures=pictures,
        studies=studies,
        fault_rows=fault_rows,
        lengths=run_rows,
        claims=verdicts.claim_rows(claims),
        counts=verdicts.verdict_counts(claims),
        table_s1=_parameters(content.friction),
        seconds=seconds,
        origin=_origin(content),
    )


def _groups(content: Content) -> dict[str, list[dict[str, Any]]]:
    """The pictures by category."""
    groups: dict[str, list[dict[str, Any]]] = {}
    for picture in content.pictures:
        shown = picture.files[0]
        content_of_file = shown.read_bytes()
        own = {
            "name": picture.name,
            "title": picture.entry.title,
            "moves": shown.suffix == ".gif",
            "image": encode.data_address(content_of_file, shown.name),
            "width": encode.width(content_of_file),
            "caption": Markup(encode.caption_html(picture.caption, picture.params)),
            "downloads": _downloads(picture, content.results),
        }
        groups.setdefault(picture.entry.category, []).append(own)
    return groups


def _downloads(picture: Picture, results: Mapping[str, xr.Dataset]) -> list[dict[str, str]]:
    """The other files of a picture, and its tables as CSV."""
    downloads = []
    for path in picture.files[1:]:
        downloads.append(encode.download(f"{picture.name}{path.suffix}", path.read_bytes()))
    for data in picture.entry.data:
        table = tables.csv_of(results[data.dataset], data.variables)
        downloads.append(encode.download(data.name, table))
    return downloads


def _origin(content: Content) -> dict[str, Any]:
    """Versions, the configuration, and the origin of each dataset."""
    configuration = json.dumps(content.config, indent=2)
    datasets = []
    for name, dataset in content.results.items():
        datasets.append({"Dataset": name, **_origin_of(dataset)})
    return {
        "versions": json.loads(content.provenance["versions"]),
        "created": content.provenance["created"],
        "digest": content.provenance["code_digest"],
        "datasets": datasets,
        "config": configuration,
        "download": encode.download("configuration.json", configuration.encode()),
    }


def _origin_of(dataset: xr.Dataset) -> dict[str, str]:
    attributes = dataset.attrs
    return {
        "Code digest": attributes.get("code_digest", "")[:16],
        "Made": attributes.get("created", ""),
        "Made again by": attributes.get("command", ""),
    }


def _parameters(friction: Friction) -> list[dict[str, str]]:
    """Table S1."""
    rows = []
    for row in table_s1.rows(friction):
        rows.append(
            {
                "Parameter": Markup("<i>{}</i>").format(row.symbol),
                "Value": table_s1.value_text(row.value),
                "Unit": row.unit,
                "Description": row.description,
            }
        )
    return rows
