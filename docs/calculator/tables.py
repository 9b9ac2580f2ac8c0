"""What the calculator takes from the library, with tables of lengths between which it interpolates.

Run as a program it makes `tables.json`, in ten minutes: one L_run takes seconds, so that the
build of the pages does not wait for it. A test compares the page with the library.
"""

import json
import os
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from nucleation.answers.drop import SLOW_SLIP
from nucleation.answers.lengths import MEANINGS
from nucleation.api import Fault
from nucleation.drop.delay import growth
from nucleation.drop.expected_drop import (
    EARLIEST,
    LATEST,
    OF_STRONG,
    OF_WEAK,
    SLOWEST_GROWTH,
    STRONGEST,
    grown_in_period,
)
from nucleation.drop.mode_history import mode_history
from nucleation.fault.setting import friction, second_body
from nucleation.model.friction.constants import AGE, ANY
from nucleation.model.perturbations import KINDS
from nucleation.model.quantities import declarations
from nucleation.model.settings import Perturbation
from nucleation.model.units import sizes
from nucleation.theory.creep.lengths import stability_length_of
from nucleation.theory.creep.patches import Patches
from nucleation.theory.creep.runaway import ERROR, LEAST_ERROR, WEAK, runaway_of
from nucleation.theory.critical import critical_lengths
from nucleation.theory.evaluation import single_system
from nucleation.theory.values import QUANTITIES, WORDS

HERE = Path(__file__).parent
TABLES = HERE / "tables.json"
HEIGHTS = (1e-3, 1e3)  # H over mu D/((1 - nu) b sigma0)
CENTRE = 2.0  # of these, where lengths change most
POWER = 0.7  # how fast the place on the axis changes with the height
B = 0.02
FAULT = {"shear_modulus": 1e9, "normal_stress": 1e6, "slip_distance": 1e-6}
FRICTION_LENGTH = 0.05  # mu D/(b sigma0) of this fault (m)
CAUTION = 1.05  # ratio to the bounds beyond which the library doubts L, within which there is none
PARTS = (EARLIEST, 0.5, LATEST)  # of the realisations that have dropped

Ends = dict[str, tuple[float, float]]


def logs(low, high):
    """The ends of a logarithmic axis."""
    return float(np.log(low)), float(np.log(high))


PLACES = (np.array(HEIGHTS) / CENTRE) ** POWER
PLACE = {"place": tuple(((PLACES - 1.0) / (PLACES + 1.0)).tolist())}
ELASTIC = {"nu": (0.0, 0.49), "f": (0.0, 1.0)}
COMMON = {"nu": (0.15, 0.45), "f": (0.05, 0.85)}  # stronger coupling can leave no L_run
LOAD = {"f_over_a": logs(30.0, 200.0), "noise": logs(6e-4, 2e-2)}  # noise: eps f/a


def layers(place, weakening, nu=0.25, a=None, f=None, rigid=False):
    """Layers; the place from -1 to 1 is that of a height from 0 to infinity; zeta/a as its log.

    Lengths of layers that are alike do not depend on nu.
    """
    height = CENTRE * ((1.0 + place) / (1.0 - place)) ** (1.0 / POWER)
    a = B / (1.0 + np.exp(weakening)) if a is None else a
    b = a * (1.0 + np.exp(weakening))
    return Fault(
        **FAULT,
        poisson_ratio=nu,
        a=a,
        b=b,
        friction=f,
        height=height * FRICTION_LENGTH * B / b / (1.0 - nu),
        second_shear_modulus=np.inf if rigid else None,
    )


def stability_of_layers(place, weakening):
    """L_s over L_c of layers that are alike."""
    fault = layers(place, weakening)
    return fault.stability_length() / fault.critical_length()


def stability_on_base(place, weakening, nu, f):
    """L_s over L_c of a layer on a rigid base."""
    fault = layers(place, weakening, nu, f=f, rigid=True)
    return fault.stability_length() / fault.critical_length()


def stability_of_half_spaces(weakening, coupling):
    """``zeta sigma0 L_s/(pi M D)`` of half-spaces with f beta = coupling, one of them rigid."""
    softness = np.where(coupling < 0.0, 1e-6, np.inf)
    a = B / (1.0 + np.exp(weakening))
    fault = Fault(
        **FAULT,
        a=a,
        b=B,
        poisson_ratio=0.0,
        friction=2.0 * np.abs(coupling),
        second_shear_modulus=1e9 * softness,
    )
    modulus = 8.0 / 3.0 * 1e9 * np.minimum(softness, 1.0)
    return fault.stability_length() / (np.pi * modulus * 1e-6 / ((B - a) * 1e6))


def patches_of(fault):
    """The patches of a single fault with constant a and b, without units, and its L_c."""
    one, _ = single_system(fault).without_units()
    return Patches(one, evolution=str(fault.evolution)), float(critical_lengths(one)[0])


def runaway_at(place, weakening, *elastic):
    """L_run over L_s of one fault."""
    nu, f = elastic or (0.25, 0.6)
    one, critical = patches_of(layers(place, weakening, nu, f=f, rigid=bool(elastic)))
    return runaway_of(one, critical).length / stability_length_of(one, critical)


def law_at(place, weakening, *others):
    """The law of the drop of one fault under noise.

    Lengths by which PARTS have dropped over L_s, eps_eff, and growth in a period at the median.
    """
    *elastic, over, noise = others
    nu, f = elastic or (0.25, 0.6)
    a = f * np.exp(-over)
    fault = layers(place, weakening, nu, a=a, f=f, rigid=bool(elastic))
    one, critical = patches_of(fault)
    history = mode_history(one.with_law(fault, ANY, ANY), critical, AGE)  # kept for other noise
    strength = np.exp(noise - over)
    found = growth(history, Perturbation("normal_load", strength))
    lengths = np.array(found.dropped_at(strength, *PARTS))
    effective = found.closed_form(history, strength).effective
    grown = grown_in_period(history, lengths[1])
    return [*lengths / stability_length_of(one, critical), effective, grown]


def each(function, grid):
    """A function of one fault at all points of a grid; neighbours in one process."""
    with ProcessPoolExecutor(max(1, min(2, os.cpu_count() or 1))) as processes:
        points = map(np.ravel, grid)
        found = list(processes.map(function, *points, chunksize=16))
    return np.moveaxis(np.reshape(found, (*grid[0].shape, -1)), -1, 0)


def tabulate(function, ends: Ends, counts, *, one_by_one=False):
    """Ranges, Chebyshev nodes of each argument, and the logarithms of a function at all nodes."""
    nodes = {}
    for (name, (low, high)), number in zip(ends.items(), counts, strict=True):
        roots = np.cos(np.pi * (np.arange(number) + 0.5) / number)
        nodes[name] = 0.5 * (low + high) + 0.5 * (high - low) * roots
    grid = np.meshgrid(*nodes.values(), indexing="ij")
    values = each(function, grid) if one_by_one else function(*grid)[None]
    if not np.isfinite(values).all():
        raise ValueError(f"{function.__name__} has no value at some nodes")
    return {
        "ends": ends,
        "nodes": {name: own.round(6).tolist() for name, own in nodes.items()},
        "logs": np.log(values).round(5).reshape(len(values), -1).tolist(),
    }


def tables():
    """All tables: by length, and in each by the bodies."""
    strong = logs(0.4, 50.0)
    alike, weak = (PLACE | {"zeta_over_a": logs(0.2, high)} for high in (6.0, WEAK))
    on_base, weak_on_base = (
        PLACE | {"zeta_over_a": logs(0.4, high)} | COMMON for high in (6.0, WEAK)
    )
    return {
        "stability": {
            "rigid_base": tabulate(
                stability_on_base, PLACE | {"zeta_over_a": strong} | ELASTIC, (16, 6, 3, 3)
            ),
            "identical_layers": tabulate(
                stability_of_layers, PLACE | {"zeta_over_a": logs(0.2, 50.0)}, (16, 8)
            ),
            "half_spaces": tabulate(
                stability_of_half_spaces, {"zeta_over_a": strong, "coupling": (-0.5, 0.5)}, (6, 9)
            ),
        },
        "runaway": {
            "identical_layers": tabulate(runaway_at, weak, (10, 6), one_by_one=True),
            "rigid_base": tabulate(runaway_at, weak_on_base, (6, 3, 2, 2), one_by_one=True),
        },
        "law": {
            "identical_layers": tabulate(law_at, alike | LOAD, (8, 5, 3, 4), one_by_one=True),
            "rigid_base": tabulate(law_at, on_base | LOAD, (6, 4, 2, 3, 3, 4), one_by_one=True),
        },
    }


def declaration(entry):
    """Unit, range and meaning of a parameter, and what its units are in SI units."""
    units = {name: float(size) for name, size in sizes(entry.unit).items()}
    names = ("low", "high", "closed", "unit", "description", "bounds")
    return {name: getattr(entry, name) for name in names} | {"units": units}


def script_data():
    """All that the script takes from the library, as JavaScript."""
    entries = {name: entry for name, entry in QUANTITIES.items() if name not in WORDS}
    entries["strength"] = declarations(Perturbation)["strength"]
    alike = Fault(**FAULT, poisson_ratio=0.25, a=0.01, b=B, friction=0.6)
    found = {
        "heights": HEIGHTS,
        "centre": CENTRE,
        "power": POWER,
        "thick": 20.0,
        "caution": CAUTION,
        "weak": WEAK,
        "error": ERROR,
        "least_error": LEAST_ERROR,
        "strongest": STRONGEST,
        "slowest_growth": SLOWEST_GROWTH,
        "margins": {"strong": OF_STRONG._asdict(), "weak": OF_WEAK._asdict()},
        "noise": KINDS["normal_load"].noise,
        "slow_slip": SLOW_SLIP[0].upper() + SLOW_SLIP[1:],
        "meanings": {key: text.partition(" (docs")[0] for key, text in MEANINGS.items()},
        "friction_law": friction(alike),
        "second_body": {
            "alike": second_body(alike),
            "rigid": second_body(alike.replace(second_shear_modulus=np.inf)),
            "other": second_body(alike.replace(second_shear_modulus=2e9)),
        },
        "quantities": {name: declaration(entry) for name, entry in entries.items()},
        "tables": json.loads(TABLES.read_text(encoding="utf-8")),
    }
    return f'"use strict";\nconst data = {json.dumps(found)};\n'


if __name__ == "__main__":
    TABLES.write_text(json.dumps(tables(), separators=(",", ":")) + "\n", encoding="utf-8")
