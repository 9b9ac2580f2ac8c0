"""Wrong command lines: each ends with one clear message, exit code 2, and nothing done."""

import os
import re

import numpy as np
import pytest
import xarray as xr
from declared import VARIABLES

from nucleation.datasets import netcdf
from nucleation.datasets.variables import annotate

GOOD = {
    "--shear-modulus": "30GPa",
    "--poisson-ratio": "0.25",
    "--normal-stress": "50MPa",
    "--a": "0.010",
    "--b": "0.015",
    "--slip-distance": "5um",
}


def length(**changes):
    """The words of a command line of ``length`` with other options; None leaves one out."""
    options = GOOD | {f"--{k.replace('_', '-')}": v for k, v in changes.items()}
    return ["length", *(word for k, v in options.items() if v is not None for word in (k, v))]


LENGTH = [
    (length(shear_modulus="5um"), ["--shear-modulus", "'5um'", "of length", "[1e-09, 1e+13) Pa"]),
    (length(shear_modulus="nan"), ["'nan'", "no number"]),
    (length(shear_modulus=None), ["shear_modulus is missing: give --shear-modulus"]),
    (length(b=None), ["zeta or b", "one of them and not both"]),
    (length(zeta_over_a="0.5"), ["zeta_over_a is not allowed together with zeta or b"]),
    (length(height="0"), ["height = 0.0 m", "[1e-12, inf] m"]),
    (length(far_side="glued"), ["far_side = 'glued'", "velocity, free"]),
    (length(weakening_rate="5 MPa"), ["weakening_rate", "Pa/m is needed"]),
    (length(second_body="steel"), ["second_body = 'steel'", "rigid, deformable"]),
    (length(second_shear_modulus="60GPa"), ["friction is missing"]),
    (length(normal_stress="5,0MPa (4 to 6)"), ["write a decimal point, 5.0 in place of 5,0"]),
    (length(shear_modulos="1"), ["No such option '--shear-modulos'", "--shear-modulus"]),
    ([*length(), "extra"], ["unexpected extra argument"]),
    ([*length(height="10"), "cm"], ["write a value and its unit as one word, 10cm"]),
    (["lenght"], ["there is no command 'lenght'; did you mean length?"]),
    (["--nonsense"], ["No such option '--nonsense'"]),
    (["length", "--Dc", "1"], ["No such option '--Dc'; did you mean --slip-distance?"]),
    (["show", "run.nc", "--plott", "1"], ["No such option '--plott'; did you mean --plot?"]),
    (length(parameters="other.yaml"), ["unknown key; known: shear_modulus"]),
]
SIMULATE = [
    ([], ["Missing argument 'OUTPUT'"]),
    (["run.txt"], ["OUTPUT = 'run.txt'", "must end in .nc"]),
    (["there.nc"], ["there.nc exists already", "--force"]),
    (["file/run.nc"], ["can't be written", "no writable directory"]),
    (["no/where/run.nc"], ["there is no directory", "no/where; mkdir -p", "no/where"]),
    (["new.nc", "--paper", "--height", "5 s"], ["--height", "m is needed", "[1e-12, inf] m"]),
    (["new.nc", "--paper", "--n-x", "60.5"], ["n_x = '60.5' is not", "an integer in [8, 100000]"]),
    (["new.nc", "--paper", "--zeta-over-a", "-0.5"], ["needs its block_length"]),
    (["new.nc", "--paper", "--seed", "3"], ["seed = 3", "none"]),
    (["new.nc", "--paper", "--strength", "1e-5"], ["strength = ", "none"]),
    (["new.nc", "--paper", "--n-x", "20000"], ["n_x = 20000", "MB", "memory"]),
    (["new.nc", "--paper", "--memory", "1 GPa"], ["memory", "MB is needed"]),
    (["new.nc", "--paper", "--aging-coefficient", "0"], ["a + zeta = 0 is not positive"]),
    (["new.nc", "--paper", "--a", "0.01", "--aging-coefficient", "0.1"], ["not allowed together"]),
    (["new.nc", "--paper", "--a", "2"], ["no friction law has", "a = 2,"]),
    (["new.nc", "--parameters", "list.yaml"], ["list.yaml must hold a mapping"]),
    (["new.nc", "--parameters", "broken.yaml"], ["broken.yaml is not valid YAML"]),
    (["new.nc", "--parameters", "unknown.yaml"], ["heigth = '5mm'", "did you mean height"]),
    (["new.nc", "--parameters", "other.yaml"], ["unknown key; known: ", "n_x"]),
    (["new.nc", "--parameters", "twice.yaml"], ["height is given twice"]),
    (["new.nc", "--parameters", "foreign.nc"], ["foreign.nc is not valid YAML"]),
]
SHOW = [
    ([], ["Missing argument 'FILE'"]),
    (["none.nc"], ["none.nc", "does not exist"]),
    (["foreign.nc"], ["foreign.nc is damaged, or not of this project"]),
    (["theory.nc", "--plot", "theory.jpg"], ["theory.jpg", ".png or .pdf"]),
    (["plain.nc", "--plot", "new.png"], ["a plot of simulations alone"]),
]
LINES = [
    *LENGTH,
    *((["simulate", *words], said) for words, said in SIMULATE),
    *((["show", *words], said) for words, said in SHOW),
]


@pytest.fixture(scope="module")
def directory(tmp_path_factory):
    """Files that command lines name."""
    folder = tmp_path_factory.mktemp("files")
    texts = {
        "there.nc": "",
        "file": "no netCDF",
        "list.yaml": "- 1\n",
        "broken.yaml": "a: [1\n",
        "unknown.yaml": "heigth: 5mm\n",
        "twice.yaml": "height: 1\nheight: 2\n",
        "other.yaml": "xyzzy: 1.0\n",
    }
    for name, text in texts.items():
        (folder / name).write_text(text)
    curve = ("height", np.ones(2))
    theory = {"critical_length": curve, "thin_limit_length": curve}
    height = {"height": np.arange(2.0)}
    netcdf.write(annotate(xr.Dataset(theory, height), VARIABLES), folder / "theory.nc")
    plain = annotate(xr.Dataset({"x": ("n", np.ones(2))}), VARIABLES)
    netcdf.write(plain, folder / "plain.nc")
    xr.Dataset({"x": ("n", np.ones(2))}).to_netcdf(folder / "foreign.nc")
    return folder


@pytest.mark.parametrize(("words", "said"), LINES, ids=lambda x: " ".join(x)[-60:])
def test_bad_command_lines(nucleation, directory, monkeypatch, words, said):
    monkeypatch.chdir(directory)
    before = sorted(directory.iterdir())
    ended = nucleation(*words)
    message = " ".join(ended.err.split())
    assert ended.code == 2 and ended.out == ""
    assert "Error: " in message and "Traceback" not in message
    assert all(text in message for text in said), message
    assert not re.search(r"configuration|limits\.|studies|runs\[", message)
    assert sorted(directory.iterdir()) == before


@pytest.mark.parametrize("words", [["show", "x.nc"], ["simulate", "x.nc"], length()])
def test_wrong_time_of_results_is_refused_by_every_command(nucleation, monkeypatch, words):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "abc")
    ended = nucleation(*words)
    assert ended.code == 2 and "Error: SOURCE_DATE_EPOCH = 'abc' is not allowed" in ended.err


def test_a_pipe_that_nobody_writes_to_does_not_block(nucleation, tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")
    ended = nucleation(*length(), "--parameters", str(tmp_path / "pipe.csv"))
    assert ended.code == 2 and "pipe.csv can't be read" in " ".join(ended.err.split())
