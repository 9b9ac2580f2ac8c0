"""Evaluate the paper's claims."""

from pathlib import Path

from nucleation import datasets
from nucleation.claims import table
from nucleation.claims.evidence import Evidence
from nucleation.claims.measure import measure
from nucleation.elasticity import Material
from nucleation.friction import Friction
from nucleation.parameters import Loading
from nucleation.settings import ExtractionSettings
from nucleation.stability import InterfaceState


def by_id(paths):
    """Datasets with the ids of their runs, read one at a time."""
    return ((Path(path).stem, datasets.read(path)) for path in paths)


params, given = snakemake.params, snakemake.input
extraction = ExtractionSettings(**params.extraction)
evidence = Evidence(
    material=Material(**params.material),
    friction=Friction(**params.friction),
    loading=Loading(**params.loading),
    interface=InterfaceState(**params.main_text_interface),
    theory=datasets.read(given.theory),
    dispersion=datasets.read(given.dispersion),
    lengths=tuple(map(datasets.read, given.lengths)),
    measures={id: measure(dataset, extraction) for id, dataset in by_id(given.simulations)},
    patches=dict(by_id(given.patches)),
)
rows = table.evaluate(evidence)
datasets.write_text(table.to_json(rows), snakemake.output.json)
datasets.write_text(table.to_csv(rows), snakemake.output.csv)
datasets.write_text(table.to_markdown(rows), snakemake.output.markdown)
