"""Markers by law: the paper's as in its Figure 3, and one for any other law that there is."""

import pytest
import xarray as xr

from replication.figures import figure_3, figure_patch, laws


def table(*rows):
    law, initial_state = zip(*rows, strict=True)
    return xr.Dataset(
        {"evolution": ("run", list(law)), "initial_state": ("run", list(initial_state))}
    )


def test_every_law_has_a_look_of_its_own():
    names = ["slip", "halfway", "my_law", "aging", "slip"]
    found = list(laws.kinds(table(*((name, 1.0) for name in names), ("slip", 5.0))))
    assert [name for name, *_ in found] == [
        "aging law", "slip law", "slip law", "halfway law", "my law law"
    ]  # fmt: skip
    assert [old for _, old, *_ in found] == [False, False, True, False, False]
    assert len({(marker, colour) for *_, (marker, _, colour, _), _ in found}) == 5


@pytest.mark.parametrize(
    ("rows", "shown"),
    [
        ([("slip", 1.0), ("aging", 1.0), ("aging", 1e3)], [("aging", 1.0)]),
        ([("slip", 1.0), ("halfway", 1.0), ("slip", 5.0)], [("slip", 1.0)]),
        ([("slip", 7.0), ("halfway", 1.0), ("slip", 5.0)], [("slip", 7.0), ("slip", 5.0)]),
    ],
)
def test_what_is_shown_where_one_law_is(rows, shown):
    found = figure_patch.shown(table(*rows).assign(role=("run", ["own"] * 3)))
    assert list(zip(found["evolution"].values, found["initial_state"].values, strict=True)) == shown


@pytest.fixture
def others(lengths):
    """The paper's lengths as if they were of laws that the paper does not have."""
    names = {"aging": "halfway", "slip": "third"}
    return lengths.assign(evolution=("run", [names[law] for law in lengths["evolution"].values]))


def test_other_laws_are_drawn(theory, others, thick):
    axes = figure_3.draw(theory, others, thick, "paper-7").axes[0]
    labels = axes.get_legend_handles_labels()[1]
    assert {"FEM, halfway law", "FEM, third law"} <= set(labels)
    drawn = sum(len(container[0].get_xdata()) for container in axes.containers)
    assert drawn == 11  # of the paper's runs that have a length
    columns = ("length", "length_low", "length_high")
    patches = others.rename({name: f"stability_{name}" for name in columns})
    left, right = figure_3.draw_extended(theory, others, patches, others).axes
    assert "halfway law" in [text.get_text() for text in right.get_legend().get_texts()]
    assert len(left.containers) > 3
    assert set(figure_patch.shown(patches)["evolution"].values) == {"halfway"}
