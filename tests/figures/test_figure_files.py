"""The written files, and what all figures have in common."""

import os
import subprocess
import sys
from pathlib import Path

import drawn_layout
import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.image import imread

from nucleation.pictures import run, style
from replication.figures import figure_1, figure_3
from replication.figures import theory as theory_figures

pytestmark = pytest.mark.slow

FIGURES = ("figure_1", "figure_2", "figure_3", "figure_s1", "figure_s2")
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


@pytest.mark.parametrize("name", FIGURES)
def test_files_are_reproducible_small_and_embed_their_fonts(draw, name, tmp_path):
    pdf, png = style.save(draw(name), tmp_path / "deep" / "a")
    again = style.save(draw(name), tmp_path / "deep" / "b")
    assert [pdf.read_bytes(), png.read_bytes()] == [path.read_bytes() for path in again]
    assert sorted(p.name for p in pdf.parent.iterdir()) == ["a.pdf", "a.png", "b.pdf", "b.png"]
    content = pdf.read_bytes()
    assert content.startswith(b"%PDF") and b"/FontFile2" in content
    assert b"/Type3" not in content and b"CreationDate" not in content
    assert len(content) < 1_000_000
    width = imread(png).shape[1] / 300.0
    assert np.isclose(
        width, [style.SINGLE_COLUMN / 2.54, style.DOUBLE_COLUMN / 2.54], atol=0.01
    ).any()


@pytest.mark.parametrize("name", FIGURES)
def test_text_is_legible_and_neither_overlaps_nor_is_cut(draw, name):
    figure = draw(name)
    drawn_layout.require_legible(figure)


@pytest.mark.parametrize("name", ["figure_2", "figure_3", "figure_s1", "figure_s2"])
def test_legends_cover_no_data(draw, name):
    figure = draw(name)
    drawn_layout.boxes(figure)  # lays it out
    legends = [a.get_legend() for a in drawn_layout.all_axes(figure) if a.get_legend()]
    assert len(legends) == {"figure_2": 1, "figure_3": 2, "figure_s1": 1, "figure_s2": 0}[name]
    for legend in legends:
        box = legend.get_window_extent()
        for axes in figure.axes:
            for line in axes.get_lines():
                if line.get_transform() != axes.transData:
                    continue
                x, y = line.get_data()
                position = np.linspace(0, len(x) - 1, 2000)
                x, y = (np.interp(position, np.arange(len(x)), values) for values in (x, y))
                assert drawn_layout.points_inside(axes, x, y, box) == 0, line.get_label()


def test_bytes_depend_on_no_hash_seed(tmp_path):
    code = (
        "import sys; from nucleation.pictures import style;"
        "from replication.figures import figure_1;"
        "style.save(figure_1.draw(), sys.argv[1])"
    )
    for seed in ("1", "2"):
        environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": str(SOURCE)}
        command = [sys.executable, "-c", code, str(tmp_path / seed)]
        subprocess.run(command, check=True, env=environment, timeout=600)
    for suffix in ("pdf", "png"):
        assert (tmp_path / f"1.{suffix}").read_bytes() == (tmp_path / f"2.{suffix}").read_bytes()


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


def test_stems_with_dots_keep_them(tmp_path):
    pdf, png = style.save(figure_1.draw(), tmp_path / "height-0.005")
    assert (pdf.name, png.name) == ("height-0.005.pdf", "height-0.005.png")


BLACK = {
    "figure.facecolor": "black", "axes.facecolor": "black", "savefig.facecolor": "black",
    "text.color": "white", "axes.grid": True, "font.size": 20, "savefig.bbox": "tight",
    "pdf.fonttype": 3, "axes.prop_cycle": mpl.cycler(color=["white"]),
}  # fmt: skip


@pytest.mark.parametrize("name", FIGURES)
def test_settings_of_matplotlib_change_no_byte_and_stay(draw, name, tmp_path):
    usual = [path.read_bytes() for path in style.save(draw(name), tmp_path / "usual")]
    with mpl.rc_context(BLACK):
        before = dict(mpl.rcParams)
        black = [path.read_bytes() for path in style.save(draw(name), tmp_path / "black")]
        assert dict(mpl.rcParams) == before
    assert black == usual
