"""The written files, and what all figures have in common."""

import itertools
import os
import subprocess
import sys
from pathlib import Path

import drawn_layout
import matplotlib as mpl
import numpy as np
import pytest

from nucleation.pictures import run, style
from replication.figures import figure_1, figure_3
from replication.figures import theory as theory_figures

pytestmark = pytest.mark.slow
LEGENDS = {"figure_1": 0, "figure_2": 1, "figure_3": 2, "figure_s1": 1, "figure_s2": 0}
SOURCE = Path(style.__file__).parents[2]


@pytest.fixture
def draw(theory, lengths, thin, thin_row, thick):
    """Draw a figure by name."""
    calls = {
        "figure_1": figure_1.draw,
        "figure_2": lambda: theory_figures.figure_2(theory),
        "figure_3": lambda: figure_3.draw(theory, lengths, thick, "paper-7"),
        "figure_s1": lambda: theory_figures.figure_s1(theory),
        "figure_s2": lambda: run.draw(thin, thin_row),
    }
    return lambda name: calls[name]()


BLACK = {
    "figure.facecolor": "black",
    "axes.facecolor": "black",
    "savefig.facecolor": "black",
    "text.color": "white",
    "axes.grid": True,
    "font.size": 20,
    "savefig.bbox": "tight",
    "pdf.fonttype": 3,
    "axes.prop_cycle": mpl.cycler(color=["white"]),
}


def test_a_failed_write_leaves_the_old_file_alone(tmp_path, monkeypatch):
    target = tmp_path / "figure.pdf"
    target.write_text("old")
    figure = figure_1.draw()

    def fail(path, **_):
        Path(path).write_text("half")
        raise OSError("disk full")

    monkeypatch.setattr(figure, "savefig", fail)
    with pytest.raises(OSError, match="disk full"):
        style.save(figure, tmp_path / "figure")
    assert [p.name for p in tmp_path.iterdir()] == ["figure.pdf"]
    assert target.read_text() == "old"


@pytest.mark.parametrize("name", LEGENDS)
def test_figures_are_legible_and_their_files_small_with_fonts_of_their_own(draw, name, tmp_path):
    """No text overlaps or is cut, and no legend covers data."""
    figure = draw(name)
    drawn_layout.require_legible(figure)
    legends = [a.get_legend() for a in drawn_layout.all_axes(figure) if a.get_legend()]
    assert len(legends) == LEGENDS[name]
    lines = [(axes, line) for axes in figure.axes for line in axes.get_lines()]
    for (axes, line), legend in itertools.product(lines, legends):
        if line.get_transform() == axes.transData:
            x, y = line.get_data()
            position = np.linspace(0, len(x) - 1, 2000)
            x, y = (np.interp(position, np.arange(len(x)), values) for values in (x, y))
            box = legend.get_window_extent()
            assert drawn_layout.points_inside(axes, x, y, box) == 0, line.get_label()
    inches = figure.get_size_inches()[0]
    assert np.isclose(2.54 * inches, [style.SINGLE_COLUMN, style.DOUBLE_COLUMN]).any()
    usual = [path.read_bytes() for path in style.save(draw(name), tmp_path / "deep" / "height-0.5")]
    names = ["height-0.5.pdf", "height-0.5.png"]
    assert sorted(path.name for path in (tmp_path / "deep").iterdir()) == names
    content = usual[0]
    assert content.startswith(b"%PDF") and b"/FontFile2" in content
    assert b"/Type3" not in content and b"CreationDate" not in content
    assert len(content) < 1_000_000
    with mpl.rc_context(BLACK):  # nobody's own settings matter
        before = dict(mpl.rcParams)
        black = [path.read_bytes() for path in style.save(draw(name), tmp_path / "black")]
        assert dict(mpl.rcParams) == before
    assert black == usual


CODE = """
import sys
from nucleation.pictures import style
from replication.figures import figure_1
style.save(figure_1.draw(), sys.argv[1])
"""


def test_bytes_depend_on_no_hash_seed(draw, tmp_path):
    usual = [path.read_bytes() for path in style.save(draw("figure_1"), tmp_path / "usual")]
    environment = {**os.environ, "PYTHONHASHSEED": "1", "PYTHONPATH": str(SOURCE)}
    command = [sys.executable, "-c", CODE, str(tmp_path / "seed")]
    subprocess.run(command, check=True, env=environment, timeout=600)
    assert [(tmp_path / f"seed.{kind}").read_bytes() for kind in ("pdf", "png")] == usual
