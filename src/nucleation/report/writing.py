"""From the workflow's results to the report: the step ``report``."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from ..analysis.definitions import ExtractionSettings
from ..analysis.lengths import row
from ..figures import catalogue
from ..model.friction.law import Friction
from ..model.linearised import InterfaceState
from ..model.material import Material
from . import page
from .answer import OwnStudies
from .player import thinned_run


def write(
    origin: Mapping[str, str], figures: Sequence[Path], names: Sequence[str],
    captions: Sequence[Path], caption_values: Mapping[str, dict[str, Any]],
    datasets: Sequence[xr.Dataset], dataset_names: Sequence[str],
    player: Sequence[xr.Dataset], player_id: str,
    claims: Sequence[Path], page_files: Sequence[Path], studies: dict[str, str],
    warnings: dict[str, list[str]], leads: bool, material: Material, friction: Friction,
    interface: InterfaceState, settings: ExtractionSettings, config: dict[str, Any],
) -> dict[str, str]:  # fmt: skip
    """The page as HTML.

    Parameters
    ----------
    origin : of the page, from :func:`nucleation.datasets.provenance.attributes`.
    figures, names : pictures and their names in the catalogue.
    captions, caption_values : templates in the same order, and what is filled in, by name.
    datasets, dataset_names : tables behind the figures.
    player, player_id : the run that is played, or none.
    claims : the claims as JSON, or none.
    page_files : on which the page depends as well.
    studies, warnings, leads : studies of the user's own, and whether the page begins with them.
    material, friction, interface, settings, config : of the configuration.
    """
    results = dict(zip(dataset_names, datasets, strict=True))
    entries = catalogue.FIGURES | catalogue.of_studies(studies)
    pictures = [
        page.Picture(
            name, entries[name].title, entries[name].category, _with_pdf(path),
            caption.read_text("utf-8"), caption_values.get(name, {}), entries[name].data,
        )
        for name, path, caption in zip(names, figures, captions, strict=True)
    ]  # fmt: skip
    played = None
    if player:
        entry = row(results["lengths"], player_id)
        played = page.Played(thinned_run(player[0], entry, settings), entry)
    content = page.Content(
        material, friction, interface, config, dict(origin), results, pictures,
        claims=json.loads(claims[0].read_text("utf-8")) if claims else None,
        player=played,
        own=OwnStudies(studies, warnings) if leads else None,
    )  # fmt: skip
    return {".html": page.build(content)}


def _with_pdf(picture: Path) -> list[Path]:
    """A picture, and the same as PDF if there is one."""
    return [path for path in (picture, picture.with_suffix(".pdf")) if path.is_file()]
