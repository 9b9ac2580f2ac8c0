"""The table of two bodies: which bodies, which perturbation, which theory."""

import numpy as np
import pytest

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.growth import follow_patch
from nucleation.simulation.run import simulate
from nucleation.theory.closed_forms import bimaterial_contrast, bimaterial_length_ratio
from replication.configuration.load import configure
from replication.tables.ratios import PAIRS, gather_pairs, pairs_over_realisations

STUDY = {
    "defaults": {
        "second_body": "deformable",
        "n_x": 60,
        "n_y": 3,
        "end_time": 0.2,
        "perturbation": "normal_load",
        "strength": 1e-4,
        "seed": 3,
    },
    "runs": [
        {
            "height": 0.02,
            "second_height": 0.03,
            "second_shear_modulus": 6.2e9,
            "second_far_side": ["free", "clamped"],
        }
    ],
}


def test_rows_say_what_the_runs_are():
    runs = configure({"studies": {"pairs": STUDY}}).runs
    records, settings = [simulate(run.run) for run in runs], ExtractionSettings()
    patches = [follow_patch(record, settings) for record in records]
    table = gather_pairs([run.to_dict() for run in runs], records, patches, settings)
    assert tuple(table.data_vars) == tuple(PAIRS)
    assert table["far_side"].values.tolist() == ["free", "clamped"]
    assert table["second_height"].values.tolist() == [0.03, 0.03]
    assert table["kind"].values.tolist() == ["normal_load"] * 2
    assert table["seed"].values.tolist() == [3, 3]
    assert table["critical_length"].values.tolist() == [run.critical_length for run in runs]
    first = runs[0].run
    contrast = bimaterial_contrast(first.upper.material, first.below.material)
    f_beta = float(table["f_beta"][0])
    assert contrast > 0.0 and f_beta == pytest.approx(contrast * float(table["friction"][0]))
    ratio = bimaterial_length_ratio(f_beta, float(table["zeta_over_a"][0]))
    assert float(table["half_space_ratio"][0]) == pytest.approx(float(ratio))


def test_realisations_of_a_fault_have_the_first_ones_stability_and_one_mean():
    study = {**STUDY, "runs": [{"height": [0.02, 0.03], "seed": [3, 4]}]}
    runs, settings = configure({"studies": {"pairs": study}}).runs, ExtractionSettings()
    records = [simulate(run.run) for run in runs]
    patches = [follow_patch(record, settings) for record in records[::2]]
    for patch, length in zip(patches, (0.1, 0.2), strict=True):
        patch["stability_length"] = length
    made = gather_pairs([run.to_dict() for run in runs], records, patches, settings)
    assert made["stability_length"].values.tolist() == [0.1, 0.1, 0.2, 0.2]
    lengths, ratio = np.array([1.0, 3.0, 5.0, 9.0]), np.array([0.5, 0.7, 0.6, 0.8])
    made = made.assign(length=("run", lengths), length_ratio=("run", ratio))
    faults = pairs_over_realisations(made)
    assert faults["height"].values.tolist() == [0.02, 0.03]
    assert faults["length"].values.tolist() == [2.0, 7.0]
    assert faults["realisations"].values.tolist() == [2, 2]
    np.testing.assert_allclose(faults["length_ratio"], (0.6, 0.7))
    np.testing.assert_allclose(faults["length_ratio_low"], (0.5, 0.6))
    np.testing.assert_allclose(faults["length_ratio_high"], (0.7, 0.8))
