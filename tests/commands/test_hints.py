"""Unknown names of options and of keys in files are answered with the names of this command."""

import pytest

FAULT = (
    *("--shear-modulus", "30GPa", "--poisson-ratio", "0.25", "--normal-stress", "50MPa"),
    *("--a", "0.010", "--b", "0.015", "--slip-distance", "5um"),
)


@pytest.mark.parametrize(
    ("command", "unknown", "answer"),
    [
        (["length"], "--Dc", "did you mean --slip-distance?"),
        (["show", "run.nc"], "--plott", "did you mean --plot?"),
    ],
)
def test_unknown_options(nucleation, command, unknown, answer):
    ended = nucleation(*command, unknown, "1")
    assert ended.code == 2
    assert f"Error: No such option '{unknown}'; {answer}" in " ".join(ended.err.split())


def test_a_message_lists_the_keys_of_its_command(nucleation, tmp_path):
    path = tmp_path / "fault.yaml"
    path.write_text("xyzzy: 1.0\n")
    own = nucleation("length", *FAULT, "--parameters", path).err
    assert "unknown key; known: shear_modulus" in " ".join(own.split())
    assert "n_x" not in own
    assert "n_x" in nucleation("simulate", "run.nc", "--parameters", path).err
