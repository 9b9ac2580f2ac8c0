"""Random faults over the declared ranges: each question has an answer, or says why it has none."""

import json
import math
import warnings
from collections import Counter

import numpy as np
import pytest

from nucleation import commands
from nucleation.api import Fault, ParameterError
from nucleation.theory.creep import slow_slip
from nucleation.theory.creep.lengths import LONGEST
from nucleation.theory.creep.patches import Patches
from nucleation.theory.pair import LayerPair
from replication.configuration.load import configure
from replication.configuration.studies import study_runs

SEED, NUMBER, QUICK = 34, 300, 12
LONGEST_SPECIMEN = 1e7  # m
MOST = Counter(wavenumbers=2_500_000, patches=250, steps=25_000)
"""Largest cost of the answers about a fault: wavenumbers of the bodies' stiffness, creeping patches
that are solved, and steps of slow slip; about two seconds where all are needed."""


@pytest.fixture
def cost(monkeypatch):
    """How much is computed, by the names of MOST."""
    counted = Counter()

    def count(owner, name, kind, amount):
        function = getattr(owner, name)

        def counting(*args, **options):
            counted[kind] += amount(*args)
            return function(*args, **options)

        monkeypatch.setattr(owner, name, counting)

    count(LayerPair, "transfer_functions", "wavenumbers", lambda _, k: np.size(k))
    count(Patches, "creep", "patches", lambda *_: 1)
    count(slow_slip, "_step", "steps", lambda *_: 1)
    return counted


def log_uniform(random, low, high):
    return float(np.exp(random.uniform(np.log(low), np.log(high))))


def random_fault(number):
    """A fault of the theory, and the loading of its patch."""
    random = np.random.default_rng([SEED, number])
    fault = {
        "shear_modulus": log_uniform(random, 1e7, 1e12),
        "poisson_ratio": random.uniform(-0.2, 0.49),
        "normal_stress": log_uniform(random, 1e3, 1e9),
        "a": log_uniform(random, 1e-4, 0.05),
        "slip_distance": log_uniform(random, 1e-8, 0.1),
        "friction": random.uniform(0.15, 0.9),
        "velocity": log_uniform(random, 1e-12, 1e-2),
        "plane": str(random.choice(["strain", "stress", "antiplane"])),
    }
    fault["zeta"] = fault["a"] * log_uniform(random, 0.01, 1000.0)
    if fault["a"] + fault["zeta"] > 1.0:
        fault["zeta"] = 1.0 - fault["a"]
    elastic = fault["shear_modulus"] * fault["slip_distance"]
    elastic /= fault["zeta"] * fault["normal_stress"]
    height = elastic * log_uniform(random, 1e-4, 1e2)
    fault["height"] = math.inf if random.random() < 0.2 else height
    body = random.choice(["same", "rigid", "other"])
    if body == "rigid":
        fault["second_shear_modulus"] = math.inf
    if body == "other":
        fault["second_shear_modulus"] = fault["shear_modulus"] * log_uniform(random, 0.03, 30.0)
        fault["second_poisson_ratio"] = random.uniform(0.0, 0.49)
        fault["second_height"] = fault["height"] * log_uniform(random, 0.1, 10.0)
    return fault, str(random.choice(["edge", "remote"]))


def quick(numbers):
    return [n if n < QUICK else pytest.param(n, marks=pytest.mark.slow) for n in numbers]


def option(value):
    return repr(value) if isinstance(value, float) else value


@pytest.mark.parametrize("number", quick(range(NUMBER)))
def test_one_answer_by_library_and_command(cost, capsys, number):
    """Each length is finite or has a reason, and is the same however the fault is given.

    A fifth of the faults is asked for L, and one for a specimen; a fifteenth for L_run or L twice.
    """
    given, loading = random_fault(number)
    fault = Fault(**given, evolution=("aging", "slip")[number % 2])
    with warnings.catch_warnings(), np.errstate(all="raise"):
        warnings.simplefilter("error", RuntimeWarning)
        warnings.simplefilter("ignore", UserWarning)
        found = fault.lengths("none" if number % 5 else "normal_load", strength=1e-5)
        assert cost <= MOST
        known = found.get("runaway_length")
        runaway = known.value if known else math.nan
        if number % 15 in (0, 3):
            runaway = float(fault.runaway_length())
        critical = found["critical_length"].value
        assert float(fault.critical_mode().length) == pytest.approx(critical, nan_ok=True)
        if number % 5 == 1 and critical < LONGEST_SPECIMEN:
            ends = np.array(fault.specimen("slip_distance", critical).intervals).ravel()
            assert np.isclose(ends, given["slip_distance"], rtol=1e-5).any() or not ends.size
        stable = float(fault.replace(loading=loading).stability_length())
    assert math.isnan(stable) or 0.05 * critical < stable < 1.2 * LONGEST * critical
    assert found.literature["homogeneous_sliding"].value > 0.0
    for answer in (*found.values(), *found.literature.values()):
        assert answer.exists == (answer.status == "value") == (answer.reason == "")
        assert not answer.exists or 0.0 < answer.low <= answer.value <= answer.high
    stability = found["stability_length"]
    if loading == "edge":
        assert stability.value == pytest.approx(stable, nan_ok=True)
    assert math.isnan(runaway) or runaway > stability.value
    if "drop_length" in found:
        drop = found["drop_length"]
        assert known.value == pytest.approx(runaway, nan_ok=True)
        assert not drop.exists or not drop.value < runaway
        assert not drop.exists or drop.value > stability.value or "before L_s" in drop.doubt
    assert Fault.from_dict(fault.to_dict()) == fault
    flat = fault.to_dict()
    if flat.get("second_shear_modulus") == math.inf:
        del flat["second_shear_modulus"]
        flat["second_body"] = "rigid"
    words = [w for k, x in flat.items() for w in (f"--{k.replace('_', '-')}", option(x))]
    perturbed = ["--strength", "1e-5"] if number % 15 == 5 else ["--perturbation", "none"]
    code = commands.run(["length", *words, *perturbed, "--all", "--json"])
    ended = capsys.readouterr()
    assert code == (0 if found["critical_length"].exists else 3), ended.err
    told = json.loads(ended.out)
    told = {entry["key"]: entry for entry in (*told["lengths"], *told["literature"])}
    found = found | found.literature
    assert found.keys() - told.keys() <= {"runaway_length", "drop_length"}
    for key, entry in told.items():
        assert entry["value"] == (found[key].value if found[key].exists else None), key
        assert (entry["status"], entry["reason"]) == (found[key].status, found[key].reason)


def test_a_study_has_the_critical_length_of_the_library():
    """The same values gave lengths that were 2.8 times apart: another second body, another law.

    Faults of a finite height that some friction law has.
    """
    faults, studies = {}, {}
    for number in range(NUMBER):
        given, _ = random_fault(number)
        if math.isinf(given["height"]) or math.isinf(given.get("second_height", 1.0)):
            continue
        fault = Fault(**given)
        try:
            fault.law()
        except ParameterError:
            continue
        faults[f"n{number}"] = fault
        runs = [{"n_x": 60, "n_y": 4, "block_length": 1.0, "end_time": 1.0}]
        studies[f"n{number}"] = {"fault": fault.to_dict(), "runs": runs}
    assert len(studies) > 100
    settings = configure({"results": "results/random", "studies": studies}, lazy=True)
    for name, fault in faults.items():
        (_, run), *_ = study_runs(name, settings)
        assert not isinstance(run, str), run
        expected = float(fault.critical_length())
        assert run.critical_length == pytest.approx(expected, rel=1e-9, nan_ok=True), name
        assert run.run.fault.second_shear_modulus == fault.second_shear_modulus
        assert run.run.law == fault.law()
