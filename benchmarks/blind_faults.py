"""Draw the blind faults: `python -m benchmarks.blind_faults` prints config/blind.yaml.

The rule was stated before any of these faults was simulated, and each set was drawn once:

- the generator is ``numpy.random.default_rng(20261128)``, of the second set that of 20261129; fault
  by fault it draws the friction law,
  its evolution, the second body (none, an equal one, a different one), its far side, the plane
  (antiplane in one of five), ``zeta/a`` from 0.2 to 50 (log-uniform) and the strength of a
  fluctuating normal load from 1e-5 to 1e-3 (log-uniform);
- then all else: H over L_c from 0.03 to 2 (log-uniform), f, a, the material, sigma0, D and V;
- block and end follow from L_c, and for ``zeta/a`` below 2 from the upper end of the predicted
  range of L if that is larger, by the project's limits on far ends; the mesh follows from the
  advice for the strength, the steps from that for the period of the mode;
- what was drawn second is drawn again while elements along x times steps exceed MOST_WORK (below
  zeta/a = SLOWEST: MOST_OF_SLOWEST), at most TRIES times, and then the fault as a whole: a
  simulation shall take seconds.

Even faults of the first set (0, 2, ...) calibrated ranges and doubts. Odd ones tested them, but the
rule of the ranges was changed after they had been seen; the second set (72, 73, ...) was drawn and
predicted when the ranges stood, and tests them.
"""

import math
import sys
from typing import Any

import numpy as np
from numpy.random import Generator

from nucleation.fault import Fault
from nucleation.model.friction import USUAL_LAW
from nucleation.model.friction.constants import AGE, own_law
from nucleation.model.quantities import ParameterError
from nucleation.model.settings import NEAR_END, THICK, THICK_REACH, Perturbation, Start
from nucleation.run.reach import reach_of
from nucleation.run.sizing import element_height, time_to_length, zone_length
from nucleation.theory.creep.runaway import WEAK

SETS = {20261128: 72, 20261129: 36}
"""The seed of each set, and its number of faults."""

REALISATIONS = 3
MOST_WORK = 2.0e6  # elements along x times steps
SLOWEST, MOST_OF_SLOWEST = 0.5, 8.0e6  # zeta/a below which patches slip slowly for long; work
TRIES = 40
LONGEST_STEP = 0.2  # over D/V
LATE = 1.5  # end over the time until the longest patch
ROOM = 1.1  # of blocks, over the least length without an effect of the far end
GRADING = 60.0
ROWS = (16, 24, 32, 48)

HEAD = """\
# Two sets of blind faults, drawn once each by the rule of benchmarks/blind_faults.py, which prints
# this. Predictions were made before the simulations: results/reference/blind_predicted.csv.

results: results/blind

studies:
  blind:
    role: blind
    description: faults drawn at random, whose L was predicted before it was simulated
    table: own                  # results/blind/blind.csv
    fault: paper                # whose values the entries replace
    runs_per_job: 9
    length_over_critical: 4.0
    defaults:
      grading: 60.0
      correlation_time: 2.0
      time_after_event: 0.0
      record: lengths
      perturbation: normal_load
      initial_stress: no_slip
      initial_shear_stress: 0.0
      tolerance: 1.0e-2
    runs:
"""


def log_uniform(rng: Generator, low: float, high: float) -> float:
    """A number whose logarithm is uniform."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def rounded(value: Any) -> Any:
    """A number with three digits."""
    return float(f"{value:.3g}") if isinstance(value, float) else value


def kind(rng: Generator) -> dict[str, Any]:
    """What a fault keeps while the rest is drawn again."""
    return {
        "friction_law": str(rng.choice([USUAL_LAW, "dieterich_ruina"])),
        "evolution": str(rng.choice(["aging", "slip"])),
        "below": str(rng.choice(["rigid", "equal", "different"])),
        "second_far_side": str(rng.choice(["free", "clamped"])),
        "plane": str(rng.choice(["strain", "antiplane"], p=[0.8, 0.2])),
        "zeta_over_a": log_uniform(rng, 0.2, 50.0),
        "strength": log_uniform(rng, 1e-5, 1e-3),
    }


def rest(rng: Generator, own: dict[str, Any]) -> dict[str, Any]:
    """All other values of a fault but its heights, which are those over L_c."""
    stronger = max(own["zeta_over_a"], 1.0)
    found = {
        "height": log_uniform(rng, 0.03, 2.0),
        "friction": rng.uniform(0.3, 0.8),
        "a": log_uniform(rng, 0.004, 0.03) / math.sqrt(stronger),
        "shear_modulus": log_uniform(rng, 2e9, 4e10),
        "poisson_ratio": rng.uniform(0.1, 0.4),
        "density": rng.uniform(1000.0, 3000.0),
        "normal_stress": log_uniform(rng, 1e6, 2e7),
        "slip_distance": log_uniform(rng, 5e-7, 1e-5),
        "velocity": log_uniform(rng, 1e-7, 1e-5),
    }
    softer = log_uniform(rng, 0.3, 3.0)
    other = {
        "second_height": found["height"] * log_uniform(rng, 0.5, 2.0),
        "second_shear_modulus": found["shear_modulus"] * softer,
        "second_poisson_ratio": rng.uniform(0.1, 0.4),
        "second_density": found["density"],
    }
    if own["below"] == "rigid":
        return found
    if own["below"] == "equal":
        other = {name: found[name.removeprefix("second_")] for name in other}
    return found | other


def fault_of(own: dict[str, Any], drawn: dict[str, Any]) -> Fault:
    """The fault of drawn values, its heights in units of L_c."""
    law = own_law(drawn["velocity"], drawn["slip_distance"], own["evolution"], own["friction_law"])
    values = dict(drawn, zeta=own["zeta_over_a"] * drawn["a"])
    values["initial_state"] = AGE * drawn["slip_distance"] / drawn["velocity"]
    if own["below"] == "rigid":
        values["second_shear_modulus"] = math.inf
    else:
        values["second_far_side"] = own["second_far_side"]
    heights = {name: values.pop(name) for name in ("height", "second_height") if name in values}
    fault = Fault(
        **values,
        plane=own["plane"],
        far_side="free",
        friction_law=law,
        evolution=own["evolution"],
        height=1.0,
    )
    scale = fault.shear_modulus * fault.slip_distance / (fault.zeta * fault.normal_stress)
    low, high = 1e-4 * scale, 1e4 * scale
    for _ in range(30):  # the L_c by which the heights are in its units
        length = math.sqrt(low * high)
        sized = fault.replace(**{name: rounded(over * length) for name, over in heights.items()})
        low, high = (length, high) if sized.critical_length() > length else (low, length)
    return sized


def planned(own: dict[str, Any], fault: Fault) -> tuple[dict[str, Any], float]:
    """Block, mesh and times of a fault, and its work; the theory of L takes a second or two."""
    critical = float(fault.critical_length())
    found, work = run_of(own, fault, critical)
    if own["zeta_over_a"] >= WEAK or not work <= most_work(own):
        return found, work
    declared = Perturbation("normal_load", own["strength"], correlation_time=2.0)
    reach = reach_of(fault, fault.law(), Start(), declared, critical)
    return run_of(own, fault, max(critical, reach.latest))


def most_work(own: dict[str, Any]) -> float:
    """The largest work of a fault's simulation."""
    return MOST_OF_SLOWEST if own["zeta_over_a"] < SLOWEST else MOST_WORK


def run_of(own: dict[str, Any], fault: Fault, longest: float) -> tuple[dict[str, Any], float]:
    """Block, mesh and times for a patch that becomes `longest` (m), and the work."""
    critical = float(fault.critical_length())
    height = fault.height
    block = longest / NEAR_END
    if height > THICK * 0.5 * longest:
        block = max(block, (longest + height) / THICK_REACH)
    block = rounded(ROOM * block)
    rested = time_to_length(fault, Start(), critical)
    zone = zone_length(fault, fault.law(), rested)
    elements = 9.5 + math.log10(1e-3 / own["strength"]) / 0.8 + 0.2
    n_x = 2 * math.ceil(0.5 * block / zone * elements)
    period = 2.0 * math.pi * math.sqrt(1.0 / own["zeta_over_a"])
    step = rounded(min(LONGEST_STEP, 0.99 * period / 8.0))
    memory = fault.slip_distance / fault.velocity
    due = time_to_length(fault, Start(), longest)
    rows = {}
    for prefix in ("", "second_"):
        if prefix and own["below"] == "rigid":
            continue
        own_height = getattr(fault, f"{prefix}height")
        fine = [n for n in ROWS if element_height(own_height, n, GRADING) <= zone / 3.5]
        rows[f"{prefix}n_y"] = fine[0] if fine else ROWS[-1]
        if not fine:
            return {}, math.inf
    values = {"block_length": block, "n_x": n_x, **rows, "longest_step": step}
    values["end_time"] = float(f"{LATE * due:.2g}")
    return values, n_x * due / (step * memory)


def drawn_fault(rng: Generator) -> dict[str, Any]:
    """The values of one fault's runs."""
    while True:
        own = {name: rounded(value) for name, value in kind(rng).items()}
        for _ in range(TRIES):
            drawn = {name: rounded(value) for name, value in rest(rng, own).items()}
            try:
                fault = fault_of(own, drawn)
                run, work = planned(own, fault)
            except ParameterError:  # no law has such constants
                continue
            if not work <= most_work(own):
                continue
            law = vars(fault.law())
            scales = [
                name
                for name in (
                    "regularisation_slip_rate",
                    "reference_slip_rate",
                    "slip_rate_scale",
                    "state_scale",
                )
                if name in law
            ]
            values: dict[str, Any] = {
                "friction_law": own["friction_law"],
                "evolution": own["evolution"],
                "plane": own["plane"],
                "zeta_over_a": own["zeta_over_a"],
                "strength": own["strength"],
                **drawn,
                "height": fault.height,
                **{name: rounded(float(law[name])) for name in scales},
                "initial_state": rounded(fault.initial_state),
                "second_body": "rigid" if own["below"] == "rigid" else "deformable",
                **run,
            }
            if own["below"] != "rigid":
                values["second_height"] = fault.second_height
                values["second_far_side"] = own["second_far_side"]
            return values


def text(number: int, values: dict[str, Any]) -> str:
    """The entry of one fault in YAML."""
    listed = {name: values[name] for name in ("height", "zeta_over_a")}
    lines = [
        f"      # {number}",
        f"      - {{height: {listed['height']!r}, "
        f"zeta_over_a: {listed['zeta_over_a']!r}, seed: {[*range(1, REALISATIONS + 1)]},",
    ]
    inner = ", ".join(
        f"{name}: {yaml(value)}" for name, value in values.items() if name not in listed
    )
    return "\n".join([*lines, f"         defaults: {{{inner}}}}}"])


def yaml(value: Any) -> str:
    """A value as YAML reads it: an exponent needs a point before it."""
    shown = repr(value) if not isinstance(value, str) else value
    mantissa, mark, exponent = shown.partition("e")
    if isinstance(value, float) and mark and "." not in mantissa:
        return f"{mantissa}.0e{exponent}"
    return shown


def blind_faults(number: int, seed: int) -> list[dict[str, Any]]:
    """The values of a set's first faults."""
    rng = np.random.default_rng(seed)
    return [drawn_fault(rng) for _ in range(number)]


if __name__ == "__main__":
    faults = [fault for seed, number in SETS.items() for fault in blind_faults(number, seed)]
    entries = [text(number, values) for number, values in enumerate(faults)]
    sys.stdout.write(HEAD + "\n".join(entries) + "\n")
