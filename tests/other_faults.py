"""Twenty faults drawn at random, for simulations that no part of the expected drop was fitted to.

The study ``other_faults`` of ``config/beyond.yaml`` has these faults; a test compares.
"""

import itertools
import math

import numpy as np
from asked import critical_length

from nucleation.model.friction.constants import OVER_VELOCITY, STATE_SCALE

SEED = 20260
NUMBER = 20
ZETA_OVER_A = (0.2, 10.0)
HEIGHT = (0.02, 2.0)
"""Over L_c between identical half-spaces; with a rigid base L_c is up to twice as long."""

LAWS = list(itertools.product(("product", "dieterich_ruina"), ("aging", "slip")))
BODIES = ["rigid"] * 8 + ["same"] * 6 + ["other"] * 6
SCATTERED = 5.0
"""zeta/a from which on a fault has six realisations, not two: runs are short, and drops scatter."""
LATE = {0.216: (6.0, 8e3), 0.253: (None, 6e3)}
"""Changed after the first runs, by zeta/a: the block over L_c where the patch filled the half in
which it is followed, and the end over D/V where no burst lowers the force."""


def log_uniform(random, low, high):
    return float(np.exp(random.uniform(math.log(low), math.log(high))))


def rounded(value):
    return float(f"{value:.3g}")


def even(random):
    """Numbers from 0 to 1, one in each twentieth, in random order."""
    return (random.permutation(NUMBER) + random.uniform(size=NUMBER)) / NUMBER


def drawn():
    """The entries of the study, by names of parameters, SI units."""
    random = np.random.default_rng(SEED)
    low, high = ZETA_OVER_A
    ratios = low * (high / low) ** even(random)
    low, high = HEIGHT
    heights = low * (high / low) ** even(random)
    laws = random.permutation(LAWS * (NUMBER // len(LAWS)))
    bodies = random.permutation(BODIES)
    drawn = zip(ratios, heights, laws, bodies, strict=True)
    return [_entry(random, *own) for own in drawn]


def _entry(random, ratio, height, law, body):
    """One fault with its mesh; the block is so long that its far end has no effect."""
    law, evolution = map(str, law)
    fault = {
        "zeta_over_a": ratio,
        "a": random.uniform(0.004, 0.015),
        "friction": random.uniform(0.3, 0.8),
        "shear_modulus": log_uniform(random, 2e9, 40e9),
        "poisson_ratio": random.uniform(0.1, 0.4),
        "normal_stress": log_uniform(random, 1e6, 20e6),
        "slip_distance": log_uniform(random, 0.5e-6, 10e-6),
        "velocity": log_uniform(random, 1e-7, 1e-5),
    }
    modulus = fault["shear_modulus"] / (1.0 - fault["poisson_ratio"])
    elastic = modulus * fault["slip_distance"] / fault["normal_stress"]
    zeta = ratio * fault["a"]
    fault["height"] = height * math.pi * elastic / zeta
    fault |= _base(random, fault, body)
    fault = {key: rounded(x) if isinstance(x, float) else x for key, x in fault.items()}
    critical = _critical(fault)
    memory = fault["slip_distance"] / fault["velocity"]
    scales = {name: rounded(x * fault["velocity"]) for name, x in OVER_VELOCITY[law].items()}
    if law == "product":
        scales["state_scale"] = rounded(STATE_SCALE * memory)
    perturbed = {
        "perturbation": str(random.choice(["normal_load", "state"])),
        "strength": rounded(log_uniform(random, 1e-5, 1e-4)),
        "correlation_length": rounded(0.1 * critical),
        "seed": [1, 2, 3, 4, 5, 6] if ratio > SCATTERED else [1, 2],
    }
    block, latest = LATE.get(rounded(ratio), (None, 3e4))
    length = (block or 4.0) * critical
    if fault["height"] > 0.4 * critical:
        length = 5.0 * (1.5 * critical + fault["height"])
    zone = elastic / (fault["a"] + zeta)
    zone = min(zone, math.sqrt(2.0 * fault["height"] * zone))
    if evolution == "slip":
        zone /= 2.0
    elements = (12.0 if ratio > 2.0 else 6.0) * length / zone
    run = {
        "block_length": rounded(length),
        "n_x": 50 * math.ceil(min(max(elements, 300.0), 1500.0) / 50.0),
        "initial_state": rounded(memory * log_uniform(random, 5.0, 50.0)),
        "end_time": rounded(latest * memory),
    }
    return fault | {"friction_law": law, "evolution": evolution} | scales | perturbed | run


def _base(random, fault, body):
    """What the block slides on."""
    if body == "rigid":
        return {"second_body": "rigid"}
    base = {
        "second_body": "deformable",
        "second_far_side": str(random.choice(["free", "clamped"])),
    }
    if body == "other":
        base |= {
            "second_shear_modulus": fault["shear_modulus"] * log_uniform(random, 0.25, 4.0),
            "second_poisson_ratio": random.uniform(0.1, 0.4),
            "second_height": fault["height"] * log_uniform(random, 0.5, 2.0),
        }
    return base


def _critical(fault):
    """L_c (m)."""
    known = {
        name: value for name, value in fault.items() if name not in ("second_body", "zeta_over_a")
    }
    if fault["second_body"] == "rigid":
        known["second_shear_modulus"] = math.inf
    return float(critical_length(**known, zeta=fault["zeta_over_a"] * fault["a"]))
