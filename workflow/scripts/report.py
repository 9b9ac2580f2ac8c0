"""Write the report."""

import json
from pathlib import Path

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.analysis.lengths import row
from nucleation.figures import catalogue
from nucleation.model.friction.law import Friction
from nucleation.model.linearised import InterfaceState
from nucleation.model.material import Material
from nucleation.patch.mode_history import from_dataset
from nucleation.pipeline.job import Job
from nucleation.report import page
from nucleation.report.own import OwnStudies
from nucleation.report.player import player_dataset

with Job(snakemake, __file__) as job:
    params, given = job.params, job.input
    results = {Path(path).stem: job.read(path) for path in given.datasets}
    player = None
    if params.player:
        simulation = job.read(given.player)
        entry = row(results["lengths"], params.player)
        player = page.Player(
            player_dataset(simulation, entry, ExtractionSettings(**params.extraction)), entry
        )
    entries = catalogue.FIGURES | catalogue.of_studies(params.studies)
    pictures = []
    for name, caption in zip(params.figures, given.captions, strict=True):
        entry = entries[name]
        files = [Path(path) for path in given.figures if Path(path).stem == name]
        text = Path(caption).read_text(encoding="utf-8")
        pictures.append(
            page.Picture(
                name, entry.title, entry.category, files[::-1], text, params.captions.get(name, {}),
                entry.data,
            )
        )  # fmt: skip
    content = page.Content(
        material=Material(**params.material),
        friction=Friction(**params.friction),
        interface=InterfaceState(**params.main_text_interface),
        config=params.config,
        provenance=job.attributes(params.config),
        results=results,
        pictures=pictures,
        claims=json.loads(Path(given.claims).read_text(encoding="utf-8")) if given.claims else None,
        player=player,
        modes=[from_dataset(mode) for mode in job.read_all(given.modes)],
        own=OwnStudies(params.studies, params.warnings) if params.leads else None,
    )
    job.write_text(page.build(content), job.output[0])
