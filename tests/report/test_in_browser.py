"""The report in a real browser: what it loads, shows and computes."""

import numpy as np
import pytest

from nucleation.api import critical_length, stability_length
from replication.report import stability

pytestmark = pytest.mark.system


def test_loads_without_network_and_complaints(opened, report):
    assert opened.requests == [report.as_uri()]
    assert opened.complaints == []
    assert opened.page.title() == "Critical nucleation length: the replication"
    headings = opened.page.locator("h2").all_inner_texts()
    assert headings[:2] == ["The answer", "The paper's figures"]
    assert headings.index("What was replicated") > headings.index("The theory, for any fault")
    assert report.stat().st_size < 1e6
    broken = "[...document.images].filter((image) => !image.naturalWidth).length"
    assert opened.page.evaluate(broken) == 0


# ---- The theory


def test_the_calculator_begins_with_the_fault_of_the_report(web, content):
    """And it follows the fields; the page's address is that of its sections."""
    for height in (0.1, 0.02):
        web.fill("#height", f"{height}")
        fault = content["fault"] | {"height": height, "second_shear_modulus": np.inf}
        shown = web.locator("#values dd").all_inner_texts()
        critical, stable = (float(text.split()[0]) for text in shown[:2])
        assert critical == pytest.approx(float(critical_length(**without(fault))), rel=1e-4)
        expected = float(stability_length(**without(fault)))
        assert stable == pytest.approx(expected, rel=stability.PRECISION)
    assert "#" not in web.url


def without(fault):
    """The fault, whose L_c has no use for V."""
    return {name: value for name, value in fault.items() if name != "velocity"}


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
    controls = {"button", "textbox", "link", "img", "image", "table"}
    found = {}
    for node in nodes:
        role = node.get("role", {}).get("value")
        if role in controls and not node["ignored"]:
            found.setdefault(role, []).append(node.get("name", {}).get("value", ""))
    assert set(found) >= {"button", "textbox", "link"}
    for role, names in found.items():
        assert all(name.strip() for name in names), role
    regions = opened.page.locator("main section")
    for index in range(regions.count()):
        assert regions.nth(index).get_attribute("aria-labelledby")


def test_on_paper_it_has_no_controls_and_the_drawings_fit(open_report):
    web = open_report(viewport={"width": 700, "height": 990}).page
    web.emulate_media(media="print")
    for hidden in ("#fault", "nav", "#others", ".counts"):
        assert not web.locator(hidden).first.is_visible()
    assert web.locator("#values").is_visible() and web.locator("#claims").is_visible()
    assert web.locator("figure img").first.bounding_box()["width"] <= 700


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
      [...document.querySelectorAll("button, input, select, .drawing")]
      .filter((one) => !one.closest(".wide") && one.getBoundingClientRect().width > 0)
      .filter((one) => one.getBoundingClientRect().right > innerWidth + 1)
      .map((one) => one.outerHTML.slice(0, 80))""")
    assert outside == []
    cut = """() => [...document.querySelectorAll(".wide")]
      .filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.innerText)"""
    assert width > 760 or web.evaluate(cut) == []
    assert opened.complaints == []
