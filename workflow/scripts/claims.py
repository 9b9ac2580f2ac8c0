"""Evaluate the paper's claims."""

import itertools

from nucleation.analysis import lengths
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.claims import table
from nucleation.claims.evidence import Evidence
from nucleation.claims.measure import measure
from nucleation.model.friction.law import Friction
from nucleation.model.linearised import InterfaceState
from nucleation.model.material import Material
from nucleation.model.parameters import Loading
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    params, given = job.params, job.input
    extraction = ExtractionSettings(**params.extraction)
    simulations = zip(params.ids, job.read_all(given.simulations), strict=True)
    blocks, tables = list(job.read_all(given.longer)), list(job.read_all(given.lengths))
    longer = zip([run["id"] for run in params.longer], blocks, strict=True)
    if blocks:
        tables.append(lengths.gather(params.longer, blocks, extraction))
    evidence = Evidence(
        material=Material(**params.material),
        friction=Friction(**params.friction),
        loading=Loading(**params.loading),
        interface=InterfaceState(**params.main_text_interface),
        theory=job.read(given.theory),
        dispersion=job.read(given.dispersion),
        lengths=tuple(tables),
        measures={
            id: measure(dataset, extraction) for id, dataset in itertools.chain(simulations, longer)
        },
        patches=dict(zip(params.patch_ids, job.read_all(given.patches), strict=True)),
    )
    rows = table.evaluate(evidence)
    job.write_text(table.to_json(rows), job.output.json)
    job.write_text(table.to_csv(rows), job.output.csv)
    job.write_text(table.to_markdown(rows), job.output.markdown)
