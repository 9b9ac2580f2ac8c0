"""Variables are declared once, where they are made, and no dataset depends on another's."""

import io

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from declared import VARIABLES, declarations

from nucleation.datasets import code
from nucleation.datasets.variables import (
    Column,
    DatasetError,
    annotate,
    columns,
    first,
    require_annotated,
    rules,
    table,
    to_csv,
)
from nucleation.simulation.checkpoints import SIMULATION
from replication.tables import lengths

RECORDED = "nucleation.simulation.recorded"
ID = Column("id", "", "name", realisations=first)
LENGTH = Column("length", "m", "its length", "L", realisations=np.mean)
COLUMNS = columns(ID, LENGTH)
TEXTS = (
    "id study role evolution friction_law below far_side kind initial_stress status refinement "
    "varied variation fault ensemble outcome curve_fault curve_kind curve_study curve_below "
    "runaway_status stability_status plane loading name definition varies doubt set "
    "predicted_doubt regime"
)


def test_every_variable_is_described():
    assert len(VARIABLES) > 100
    for name, entry in VARIABLES.items():
        assert entry.long_name.strip() == entry.long_name != "", name
        assert name.isidentifier(), "CF wants letters, digits and underscores"
        assert entry.units or name in TEXTS.split(), name


def test_a_name_means_the_same_wherever_it_is_declared():
    for place, own in declarations().items():
        for name, entry in own.items():
            assert entry == VARIABLES[name], (place, name)


@pytest.mark.parametrize(
    ("root", "known"),
    [
        (SIMULATION, {RECORDED}),
        (
            code.Root("nucleation.extraction.growth"),
            {RECORDED, "nucleation.extraction.growth", "nucleation.extraction.definitions"},
        ),
    ],
)
def test_no_column_of_a_table_is_in_the_key_of_a_costly_dataset(root, known):
    declaring = {module for module, _ in declarations()}
    assert declaring & code.closure(root, code.ALWAYS) == known


def test_a_table_has_its_columns_in_their_order():
    found = table([{"length": 1.0, "id": "a", "other": 3}, {"length": 2.0, "id": "b"}], COLUMNS)
    assert list(found.data_vars) == ["id", "length"] and found.sizes == {"run": 2}
    assert found["length"].attrs == {"units": "m", "long_name": "its length", "symbol": "L"}
    assert found["id"].attrs == {"long_name": "name"}
    require_annotated(found)
    assert to_csv(found) == "id,length\na,1.0\nb,2.0\n"
    require_annotated(table([], COLUMNS))


def test_a_column_that_is_not_computed_is_named():
    with pytest.raises(DatasetError, match=r"not computed: \['length'\]"):
        table([{"id": "a", "length": 1.0}, {"id": "b"}], COLUMNS)


def test_a_column_that_is_declared_twice_is_an_error():
    with pytest.raises(DatasetError, match="length is declared twice"):
        columns(LENGTH, ID, Column("length", "m", "another"))


def test_a_column_of_a_table_over_realisations_has_a_rule():
    assert rules(COLUMNS) == {"id": first, "length": np.mean}
    with pytest.raises(DatasetError, match="column extra has no rule for the realisations"):
        rules(columns(ID, LENGTH, Column("extra", "m", "another")))


def test_annotating_leaves_the_original_and_the_others_alone():
    bare = xr.Dataset({"length": ("run", [1.0]), "other": ("run", np.ones(1))})
    found = annotate(bare, COLUMNS)
    assert found["length"].attrs["units"] == "m" and found["other"].attrs == {}
    assert bare["length"].attrs == {}
    with pytest.raises(DatasetError, match=r"\['other'\]"):
        require_annotated(found)
    require_annotated(found.drop_vars("other"))


def test_columns_of_the_table_of_lengths_have_a_unit_and_a_meaning():
    files = lengths.of_studies([table([], COLUMNS)])
    described = pd.read_csv(io.StringIO(files[".columns.csv"])).set_index("column")
    assert list(described.index) == list(lengths.COLUMNS | lengths.MEASURES)
    assert described.units["shear_modulus"] == "Pa" and described.units["length"] == "m"
    assert described.meaning.notna().all()
