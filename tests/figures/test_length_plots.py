"""The picture of lengths over parameters: what is drawn, and that it is legible."""

import drawn_layout
import numpy as np
import pytest
import xarray as xr

from nucleation.model.quantities import ParameterError
from replication.figures import lengths

HEIGHT = np.geomspace(5.0, 500.0, 6)
STRESS = np.linspace(1.0, 4.0, 5)


def made_up(keys, *over, spread=1.2):
    """Lengths that rise with the height and fall with the stress."""
    shape = [values.size for _, values, _ in over]
    middle = np.ones([len(keys), *shape])
    for position, (_, values, power) in enumerate(over):
        middle = middle * (values**power).reshape(
            [-1 if i == position else 1 for i in range(len(over))]
        )
    middle = middle * np.arange(1, len(keys) + 1).reshape([-1] + [1] * len(over))
    ends = np.stack([middle / spread, middle, middle * spread], axis=1)
    names = [name for name, _, _ in over]
    coordinates = {
        name: (name, values, {"long_name": f"{name} of the block", "units": "mm"})
        for name, values, _ in over
    }
    return xr.Dataset(
        {"length": (("key", "end", *names), ends), "doubtful": (names, np.zeros(shape))},
        coords={"key": list(keys), "end": ["low", "middle", "high"], **coordinates},
    )


def test_lines_over_one_parameter():
    found = made_up(lengths.LOOKS, ("height", HEIGHT, 0.5))
    found["doubtful"][-2:] = 1.0
    figure = lengths.draw(found, specimen=5.0, band="expected range of $L$")
    drawn_layout.require_legible(figure)
    (axes,) = figure.axes
    lines = axes.get_lines()
    for key, line in zip(
        ("critical_length", "stability_length", "expected_length"), lines, strict=False
    ):
        np.testing.assert_allclose(line.get_ydata(), found["length"].sel(key=key, end="middle"))
    assert len({line.get_linestyle() for line in lines[:3]}) == 3  # without colours too
    assert len(axes.collections) == 3  # bands
    assert [5.0, 5.0] in [list(line.get_ydata()) for line in lines]
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert "specimen, 5 m" in texts and "not to be relied upon" in texts
    assert "expected range of $L$" in texts
    assert axes.get_xlabel() == "Height of the block (mm)" and axes.get_xscale() == "log"


def test_a_map_over_two_parameters():
    found = made_up(["stability_length"], ("height", HEIGHT, 0.5), ("stress", STRESS, -1.0))
    found["length"][:, :, 0, 0] = np.nan
    figure = lengths.draw(found, specimen=4.0)
    drawn_layout.require_legible(figure)
    axes, bar = figure.axes
    image = axes.collections[0]
    np.testing.assert_allclose(
        np.ma.filled(image.get_array(), np.nan).ravel(),
        found["length"]
        .sel(key="stability_length", end="middle")
        .transpose("stress", "height")
        .values.ravel(),
    )
    assert "m" in bar.get_ylabel() and axes.get_xscale() == "log" and axes.get_yscale() == "linear"
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert texts == ["specimen, 4 m", "at 5 and 95 % of the draws", "no length"]
    contour = axes.collections[1].get_paths()[0].vertices
    np.testing.assert_allclose(contour[:, 0] ** 0.5 / contour[:, 1], 4.0, rtol=0.15)


def test_infinite_quantiles_are_left_out_and_nothing_is_refused():
    found = made_up(["critical_length"], ("height", HEIGHT, 0.5))
    found["length"].loc[{"end": "high"}] = np.inf
    figure = lengths.draw(found)
    assert np.isfinite(figure.axes[0].get_ylim()).all()
    with pytest.raises(ParameterError, match="no length to draw"):
        lengths.draw(found * np.nan)
