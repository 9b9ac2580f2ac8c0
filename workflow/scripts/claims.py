"""Evaluate the paper's claims."""

from pathlib import Path

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.claims import table
from nucleation.claims.evidence import Evidence
from nucleation.claims.measure import measure
from nucleation.datasets import netcdf
from nucleation.model.friction.law import Friction
from nucleation.model.linearised import InterfaceState
from nucleation.model.material import Material
from nucleation.model.parameters import Loading


def by_id(paths):
    """Datasets with the ids of their runs, read one at a time."""
    return ((Path(path).stem, netcdf.read(path)) for path in paths)


params, given = snakemake.params, snakemake.input
extraction = ExtractionSettings(**params.extraction)
evidence = Evidence(
    material=Material(**params.material),
    friction=Friction(**params.friction),
    loading=Loading(**params.loading),
    interface=InterfaceState(**params.main_text_interface),
    theory=netcdf.read(given.theory),
    dispersion=netcdf.read(given.dispersion),
    lengths=tuple(map(netcdf.read, given.lengths)),
    measures={id: measure(dataset, extraction) for id, dataset in by_id(given.simulations)},
    patches=dict(by_id(given.patches)),
)
rows = table.evaluate(evidence)
netcdf.write_text(table.to_json(rows), snakemake.output.json)
netcdf.write_text(table.to_csv(rows), snakemake.output.csv)
netcdf.write_text(table.to_markdown(rows), snakemake.output.markdown)
