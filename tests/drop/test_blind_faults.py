"""The blind faults: their simulated drops lie in the ranges that the theory states today."""

from pathlib import Path

import pandas as pd
import pytest

from benchmarks.blind_faults import SETS, blind_faults
from nucleation.fault.files import read_yaml
from nucleation.run.derived import drop_of_run
from replication.configuration.load import load
from replication.configuration.runs import first_realisations
from replication.tables.blind import FIRST

ROOT = Path(__file__).parents[2]
CONFIG = ROOT / "config" / "blind.yaml"
DROPS = pd.read_csv(ROOT / "results" / "reference" / "blind.csv", keep_default_na=False)
DROPS["length"] = pd.to_numeric(DROPS["length"])
NINE_OF_TEN = 0.9


@pytest.fixture(scope="module")
def tested():
    """The realisations of the half that calibrated nothing, with today's ranges and doubts."""
    runs = first_realisations(load(CONFIG).runs_of("blind"))
    known = {number: drop_of_run(runs[number].run) for number in range(1, FIRST, 2)}
    own = DROPS[DROPS["number"] % 2 == 1]
    answers = own["number"].map(known)
    inside = [
        one.low <= length <= one.high for one, length in zip(answers, own["length"], strict=True)
    ]
    return pd.DataFrame({"inside": inside, "doubt": [bool(one.doubt) for one in answers]})


@pytest.mark.slow
def test_nine_of_ten_realisations_are_in_the_range(tested):
    assert tested["inside"].mean() >= NINE_OF_TEN


@pytest.mark.slow
def test_nine_of_ten_are_where_the_answer_has_no_doubt(tested):
    assert tested.loc[~tested["doubt"], "inside"].mean() >= NINE_OF_TEN


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "first"), [(20261128, 0), (20261129, FIRST)])
def test_the_faults_are_those_of_the_rule(seed, first):
    """The first two of each set: their theory takes a second or two."""
    assert list(SETS.items())[first > 0][0] == seed
    entries = read_yaml(CONFIG)["studies"]["blind"]["runs"][first:]
    for entry, values in zip(entries, blind_faults(2, seed), strict=False):
        kept = {**entry["defaults"], "height": entry["height"]}
        numbers = {name: x for name, x in values.items() if isinstance(x, float)}
        assert {name: float(kept.get(name, entry.get(name))) for name in numbers} == pytest.approx(
            numbers, rel=0.02
        )


def test_predictions_were_not_changed():
    """The table has those that were kept before the simulations."""
    kept = pd.read_csv(ROOT / "results" / "reference" / "blind_predicted.csv").set_index("number")
    shown = DROPS.groupby("number")["predicted_length"].first().astype(float)
    assert shown.to_numpy() == pytest.approx(
        kept.loc[shown.index, "expected_length"].to_numpy(), rel=1e-12
    )
