"""Markers by law: the paper's as in its Figure 3, and one for any other law that there is."""

import numpy as np
import pytest
import xarray as xr

from replication.figures import figure_3, figure_3_extended, figure_patch, laws


def test_every_law_has_a_look_of_its_own():
    found = laws.looks(["slip", "halfway", "my_law", "aging", "slip"])
    assert list(found)[:4] == list(laws.PAPERS)
    assert {law for law, _ in found} == {"aging", "slip", "halfway", "my_law"}
    young = [(look.marker, look.colour) for (_, aged), look in found.items() if not aged]
    assert len(set(young)) == 4
    assert found["my_law", False].label == "my law law"


def table(*rows):
    law, initial_state = zip(*rows, strict=True)
    return xr.Dataset(
        {"evolution": ("run", list(law)), "initial_state": ("run", list(initial_state))}
    )


@pytest.mark.parametrize(
    ("rows", "shown"),
    [
        ([("slip", 1.0), ("aging", 1.0), ("aging", 1e3)], [1]),
        ([("slip", 1.0), ("halfway", 1.0), ("slip", 5.0)], [0]),
        ([("slip", 7.0), ("halfway", 1.0), ("slip", 5.0)], [0, 2]),
    ],
)
def test_what_is_shown_where_one_law_is(rows, shown):
    assert np.flatnonzero(laws.usual(table(*rows))).tolist() == shown


@pytest.fixture
def others(lengths):
    """The paper's lengths as if they were of laws that the paper does not have."""
    names = {"aging": "halfway", "slip": "third"}
    return lengths.assign(evolution=("run", [names[law] for law in lengths["evolution"].values]))


def test_other_laws_are_drawn_in_figure_3(theory, others, thick, thick_row):
    axes = figure_3.draw(theory, others, thick, thick_row).axes[0]
    labels = axes.get_legend_handles_labels()[1]
    assert {"FEM, halfway law", "FEM, third law"} <= set(labels)
    drawn = sum(len(container[0].get_xdata()) for container in axes.containers)
    papers = others["role"].values == "paper"
    assert drawn == np.isfinite(others["length"].values[papers]).sum()


def test_other_laws_are_drawn_beyond_the_paper(theory, others):
    patches = others.rename(length="stability_length", length_low="stability_length_low",
                            length_high="stability_length_high")  # fmt: skip
    left, right = figure_3_extended.draw(theory, others, patches, others).axes
    assert "halfway law" in [text.get_text() for text in right.get_legend().get_texts()]
    assert len(left.containers) > 3
    shown = figure_patch._shown(patches)
    assert set(shown["evolution"].values) == {"halfway"}
