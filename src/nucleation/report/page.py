"""Putting the report's page together."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import plotly.offline
import xarray as xr
from markupsafe import Markup

from ..analysis.record import parameters_of
from ..datasets import netcdf
from ..figures import catalogue, style
from ..figures.paper import table_s1
from ..model.friction.law import Friction
from ..model.linearised import InterfaceState
from ..model.material import Material
from ..patch.mode_history import ModeHistory
from ..report import answer, drop_law, encode, explorer, faults, own, stability, tables
from ..types import Array
from .captions import caption_html

HEIGHTS = np.geomspace(1e-3, 10.0, 721)
"""Heights (m) of the theory's curve in the page; of studies of one's own it reaches further."""

SEEN = (2e-3, 1.0)
"""Heights (m) that the page shows first; so close that the curve looks smooth on either axes."""

SCRIPTS = (
    "page.js", "plots.js", "tables.js", "theory.js", "stability.js", "explorer.js", "player.js",
    "drop.js",
)  # fmt: skip
"""What runs in the page, in this order; the first has what the others share."""

CURVES = ("slip_rate", "stress_ratio", "state")


class Picture(NamedTuple):
    """A figure or an animation of the page: files, caption's template and its parameters."""

    name: str
    title: str
    category: str
    files: list[Path]  # the first is shown, the others can be downloaded
    caption: str
    params: dict[str, Any]
    data: tuple[catalogue.Data, ...] = ()


class Player(NamedTuple):
    """The run in the player, thinned, and its entry of the table of lengths."""

    run: xr.Dataset  # of player.player_dataset
    row: xr.Dataset


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
    player: Player | None = None
    own: own.OwnStudies | None = None  # with which the page begins
    modes: Sequence[ModeHistory] = ()  # of quiet runs, for the law of the drop


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
    first = answer.answer(lengths) if content.own is None and lengths is not None else None
    if content.own is not None:
        groups.pop(catalogue.OWN, None)
    shown_above = {"figure_3"} if first else set()
    groups = {
        category: [picture for picture in group if picture["name"] not in shown_above]
        for category, group in groups.items()
    }
    printed = {claim["id"]: claim["paper"] for claim in content.claims or []}.get("length-shown")
    return encode.template("template.html").render(
        answer=first,
        printed=printed,
        styles=encode.source("page.css"),
        scripts=[Markup(plotly.offline.get_plotlyjs()), *map(encode.source, SCRIPTS)],
        data=encode.script_json(data),
        claims=tables.claim_rows(content.claims or []),
        counts=tables.verdict_counts(content.claims or []),
        controls=explorer.controls(content.material, content.interface),
        groups=groups,
        studies=own.sections(content.own, lengths) if content.own and lengths is not None else [],
        ends=data["heights"][:: len(data["heights"]) - 1],
        run_columns=own.RUN_COLUMNS,
        fault_columns=own.FAULT_COLUMNS,
        faults=own.fault_rows(lengths) if content.own and lengths is not None else [],
        pictures=pictures,
        table_s1=_parameters(content.friction),
        length_columns=tables.LENGTH_COLUMNS,
        lengths=tables.length_rows(lengths) if lengths is not None else [],
        drop=data["drop"],
        stability=data["stability"],
        drop_words=drop_law.WORDS,
        run=_run(content),
        origin=_origin(content),
    )


def _data(content: Content, lengths: xr.Dataset | None) -> dict[str, Any]:
    """What the page's code reads."""
    heights, seen = _heights(content, lengths)
    known = faults.faults(lengths) if lengths is not None else []
    return {
        "faults": [fault.in_page() for fault in known if fault.rigid] if len(known) > 1 else [],
        "seen": seen,
        "linear": 0.112 if content.own is None else seen[1] / 2.5,
        "start": 0.1 if content.own is None else float(f"{np.sqrt(seen[0] * seen[1]):.2g}"),
        "controls": explorer.controls(content.material, content.interface),
        "base": explorer.si_values(content.material, content.interface),
        "heights": heights.tolist(),
        "points": tables.point_series(lengths) if lengths is not None else [],
        "player": _player(content),
        "drop": drop_law.in_page(content.modes, content.friction, content.interface),
        "stability": stability.in_page(),
        "colours": {
            "theory": style.THEORY,
            "mark": style.VERMILLION,
            "fields": [style.BLUE, style.GREEN, style.PURPLE],
        },
    }


def _heights(content: Content, lengths: xr.Dataset | None) -> tuple[Array, list[float]]:
    """Heights (m) of the theory's curves, and the ends of those that are shown first."""
    if content.own is None or lengths is None:
        return HEIGHTS, list(SEEN)
    low, high = float(lengths["height"].min()), float(lengths["height"].max())
    ends = min(HEIGHTS[0], low / 10.0), max(HEIGHTS[-1], high * 10.0)
    points = int(HEIGHTS.size * np.log(ends[1] / ends[0]) / np.log(HEIGHTS[-1] / HEIGHTS[0]))
    return np.geomspace(*ends, points), [low / 3.0, 3.0 * high]


def _player(content: Content) -> dict[str, Any] | None:
    """The player's data: times in seconds from the onset, lengths in m, fields by frame."""
    if content.player is None:
        return None
    run, row = content.player
    loading = parameters_of(run).loading
    onset, length = (float(row[name]) for name in ("onset_time", "length"))
    start = onset if np.isfinite(onset) else 0.0
    fields = {
        "slip_rate": np.where(run["slip_rate"] > 0.0, run["slip_rate"], np.nan),
        "stress_ratio": run["shear_stress"].values / loading.normal_stress,
        "state": run["state"].values,
    }
    return {
        "onset": start,
        "length": length if np.isfinite(length) else None,
        "event": [run.attrs["event_start"] - start, run.attrs["event_end"] - start],
        "frames": run.sizes["time"],
        "x": encode.float32(run["x"]),
        "since": encode.float32(run["time"] - start),
        "edge": encode.float32(run["patch_length"]),
        "force_since": encode.float32(run["step_time"] - start),
        "force": encode.float32(-run["driving_force"] / 1e3),
        **{name: encode.float32(fields[name]) for name in CURVES},
    }


def _run(content: Content) -> dict[str, Any] | None:
    """What is said about the player's run, and its data to download."""
    if content.player is None:
        return None
    run, row = content.player
    parameters = parameters_of(run)
    below = parameters.below
    return {
        "id": str(row["id"].values),
        "height": parameters.geometry.height,
        "second_height": below.geometry.height if below else None,
        "onset": float(row["onset_time"]),
        "length": float(row["length"]),
        "frames": run.sizes["time"],
        "data": encode.download(f"{row['id'].values}.nc", _netcdf(run)),
    }


def _netcdf(dataset: xr.Dataset) -> bytes:
    """A dataset as the bytes of a netCDF file, numbers with single precision."""
    with tempfile.TemporaryDirectory() as directory:
        path = Path(directory, "run.nc")
        single = dataset.map(lambda v: v.astype("f4") if v.ndim > 1 else v, keep_attrs=True)
        netcdf.write(single, path)
        return path.read_bytes()


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
                "caption": Markup(caption_html(picture.caption, picture.params, content.config)),
                "downloads": downloads,
            }
        )
    return groups


def _table(results: Mapping[str, xr.Dataset], data: catalogue.Data) -> dict[str, str]:
    text = tables.csv_text(results[data.dataset], data.variables)
    return encode.download(data.name, text.encode())


def _origin(content: Content) -> dict[str, Any]:
    """Versions, the configuration, and which code made each dataset."""
    made = dict(content.results)
    if content.player is not None:
        made[f"simulations/{content.player.row['id'].values}"] = content.player.run
    configuration = json.dumps(content.config, indent=2)
    return {
        "versions": json.loads(content.provenance["versions"]),
        "created": content.provenance["created"],
        "digest": content.provenance["code_digest"],
        "datasets": [
            [tables.Cell(text, text) for text in (name, *_origin_of(dataset))]
            for name, dataset in made.items()
        ],
        "config": configuration,
        "download": encode.download("configuration.json", configuration.encode()),
    }


def _origin_of(dataset: xr.Dataset) -> tuple[str, ...]:
    digest, made, command = (
        dataset.attrs.get(key, "") for key in ("code_digest", "created", "command")
    )
    return digest[:16], made, command


def _parameters(friction: Friction) -> list[list[tables.Cell]]:
    """Table S1."""
    return [
        [tables.Cell(text, "") for text in (
            Markup("<i>{}</i>").format(row.symbol), table_s1.value_text(row.value), row.unit,
            row.description,
        )]
        for row in table_s1.rows(friction)
    ]  # fmt: skip
