"""The page of the report (rule ``report``)."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray as xr
from markupsafe import Markup

from nucleation.model.friction.law import Friction

from ..figures import catalogue
from ..figures.paper import table_s1
from . import calculator, encode, summary, tables, verdicts


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
        text = encode.caption_html(caption.read_text("utf-8"), caption_values.get(name, {}))
        pictures.append(picture(name, entries[name], files, text, results))
    page = build(
        fault=fault,
        friction=friction,
        config=config,
        origin=origin,
        results=results,
        pictures=pictures,
        patch_tables=patch_tables,
        claims=json.loads(claims[0].read_text("utf-8")) if claims else [],
        studies=studies if leads else {},
        warnings=warnings,
    )
    return {".html": page}


def picture(
    name: str,
    entry: catalogue.Entry,
    files: Sequence[Path],
    caption: str,
    results: Mapping[str, xr.Dataset],
) -> dict[str, Any]:
    """A figure or an animation for the page's template.

    Parameters
    ----------
    name : str
        Its name in the catalogue.
    entry : Entry
        Its entry there.
    files : sequence of Path
        The first is shown, the others can be downloaded.
    caption : str
        HTML.
    results : mapping
        Datasets by name, of which its tables can be downloaded.

    Returns
    -------
    dict
    """
    shown, *others = files
    content = shown.read_bytes()
    downloads = []
    for path in others:
        downloads.append(encode.download(f"{name}{path.suffix}", path.read_bytes()))
    for data in entry.data:
        table = tables.csv_of(results[data.dataset], data.variables)
        downloads.append(encode.download(data.name, table))
    return {
        "name": name,
        "title": entry.title,
        "category": entry.category,
        "moves": shown.suffix == ".gif",
        "image": encode.data_address(content, shown.name),
        "width": encode.width(content),
        "caption": Markup(caption),
        "downloads": downloads,
    }


def build(
    *,
    fault: dict[str, Any],
    friction: Friction,
    config: dict[str, Any],
    origin: Mapping[str, str],
    results: Mapping[str, xr.Dataset],
    pictures: Sequence[dict[str, Any]],
    patch_tables: Path,
    claims: list[dict[str, Any]],
    studies: dict[str, str],
    warnings: dict[str, list[str]],
) -> str:
    """The whole page as HTML; sections without content are left out.

    Parameters
    ----------
    results : mapping
        Datasets by name.
    pictures : sequence of dict
        Of :func:`picture`.
    claims : list of dict
        All claims with their verdicts.
    studies : dict
        Description of each study of the user, if the page begins with them.
    fault, friction, config, origin, patch_tables, warnings
        As for :func:`write`.

    Returns
    -------
    str
    """
    groups: dict[str, list[dict[str, Any]]] = {}
    for one in pictures:
        groups.setdefault(one["category"], []).append(one)
    by_name = {one["name"]: one for one in pictures}
    answer: dict[str, Any] | None = None
    sections: list[dict[str, Any]] = []
    fault_rows: list[dict[str, str]] = []
    run_rows: list[dict[str, str]] = []
    seconds = 0.0
    lengths = results.get("lengths")
    if lengths is not None:
        run_rows = tables.run_rows(lengths, tables.LENGTH_COLUMNS)
        seconds = float(lengths["wall_seconds"].sum())
        if studies:
            sections = summary.of_studies(studies, warnings, lengths)
            fault_rows = tables.fault_rows(lengths)
            groups.pop(catalogue.OWN, None)
        else:
            answer = summary.of_paper(lengths)
    if answer and "figure_3" in by_name:
        groups[catalogue.PAPER].remove(by_name["figure_3"])
    printed = {claim["id"]: claim["paper"] for claim in claims}
    return encode.template("template.html").render(
        calculator.shown(patch_tables, fault),
        level=3,
        answer=answer,
        printed=printed.get("length-shown"),
        groups=groups,
        pictures=by_name,
        studies=sections,
        fault_rows=fault_rows,
        lengths=run_rows,
        claims=verdicts.claim_rows(claims),
        counts=verdicts.verdict_counts(claims),
        table_s1=_parameters(friction),
        seconds=seconds,
        origin=_origin(origin, config, results),
    )


def _origin(
    origin: Mapping[str, str],
    config: dict[str, Any],
    results: Mapping[str, xr.Dataset],
) -> dict[str, Any]:
    """Versions, the configuration, and the origin of each dataset."""
    configuration = json.dumps(config, indent=2)
    datasets = []
    for name, dataset in results.items():
        attributes = dataset.attrs
        datasets.append(
            {
                "Dataset": name,
                "Code digest": attributes.get("code_digest", "")[:16],
                "Made": attributes.get("created", ""),
                "Made again by": attributes.get("command", ""),
            }
        )
    return {
        "versions": json.loads(origin["versions"]),
        "created": origin["created"],
        "digest": origin["code_digest"],
        "datasets": datasets,
        "config": configuration,
        "download": encode.download("configuration.json", configuration.encode()),
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
