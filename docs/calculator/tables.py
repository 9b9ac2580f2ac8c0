"""The page of the calculator: tables of L_s, between which its script interpolates."""

import json
from functools import lru_cache
from pathlib import Path

import numpy as np

from nucleation.api import Fault

HERE = Path(__file__).parent
HEIGHTS = (1e-3, 1e3)  # H over mu D/((1 - nu) b sigma0)
CENTRE = 2.0  # of these, where lengths change most
POWER = 0.7  # how fast the place on the axis changes with the height
B = 0.02
WEAKENING = tuple(np.log([0.4, 50.0]))  # log(zeta/a)
POISSON = (0.0, 0.49)
FAULT = {"shear_modulus": 1e9, "normal_stress": 1e6, "b": B, "slip_distance": 1e-6}
FRICTION_LENGTH = 0.05  # mu D/(b sigma0) of this fault (m)


def layers(place, weakening, nu=0.25, **more):
    """L_s over L_c of layers; the place from -1 to 1 is that of a height from 0 to infinity.

    Of layers that are alike it does not depend on nu.
    """
    height = CENTRE * ((1.0 + place) / (1.0 - place)) ** (1.0 / POWER)
    fault = Fault(
        **FAULT,
        poisson_ratio=nu,
        a=B / (1.0 + np.exp(weakening)),
        height=height * FRICTION_LENGTH / (1.0 - nu),
        **more,
    )
    return fault.stability_length() / fault.critical_length()


def rigid_base(place, weakening, nu, f):
    """L_s over L_c of a layer on a rigid base."""
    return layers(place, weakening, nu, friction=f, second_shear_modulus=np.inf)


def half_spaces(weakening, coupling):
    """``zeta sigma0 L_s/(pi M D)`` of half-spaces with f beta = coupling, one of them rigid."""
    softness = np.where(coupling < 0.0, 1e-6, np.inf)
    a = B / (1.0 + np.exp(weakening))
    fault = Fault(
        **FAULT,
        a=a,
        poisson_ratio=0.0,
        friction=2.0 * np.abs(coupling),
        second_shear_modulus=1e9 * softness,
    )
    modulus = 8.0 / 3.0 * 1e9 * np.minimum(softness, 1.0)
    return fault.stability_length() / (np.pi * modulus * 1e-6 / ((B - a) * 1e6))


def tabulate(function, ends, counts):
    """Ranges, Chebyshev nodes of each argument, and the logarithms of a function at all nodes."""
    nodes = {}
    for (name, (low, high)), number in zip(ends.items(), counts, strict=True):
        roots = np.cos(np.pi * (np.arange(number) + 0.5) / number)
        nodes[name] = 0.5 * (low + high) + 0.5 * (high - low) * roots
    grid = np.meshgrid(*nodes.values(), indexing="ij")
    logs = np.log(np.asarray(function(*grid))).round(6)
    return {
        "ends": ends,
        "nodes": {name: own.tolist() for name, own in nodes.items()},
        "logs": logs.ravel().tolist(),
    }


@lru_cache(maxsize=1)
def page():
    """The whole page as HTML, which needs no network; it takes seconds."""
    places = (np.array(HEIGHTS) / CENTRE) ** POWER
    on_layers = {"place": tuple((places - 1.0) / (places + 1.0)), "zeta_over_a": WEAKENING}
    on_base = on_layers | {"nu": POISSON, "f": (0.0, 1.0)}
    spaces = {"zeta_over_a": WEAKENING, "coupling": (-0.5, 0.5)}
    tables = {
        "rigid_base": tabulate(rigid_base, on_base, (16, 6, 3, 3)),
        "identical_layers": tabulate(layers, on_layers, (16, 6)),
        "half_spaces": tabulate(half_spaces, spaces, (6, 9)),
    }
    axis = {"heights": HEIGHTS, "centre": CENTRE, "power": POWER}
    data = json.dumps({**axis, "thick": 20.0, "tables": tables})
    html = (HERE / "calculator.html").read_text(encoding="utf-8").replace("DATA", data)
    return html.replace("SCRIPT", (HERE / "calculator.js").read_text(encoding="utf-8"))
