"""The written files, and what all figures have in common."""

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


BLACK = {
    "figure.facecolor": "black", "axes.facecolor": "black", "savefig.facecolor": "black",
    "text.color": "white", "axes.grid": True, "font.size": 20, "savefig.bbox": "tight",
    "pdf.fonttype": 3, "axes.prop_cycle": mpl.cycler(color=["white"]),
}  # fmt: skip


@pytest.mark.parametrize("name", FIGURES)
def test_files_are_the_same_under_any_settings_small_and_embed_their_fonts(draw, name, tmp_path):
    figure = draw(name)
    inches = figure.get_size_inches()[0]
    assert np.isclose(2.54 * inches, [style.SINGLE_COLUMN, style.DOUBLE_COLUMN]).any()
    usual = [path.read_bytes() for path in style.save(figure, tmp_path / "deep" / "height-0.5")]
    names = ["height-0.5.pdf", "height-0.5.png"]
    assert sorted(path.name for path in (tmp_path / "deep").iterdir()) == names
    content = usual[0]
    assert content.startswith(b"%PDF") and b"/FontFile2" in content
    assert b"/Type3" not in content and b"CreationDate" not in content
    assert len(content) < 1_000_000
    with mpl.rc_context(BLACK):
        before = dict(mpl.rcParams)
        black = [path.read_bytes() for path in style.save(draw(name), tmp_path / "black")]
        assert dict(mpl.rcParams) == before
    assert black == usual


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
