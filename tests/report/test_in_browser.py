"""The report in a real browser: what it loads, shows and computes."""

import dataclasses

import numpy as np
import pytest

from nucleation.model.linearised import InterfaceState
from nucleation.model.material import Material
from nucleation.report import page, stability
from nucleation.report.faults import QUANTITIES
from nucleation.theory.creep.lengths import stability_length
from nucleation.theory.critical import critical_length, critical_wavenumber
from nucleation.theory.transfer import RIGID, Body

pytestmark = pytest.mark.system

THEORY_TRACE, STABILITY_TRACE = 1, 2


def test_loads_without_network_and_complaints(opened, report):
    assert opened.requests == [report.as_uri()]
    assert opened.complaints == []
    assert opened.page.title() == "Critical nucleation length: the replication"
    headings = opened.page.locator("h2").all_inner_texts()
    assert headings[:2] == ["The answer", "The paper's figures"]
    assert headings.index("What was replicated") > headings.index(
        "The theory, for any material and interface"
    )
    assert report.stat().st_size < 8e6
    broken = "[...document.images].filter((image) => !image.naturalWidth).length"
    assert opened.page.evaluate(broken) == 0


# ---- The theory


def library_point(p):
    """The critical point by the library, for parameters under the page's names."""
    interface = InterfaceState(p["f"], p["a"], p["zeta"], p["ell"], p["V"], p["sigma0"])
    return critical_wavenumber(Body(Material(p["mu"], p["nu"]), p["H"], "traction"), RIGID,
                               interface)  # fmt: skip


def test_theory_in_the_page_is_that_of_the_library(web):
    """Lengths and frequencies for random materials and interfaces, thin blocks and half-spaces."""
    random = np.random.default_rng(5)
    cases = []
    for height in np.geomspace(1e-3, 1e3, 60):
        case = {"H": float(height)}
        for slider in QUANTITIES:
            part = random.uniform()
            low, high = slider.low * slider.factor, slider.high * slider.factor
            value = low * (high / low) ** part if slider.logarithmic else low + part * (high - low)
            case[slider.key] = float(value)
        cases.append(case)
    found = web.evaluate("(cases) => cases.map((p) => Theory.solver(p)(p.H))", cases)
    for case, point in zip(cases, found, strict=True):
        expected = library_point(case)
        assert point["length"] == pytest.approx(expected.length, rel=1e-9)
        assert point["frequency"] == pytest.approx(expected.angular_frequency, rel=1e-9)


def drawn_curve(web, trace=THEORY_TRACE):
    """Heights and lengths (m) of a curve, once the page has drawn what it was told."""
    web.evaluate("() => new Promise((done) => requestAnimationFrame(() => setTimeout(done)))")
    script = f"() => {{ const t = element('theory-plot').data[{trace}]; return [t.x, t.y]; }}"
    return np.array(web.evaluate(script))


def expected_curve(settings, **changes):
    material, interface = settings.base.material, settings.main_text_interface
    for name, value in changes.items():
        if hasattr(material, name):
            material = dataclasses.replace(material, **{name: value})
        else:
            interface = dataclasses.replace(interface, **{name: value})
    return critical_length(page.HEIGHTS, material, interface)


@pytest.mark.parametrize("slider", QUANTITIES, ids=lambda slider: slider.parameter)
def test_every_slider_moves_the_curve_to_the_right_values(web, settings, slider):
    control = web.locator(f"#range-{slider.key}")
    control.focus()
    before = drawn_curve(web)[1]
    web.keyboard.press("PageUp")
    web.keyboard.press("ArrowRight")
    value = float(web.locator(f"#number-{slider.key}").input_value())
    assert control.get_attribute("aria-valuetext") == f"{value:g}"
    heights, length = drawn_curve(web)
    np.testing.assert_allclose(heights, page.HEIGHTS, rtol=1e-12)
    expected = expected_curve(settings, **{slider.parameter: value * slider.factor})
    np.testing.assert_allclose(length, expected, rtol=1e-6)
    moved = not np.allclose(length, before, rtol=1e-6)
    assert moved == (slider.parameter != "velocity")  # V sets the frequency alone
    web.click("#reset")
    np.testing.assert_allclose(drawn_curve(web)[1], before, rtol=1e-12)


def test_values_can_be_typed_and_bad_ones_have_no_result(web, settings):
    web.fill("#number-mu", "31")
    web.fill("#number-H", "0.02")
    expected = expected_curve(settings, shear_modulus=31e9)
    np.testing.assert_allclose(drawn_curve(web)[1], expected, rtol=1e-6)
    interface = settings.main_text_interface
    length = float(critical_length(0.02, Material(shear_modulus=31e9), interface))
    values = web.locator("#values dd").all_inner_texts()
    assert float(values[0].removesuffix(" m")) == pytest.approx(length, rel=1e-4)
    assert float(values[2].removesuffix(" rad/m")) == pytest.approx(2 * np.pi / length, rel=1e-4)
    for bad in ("", "0", "-3", "1e9"):
        web.fill("#number-mu", bad)
        assert web.get_attribute("#number-mu", "aria-invalid") == "true"
        assert all(value is None for value in drawn_curve(web)[1])
        (said,) = web.locator("#values dt").all_inner_texts()
        assert said == "No values: Shear modulus must lie in 0.1 to 100 GPa"
    web.click("#reset")
    assert web.get_attribute("#number-mu", "aria-invalid") is None
    np.testing.assert_allclose(drawn_curve(web)[1], expected_curve(settings), rtol=1e-6)


def test_stability_length_in_the_page_is_that_of_the_library(web):
    """The number and the curve, at the configuration's values and as controls move."""
    factors = {slider.key: slider.factor for slider in QUANTITIES}
    for changes in ({}, {"zeta": 0.008, "nu": 0.1}, {"f": 0.9, "sigma0": 3.0, "H": 0.02}):
        for key, value in changes.items():
            web.fill(f"#number-{key}", str(value))
        heights, lengths = drawn_curve(web, STABILITY_TRACE)
        p = {key: float(web.input_value(f"#number-{key}")) * f for key, f in factors.items()}
        expected = stability_length(
            shear_modulus=p["mu"], poisson_ratio=p["nu"], normal_stress=p["sigma0"], a=p["a"],
            zeta=p["zeta"], slip_distance=p["ell"], friction=p["f"], second_shear_modulus=np.inf,
            height=np.append(heights[::80], float(web.input_value("#number-H"))),
        )  # fmt: skip
        critical, words = web.locator("#values dd").all_inner_texts()[:2]
        length, ratio = (float(text.split()[0]) for text in words.split(" m = "))
        shown = [*lengths[::80], length]
        np.testing.assert_allclose(shown, expected, rtol=stability.PRECISION)
        assert ratio == pytest.approx(length / float(critical.removesuffix(" m")), abs=0.01)
    web.click("#reset")


def test_points_tell_their_values(web, table):
    """The text beside the pointer on a point of a simulation."""
    web.evaluate("""() => {
      const last = element("theory-plot").data.length - 1;
      Plotly.Fx.hover(element("theory-plot"), [{ curveNumber: last, pointNumber: 0 }]);
    }""")
    text = web.locator("#theory-plot .hoverlayer").text_content()
    assert str(table["id"].values[0]) in text
    for name, digits in (("length", 4), ("height", 4), ("onset_time", 4), ("length_low", 3)):
        assert f"{float(table[name][0]):.{digits}g}" in text


# ---- Tables


def test_verdicts_can_be_shown_alone(web):
    everything = web.get_by_role("button", name="4 all")
    wrong = web.get_by_role("button", name="1 not replicated")
    wrong.click()
    assert wrong.get_attribute("aria-pressed") == "true"
    assert everything.get_attribute("aria-pressed") == "false"
    shown = web.locator("#claims tbody tr:not([hidden]) td:first-child")
    assert shown.all_inner_texts() == ["Fig. 3"]
    everything.click()
    assert shown.count() == 4


# ---- For everyone, on every screen


def test_every_control_has_a_name_and_every_picture_a_text(opened):
    session = opened.page.context.new_cdp_session(opened.page)
    nodes = session.send("Accessibility.getFullAXTree")["nodes"]
    controls = {"button", "slider", "spinbutton", "link", "img", "image", "table"}
    found = {}
    for node in nodes:
        role = node.get("role", {}).get("value")
        if role in controls and not node["ignored"]:
            found.setdefault(role, []).append(node.get("name", {}).get("value", ""))
    assert set(found) >= {"button", "slider", "spinbutton", "link"}
    assert len(found["slider"]) == len(QUANTITIES) + 1  # height
    for role, names in found.items():
        assert all(name.strip() for name in names), role
    regions = opened.page.locator("main section")
    for index in range(regions.count()):
        assert regions.nth(index).get_attribute("aria-labelledby")


def test_first_stop_of_the_keyboard_skips_to_the_content(open_report):
    web = open_report(viewport={"width": 1280, "height": 900}).page
    web.keyboard.press("Tab")
    assert web.evaluate("document.activeElement.textContent") == "Skip to the content"


@pytest.mark.parametrize("width", [320, 390, 768])
def test_phone_shows_all_without_scrolling_sideways(open_report, width):
    opened = open_report(viewport={"width": width, "height": 800}, is_mobile=True, has_touch=True)
    web = opened.page
    for details in web.locator("details").all():
        details.evaluate("(element) => { element.open = true; }")
    assert web.evaluate("document.documentElement.scrollWidth") <= width
    outside = web.evaluate("""() =>
      [...document.querySelectorAll("button, input, select, .plot, img")]
      .filter((one) => !one.closest(".wide") && one.getBoundingClientRect().width > 0)
      .filter((one) => one.getBoundingClientRect().right > innerWidth + 1)
      .map((one) => one.outerHTML.slice(0, 80))""")
    assert outside == []
    cut = """() => [...document.querySelectorAll(".wide")]
      .filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.innerText)"""
    assert width > 760 or web.evaluate(cut) == []
    assert opened.complaints == []
