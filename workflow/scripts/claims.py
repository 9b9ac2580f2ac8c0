"""Evaluate the paper's claims."""

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
    evidence = Evidence(
        material=Material(**params.material),
        friction=Friction(**params.friction),
        loading=Loading(**params.loading),
        interface=InterfaceState(**params.main_text_interface),
        theory=job.read(given.theory),
        dispersion=job.read(given.dispersion),
        lengths=tuple(job.read_all(given.lengths)),
        measures={id: measure(dataset, extraction) for id, dataset in simulations},
        patches=dict(zip(params.patch_ids, job.read_all(given.patches), strict=True)),
    )
    rows = table.evaluate(evidence)
    job.write_text(table.to_json(rows), job.output.json)
    job.write_text(table.to_csv(rows), job.output.csv)
    job.write_text(table.to_markdown(rows), job.output.markdown)
