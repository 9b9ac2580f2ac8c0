"""The committed tables of the calculator are those of the library as it is."""

import json
import runpy

import numpy as np
import pytest
from docs.samples import ROOT

pytestmark = pytest.mark.slow

HOME = ROOT / "docs" / "calculator"
TABLES = json.loads((HOME / "tables.json").read_text())
FUNCTIONS = {
    ("stability", "identical_layers"): "stability_of_layers",
    ("stability", "rigid_base"): "stability_on_base",
    ("stability", "half_spaces"): "stability_of_half_spaces",
    ("runaway", "identical_layers"): "runaway_at",
    ("runaway", "rigid_base"): "runaway_at",
    ("law", "identical_layers"): "law_at",
    ("law", "rigid_base"): "law_at",
}
PRECISION = {"stability": 1e-4, "runaway": 0.02, "law": 2e-3}
"""Of the logarithms; slow slip is chaotic, so that L_run depends on the processor."""


@pytest.fixture(scope="module")
def made():
    """What makes the tables."""
    return runpy.run_path(str(HOME / "tables.py"))


@pytest.mark.parametrize(("length", "bodies"), FUNCTIONS)
def test_a_node_of_a_table_has_what_the_library_computes_there(made, length, bodies):
    table = TABLES[length][bodies]
    shape = [len(own) for own in table["nodes"].values()]
    chosen = np.random.default_rng(7).integers(np.prod(shape))
    at = np.unravel_index(chosen, shape)
    point = [nodes[i] for nodes, i in zip(table["nodes"].values(), at, strict=True)]
    found = np.ravel(np.log(made[FUNCTIONS[length, bodies]](*point)))
    expected = np.array(table["logs"])[:, chosen]
    np.testing.assert_allclose(found, expected, atol=PRECISION[length])


def test_every_table_is_made(made):
    assert {(length, own) for length, tables in TABLES.items() for own in tables} == set(FUNCTIONS)
