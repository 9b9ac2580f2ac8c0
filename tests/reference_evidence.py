"""The evidence of claims from the committed reference set: tables without simulations."""

import copy
import dataclasses
import functools
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
import yaml
from configurations import papers

from replication.claims import table as table_of_claims
from replication.claims.evidence import Evidence
from replication.tables.curves import theory_dataset

ROOT = Path(__file__).parents[1]
REFERENCE = ROOT / "results" / "reference"
ROLES = ("paper", "converged")


def table(name):
    """A table of the reference set on the dimension run; that of lengths with all its columns."""
    frame = pd.read_csv(REFERENCE / name)
    if name == "lengths.csv":
        frame = frame.merge(pd.read_csv(REFERENCE / "measures.csv"), on="id")
    return xr.Dataset({column: ("run", frame[column].to_numpy()) for column in frame})


def of_role(tables, role):
    return tables.isel(run=np.flatnonzero(tables["role"].values == role))


def modes(name):
    """A table of modes with their rates on ``branch`` as well."""
    both = [table(name).to_dataframe().query("branch == @n").reset_index(drop=True) for n in (0, 1)]
    found = {column: ("run", both[0][column].to_numpy()) for column in both[0]}
    rates = [
        f"{kind}_{part}" for kind in ("measured", "theory") for part in ("growth", "frequency")
    ]
    for column in (*rates, "disagreement"):
        found[column] = ("run", "branch"), np.stack([own[column] for own in both], axis=1)
    del found["branch"]
    return xr.Dataset(found)


def evidence(**changes):
    """Evidence of the full configuration; theory's curves at a few points."""
    return dataclasses.replace(_evidence(), **changes)


CLAIMS = ROOT / "src" / "replication" / "claims" / "claims.yaml"
STATED = yaml.safe_load(CLAIMS.read_text(encoding="utf-8"))
PAIRED = {subject: STATED.pop(subject) for subject in ["two bodies, simulated"]}
ENTRIES = {id: entry for entries in STATED.values() for id, entry in entries.items()}


def in_pairs(statements):
    return [(subject, entries.items()) for subject, entries in statements.items()]


def judged(id, evidence):
    """The row of one claim that needs no pairs."""
    return table_of_claims.evaluate_one(id, ENTRIES[id], evidence)


def evaluate(evidence):
    """The claims that need no pairs, on some evidence."""
    return table_of_claims.evaluate(in_pairs(STATED), evidence)


def evaluated():
    """All claims on it."""
    return copy.deepcopy(_evaluated())


@functools.cache
def _evaluated():
    return evaluate(_evidence())


@functools.cache
def _evidence():
    config = papers()
    lengths = table("lengths.csv")
    patches = table("patch_stability.csv")
    curves = dataclasses.replace(config.curves, slip_rates=(1e-6, 1e-5))
    by_id = {}
    for i, id in enumerate(patches["id"].values):
        by_id[str(id)] = patches.isel(run=i)
    theory = theory_dataset(config.base, dataclasses.asdict(curves))
    return Evidence(
        base=config.base,
        theory=theory,
        dispersion=modes("dispersion.csv"),
        lengths=tuple(of_role(lengths, role) for role in ROLES),
        patches=by_id,
    )
