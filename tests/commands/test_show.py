"""``nucleation show``: every kind of dataset, its summary and its plot."""

import matplotlib as mpl
import pytest
from declared import VARIABLES
from matplotlib.image import imread

from nucleation.datasets import netcdf, provenance
from nucleation.datasets.variables import annotate
from nucleation.extraction.extraction import extract
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.run import simulate


def kept(folder, name, dataset, parameters):
    path = folder / f"{name}.nc"
    dataset = annotate(dataset, VARIABLES)
    netcdf.write(dataset, path, **provenance.attributes(parameters, "0" * 64, f"make {name}"))
    return path


@pytest.fixture(scope="module")
def files(tmp_path_factory, settings, simulation, table):
    """A dataset of each kind that is quickly made, by name."""
    folder = tmp_path_factory.mktemp("datasets")
    parameters = settings.runs[0].run
    short = parameters.replaced(end_time=0.02, time_after_event=0.01)
    return {
        "run": kept(folder, "run", simulation, parameters.to_dict()),
        "short": kept(folder, "short", simulate(short), short.to_dict()),
        "lengths": kept(folder, "lengths", table, {}),
    }


KINDS = {"run": "simulation", "short": "simulation", "lengths": "dataset"}


@pytest.mark.parametrize("name", KINDS)
def test_summary(nucleation, files, name):
    ended = nucleation("show", files[name])
    assert (ended.code, ended.err) == (0, "")
    lines = ended.out.splitlines()
    assert lines[0] == f"{files[name]}: {KINDS[name]}"
    assert f"command: make {name}" in lines
    assert any(line.startswith("versions: ") and "numpy" in line for line in lines)
    if name == "run":
        found = extract(netcdf.read(files["run"]))
        assert f"L: {found['length']:.4g} (" in ended.out
        assert f"onset: {found['onset_time']:.4g} (" in ended.out
        assert "status: completed: the event" in ended.out
        assert "normal_stress 1 MPa compressive" in " ".join(ended.out.split())
    assert ("no event" in ended.out) == (name == "short")


@pytest.mark.slow
def test_plot(nucleation, files, tmp_path):
    for name in ("short", "run"):
        plot = tmp_path / f"{name}.png"
        ended = nucleation("show", files[name], "--plot", plot)
        assert ended.code == 0 and f"plot: {plot}" in ended.out, ended.err
        image = imread(plot)
        assert min(image.shape[:2]) > 500 and image[..., :3].std() > 0.02
    with mpl.rc_context({"figure.facecolor": "black", "axes.grid": True}):  # of a user
        assert nucleation("show", files[name], "--plot", tmp_path / "own.png").code == 0
    assert (tmp_path / "own.png").read_bytes() == plot.read_bytes()
    pdf = ("show", files[name], "--plot", tmp_path / "plot.pdf", "--force")
    assert [nucleation(*pdf).code, nucleation(*pdf).code] == [0, 0]
    content = (tmp_path / "plot.pdf").read_bytes()
    assert content.startswith(b"%PDF") and b"CreationDate" not in content


BAD = [
    *({"parameters": text} for text in ("{}", '{"shear_modulus": "a text"}', "a text")),
    *({name: text} for name in ("wall_seconds", "steps") for text in (None, "a text")),
    {"status": None},
    {"parameters": None},
]


@pytest.mark.parametrize("bad", BAD, ids=str)
def test_a_sealed_file_of_another_kind_is_refused(nucleation, simulation, tmp_path, bad):
    """Such files ended in tracebacks."""
    path = tmp_path / "run.nc"
    origin = provenance.attributes(PAPER_RUN.to_dict(), "0" * 64, "make")
    attributes = simulation.attrs | origin | bad
    dataset = annotate(simulation.drop_attrs(deep=False), VARIABLES)
    netcdf.write(dataset, path, **{k: x for k, x in attributes.items() if x is not None})
    more = [("--json",), ("--plot", tmp_path / "plot.png")] if "parameters" in bad else []
    for words in ((), *more):
        ended = nucleation("show", path, *words)
        assert ended.code == 2 and ended.out == ""
        assert ended.err.startswith("Error: ") and "Traceback" not in ended.err


def test_escapes_of_a_file_do_not_reach_the_terminal(nucleation, simulation, tmp_path):
    escape = "\x1b]0;owned\x07"
    dataset = annotate(simulation.assign_attrs(status=f"completed{escape}"), VARIABLES)
    dataset["slip_rate"].attrs["long_name"] = f"rate{escape}"
    path = tmp_path / "run.nc"
    origin = provenance.attributes(PAPER_RUN.to_dict(), "0" * 64, f"make{escape}")
    netcdf.write(dataset, path, **origin)
    said = nucleation("show", path)
    assert said.code == 0 and "\\x1b]0;owned\\x07" in said.out
    assert not set(said.out + said.err) & {"\x1b", "\x07"}
