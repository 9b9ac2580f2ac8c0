"""The calculator in a real browser: the library's lengths, and an address that holds the fault."""

import json
import shlex
from pathlib import Path

import numpy as np
import pytest

from nucleation.api import (
    critical_length,
    lengths_in_use,
    runaway_length,
    stability_length,
    weakening_patch_length,
)
from nucleation.commands import run
from nucleation.theory.fault import QUANTITIES
from replication.report import calculator, patch_tables, stability, tabulated

pytestmark = pytest.mark.system
PATCH_TABLES = Path(__file__).parents[2] / "results" / "reference" / "patch_tables.json"


@pytest.fixture(scope="module")
def calculating(open_page, tmp_path_factory):
    path = tmp_path_factory.mktemp("calculator") / "calculator.html"
    path.write_text(calculator.build(PATCH_TABLES), encoding="utf-8")
    return open_page(path)


@pytest.fixture
def web(calculating):
    yield calculating.page
    assert calculating.complaints == []


def random_faults(number, bodies, seed):
    """Faults of all far sides as the API takes them; layers and half-spaces, zeta of both signs."""
    random = np.random.default_rng(seed)
    sides = [name for name in calculator.FAR_SIDES]
    for _ in range(number):
        height = random.choice([np.inf, 10.0 ** random.uniform(-2, 2)])
        fault = {
            "shear_modulus": 10.0 ** random.uniform(9, 11), "b": random.uniform(0.005, 0.03),
            "poisson_ratio": random.uniform(-0.2, 0.49), "a": random.uniform(0.002, 0.02),
            "normal_stress": 10.0 ** random.uniform(6, 8), "friction": random.uniform(0.05, 0.9),
            "slip_distance": 10.0 ** random.uniform(-6, -4), "height": height,
            "far_side": random.choice(sides), "plane": random.choice(["strain", "stress"]),
        }  # fmt: skip
        if bodies == "rigid":
            fault["second_shear_modulus"] = np.inf
        else:
            fault["second_far_side"] = random.choice(sides)
        if bodies == "other":
            fault["second_shear_modulus"] = fault["shear_modulus"] * 10.0 ** random.uniform(-1, 1)
            fault["second_poisson_ratio"] = random.uniform(-0.2, 0.49)
            fault["second_height"] = random.choice([np.inf, 10.0 ** random.uniform(-2, 2)])
        yield {k: v if isinstance(v, str) else float(v) for k, v in fault.items()}


def address(fault):
    """The fault as the page's address has it, in SI units."""
    first = {k: v for k, v in fault.items() if not k.startswith("second_")}
    words = {k: v for k, v in first.items() if v != np.inf}
    if "second_far_side" in fault:
        words["second_far_side"] = fault["second_far_side"]
    if "second_shear_modulus" in fault:
        keys = ("second_shear_modulus", "second_poisson_ratio", "second_height")
        rigid = fault["second_shear_modulus"] == np.inf
        words["second_body"] = "rigid" if rigid else ",".join(str(fault[key]) for key in keys)
    return "&".join(f"{k.replace('_', '-')}={v}" for k, v in words.items())


def computed(web, faults):
    """What the page computes for faults in its address: theory, L_s and the lengths in use."""
    return web.evaluate(
        """(addresses) => addresses.map((address) => {
          history.replaceState(null, "", "#" + address);
          readAddress();
          show();
          const [p, wrong] = parameters();
          return [answer(p)[0], Lengths.all(p, data.limits), wrong];
        })""",
        [address(fault) for fault in faults],
    )


@pytest.mark.parametrize("bodies", ["same", "rigid", "other"])
def test_lengths_are_those_of_the_library(web, bodies):
    faults = list(random_faults(40, bodies, 3))
    lengths = 0
    for fault, (at, in_use, wrong) in zip(faults, computed(web, faults), strict=True):
        assert wrong == []
        expected = float(critical_length(**fault))
        lengths += np.isfinite(expected)
        found = np.nan if at["length"] is None else at["length"]
        assert found == pytest.approx(expected, rel=1e-8, nan_ok=True), fault
        listed = lengths_in_use(**fault)
        for key in set(listed) - {"stability_length"}:
            value = np.nan if in_use[key] is None else in_use[key]
            assert value == pytest.approx(float(listed[key]), rel=1e-9, nan_ok=True), (key, fault)
    assert lengths > 10


RIGID, HALF_SPACE = {"second_shear_modulus": np.inf}, {"second_height": np.inf}
SYSTEMS = {
    "rigid": RIGID | {"height": 0.3},
    "rigid, thin": RIGID | {"height": 1e-4},
    "thick": RIGID,
    "identical": {"height": 0.3},
    "half-spaces": {},
    "soft": {"second_shear_modulus": 2e9, "second_poisson_ratio": 0.1, **HALF_SPACE},
    "hard": {"second_shear_modulus": 1e11, "second_poisson_ratio": 0.4, **HALF_SPACE},
    "thick pair": {
        "height": 2e5, "far_side": "clamped", "second_shear_modulus": 3e9, "second_height": 1e5,
        "second_poisson_ratio": 0.3, "second_far_side": "traction",
    },
}  # fmt: skip


@pytest.mark.parametrize("name", SYSTEMS)
def test_stability_length_is_within_the_stated_precision(web, name):
    """Of faults from all of the tables' range, whose stress, stiffness and D are others."""
    random, faults = np.random.default_rng(8), []
    for _ in range(16):
        a = random.uniform(0.001, 0.005)
        low, high = stability.TABLES["rigid_base"].ends["zeta_over_a"]
        fault = {
            "shear_modulus": 1e10, "poisson_ratio": random.uniform(0.0, 0.49), "a": a,
            "normal_stress": 5e6, "b": a * (1.0 + low * (high / low) ** random.uniform(0.01, 0.99)),
            "slip_distance": 1e-5, "friction": random.uniform(0.01, 0.99),
        }  # fmt: skip
        faults.append(fault | SYSTEMS[name])
    errors = [
        at["stability"] / float(stability_length(**fault)) - 1.0
        for fault, (at, _, _) in zip(faults, computed(web, faults), strict=True)
    ]
    assert np.abs(errors).max() < stability.PRECISION
    assert np.sqrt(np.mean(np.square(errors))) < 0.3 * stability.PRECISION


@pytest.mark.parametrize(
    "more", [{"height": 0.3, "far_side": "velocity", "second_shear_modulus": np.inf},
             {"height": 0.3, "second_far_side": "roller"}, {"a": 0.012}],
)  # fmt: skip
def test_where_the_tables_do_not_hold_it_says_so(web, more):
    fault = {"shear_modulus": 1e10, "poisson_ratio": 0.2, "normal_stress": 5e6, "a": 0.005}
    computed(web, [fault | {"b": 0.015, "slip_distance": 1e-6, "friction": 0.6} | more])
    assert web.locator("#values dd").nth(1).inner_text().startswith("not known here: only ")


WEAK = {
    "rigid_base": RIGID,
    "identical_layers": {},
}


@pytest.mark.slow
@pytest.mark.parametrize("system", WEAK)
def test_runaway_length_is_within_the_stated_precision(web, system):
    random, faults = np.random.default_rng(5), []
    for _ in range(8):
        a = random.uniform(0.002, 0.005)
        weakening = 0.4 * 5.0 ** random.uniform(0.01, 0.99)
        fault = {
            "shear_modulus": 1e10, "poisson_ratio": random.uniform(0.0, 0.49), "a": a,
            "normal_stress": 5e6, "b": a * (1.0 + weakening), "slip_distance": 1e-5,
            "friction": random.uniform(0.05, 0.95), "height": 10.0 ** random.uniform(-2, 2),
        }  # fmt: skip
        faults.append(fault | WEAK[system])
    for fault, (at, _, _) in zip(faults, computed(web, faults), strict=True):
        error = at["runaway"] / float(runaway_length(**fault)) - 1.0
        assert abs(error) < patch_tables.RUNAWAY_PRECISION[system], fault


def test_smallest_patch_is_within_the_stated_precision(web):
    random, faults = np.random.default_rng(6), []
    for _ in range(12):
        a = random.uniform(0.002, 0.005)
        weakening = 0.4 * 50.0 ** random.uniform(0.01, 0.99)
        fault = {
            "shear_modulus": 1e10, "poisson_ratio": 0.3, "a": a, "normal_stress": 5e6,
            "b": a * (1.0 + weakening), "slip_distance": 1e-5, "friction": 0.6,
            "outside_zeta": -a * weakening * 0.1 * 100.0 ** random.uniform(0.01, 0.99),
            "outside_a": a * random.uniform(0.51, 1.99),
        }  # fmt: skip
        faults.append(fault)
    for fault, (at, _, _) in zip(faults, computed(web, faults), strict=True):
        expected = float(weakening_patch_length(**fault))
        assert at["patch"] == pytest.approx(expected, rel=patch_tables.PATCH_PRECISION), fault


@pytest.mark.slow
def test_the_committed_tables_are_what_the_code_gives(web):
    """At a node of each, which the page has without interpolation."""
    stored = json.loads(PATCH_TABLES.read_text())
    tables = {**patch_tables.RUNAWAY, "patch": patch_tables.PATCH}
    read = "(table) => Math.exp([...floats(table.logs)][0])"
    for name, table in tables.items():
        made = stored["runaway"].get(name, stored["patch"])
        assert {k: tuple(v) for k, v in made["ends"].items()} == dict(table.ends)
        assert tuple(map(len, made["nodes"].values())) == table.nodes
        first = {key: np.float64(nodes[0]) for key, nodes in made["nodes"].items()}
        for key in first.keys() & tabulated.LOGARITHMIC:
            first[key] = np.exp(first[key])
        assert web.evaluate(read, made) == pytest.approx(float(table.values(**first)), rel=1e-3)


@pytest.mark.parametrize(
    ("more", "row", "said"),
    [
        ({"b": 0.025}, 2, "none for ζ/a above 2: "),
        ({"b": 0.006}, 2, "not known here: only for ζ/a from 0.4 to 2 "),
        ({"height": 0.3, "second_far_side": "roller"}, 2, "not known here: only on a rigid base "),
        ({"outside_zeta": -0.004, "height": 0.3}, 3, "not known here: only between identical half"),
        ({"outside_zeta": -0.5}, 3, "not known here: only for ζ/a from 0.4 to 20, "),
        ({"outside_zeta": 0.1}, 3, "none: the surroundings have to strengthen"),
    ],
)
def test_why_there_is_no_length_of_a_patch(web, more, row, said):
    fault = {"shear_modulus": 1e10, "poisson_ratio": 0.2, "normal_stress": 5e6, "a": 0.005}
    computed(web, [fault | {"b": 0.01, "slip_distance": 1e-6, "friction": 0.6} | more])
    assert web.locator("#values dd").nth(row).inner_text().startswith(said)


def test_the_command_beside_gives_the_same(web, capsys):
    """The very line that the page shows, run by the command."""
    for bodies, seed in (("same", 4), ("rigid", 5), ("other", 6)):
        fault = next(f for f in random_faults(20, bodies, seed) if critical_length(**f) > 0)
        ((at, _, _),) = computed(web, [fault])
        name, *words = shlex.split(web.inner_text("#command"))
        assert name == "nucleation" and run([*words, "--json"]) == 0
        theory = json.loads(capsys.readouterr().out)["theory"]
        assert theory["critical_length"] == pytest.approx(at["length"], rel=1e-8)
        assert theory["critical_frequency_over_rate"] == pytest.approx(
            float(web.locator("#mode dd").nth(1).inner_text().removesuffix(" V/D")), rel=1e-3
        ), fault


def test_values_and_units_go_through_the_address(web):
    start = web.url.split("#")[0]
    web.goto(
        f"{start}#shear-modulus=30GPa&poisson-ratio=0.25&normal-stress=50MPa&a=0.010&b=0.015"
        "&slip-distance=5µm&velocity=1mm/yr&height=2km&second-body=10GPa,0.2,inf"
    )
    assert web.input_value("#height") == "2" and web.input_value("#unit-height") == "km"
    assert web.input_value("#unit-slip_distance") == "um"
    assert "the friction coefficient is needed" in web.inner_text("#values")
    web.fill("#friction", "0.6")
    values = web.locator("#values dd").all_inner_texts()
    assert web.locator("#mode dd").nth(1).inner_text().endswith(" rad/s")
    kept = web.url
    assert "&second-body=10GPa%2C0.2%2Cinf" in kept and "velocity=1mm%2Fyr" in kept
    web.select_option("#unit-height", "mm")
    assert web.locator("#values dd").all_inner_texts() != values
    web.goto(kept)
    assert web.locator("#values dd").all_inner_texts() == values
    web.select_option("#second_body", "same")
    assert not web.locator("#second_shear_modulus").is_visible()


NEEDED = [field for field in calculator.FIELDS if not field.empty]


@pytest.mark.parametrize("field", NEEDED, ids=lambda field: field.key)
def test_bad_values_have_no_result(web, field):
    web.goto(
        web.url.split("#")[0] + "#shear-modulus=3e10&poisson-ratio=0.25&normal-stress=5e7"
        "&a=0.01&b=0.015&slip-distance=5e-6&friction=0.6&second-body=1e10,0.2,1"
    )
    assert web.locator("#others tbody").count() == 3
    low = QUANTITIES[field.key.removeprefix("second_")].low
    below = 0.5 * low if low > 0.0 else low
    for bad in ("", str(below), "1e30"):
        web.fill(f"#{field.key}", bad)
        assert web.get_attribute(f"#{field.key}", "aria-invalid") == "true"
        (said,) = web.locator("#values dt").all_inner_texts()
        assert said.startswith(f"No values: {field.label} must lie in ")
        assert web.locator("#others tbody").count() == 0


def test_a_decimal_comma_is_refused_by_name(web):
    """It was dropped by the browser: 2,5 was 25."""
    start = web.url.split("#")[0]
    web.goto(f"{start}#shear-modulus=3e10&poisson-ratio=0.25&second-body=same&friction=0.6")
    web.fill("#shear_modulus", "2,5")
    assert web.get_attribute("#shear_modulus", "aria-invalid") == "true"
    (said,) = web.locator("#values dt").all_inner_texts()
    assert said.endswith("write a decimal point in place of the comma in 2,5")
    web.fill("#shear_modulus", "2.5")
    assert web.get_attribute("#shear_modulus", "aria-invalid") == "false"


def test_an_unknown_key_of_the_address_is_named_and_the_rest_stays(web):
    """It emptied all fields."""
    start = web.url.split("#")[0]
    web.goto(f"{start}#shear-modulos=30GPa&poisson-ratio=0.3")
    assert web.input_value("#poisson_ratio") == "0.3"
    assert web.input_value("#shear_modulus") != ""
    said = web.locator("#values dt").all_inner_texts()
    assert len(said) > 1 and said[-1] == "Not known in the address: shear-modulos"


def test_a_wrong_choice_in_the_address_is_named_and_the_rest_stays(web):
    start = web.url.split("#")[0]
    web.goto(f"{start}#shear-modulus=30GPa&poisson-ratio=0.3&plane=thin&second-body=soft")
    assert web.input_value("#plane") != "" and web.input_value("#second_body") != ""
    *values, said = web.locator("#values dt").all_inner_texts()
    assert values and said == "Not known in the address: second-body=soft, plane=thin"


def test_on_a_phone_the_lengths_are_in_sight(browser, tmp_path):
    path = tmp_path / "calculator.html"
    path.write_text(calculator.build(PATCH_TABLES), encoding="utf-8")
    web = browser.new_context(viewport={"width": 390, "height": 844}, is_mobile=True).new_page()
    web.goto(path.as_uri())
    for field in ("shear_modulus", "velocity"):
        web.fill(f"#{field}", "20")
        box = web.locator("#values").bounding_box()
        assert box["y"] >= 0 and box["y"] + box["height"] < 0.7 * 844
        assert box["y"] + box["height"] <= web.locator(f"#{field}").bounding_box()["y"]
