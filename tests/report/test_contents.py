"""What the report is made of, without a browser."""

import base64
import io
import json
import re
from html.parser import HTMLParser

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from docutils.utils import SystemMessage
from jinja2 import UndefinedError
from PIL import Image

from replication.figures import catalogue
from replication.report import encode, page, summary, tables, verdicts

ROOT = encode.HERE.parents[2]


def downloads(html):
    """Every file that a page offers: name to content."""
    found = re.findall(r'download="([^"]+)" href="data:[^;]+;base64,([^"]+)"', html)
    return {name: base64.b64decode(content) for name, content in found}


@pytest.fixture(scope="module")
def html(report):
    return report.read_text(encoding="utf-8")


# ---- Files that can be taken out of the page


@pytest.mark.slow
def test_tables_can_be_downloaded_with_units_and_all_values(html, content):
    files = downloads(html)
    assert files["figure_2.pdf"].startswith(b"%PDF")
    assert json.loads(files["configuration.json"]) == content["config"]
    ratio = pd.read_csv(io.BytesIO(files["theory-bimaterial_length_ratio.csv"]))
    expected = content["results"]["theory"]["bimaterial_length_ratio"]
    assert list(ratio.columns) == ["zeta_over_a", "f_beta", "bimaterial_length_ratio"]
    for row in ratio.sample(20, random_state=1).itertuples():
        value = expected.sel(zeta_over_a=row.zeta_over_a, f_beta=row.f_beta)
        assert row.bimaterial_length_ratio == pytest.approx(float(value), rel=1e-12)


def test_the_report_opens_with_the_length_at_the_drop_its_range_and_the_noise(table):
    quiet = {"length": 0.156, "length_low": 0.138, "length_high": 0.162, "critical_length": 0.235,
             "stability_length": 0.131}  # fmt: skip
    noisy = {"role": "converged", "kind": "normal_load", "strength": 1e-5, "length": 0.162}

    def run(**values):
        return table.assign({name: ("run", [value]) for name, value in values.items()})

    runs = [run(**quiet), run(**quiet | noisy), run(**quiet | {"height": 0.1, "length": 0.2})]
    runs = [run.assign(ensemble=("run", [str(i)])) for i, run in enumerate(runs)]
    runs[2]["fault"] = "run", ["another"]
    shown = summary.of_paper(xr.concat(runs, "run"))
    assert [shown[name] for name in ("length", "low", "high")] == ["0.156", "0.138", "0.162"]
    assert shown["ratios"] == {"paper": "0.66 to 0.85", "converged": "0.69"}
    assert (shown["creep"], shown["thickest"]) == ("0.56", "0.1")
    assert shown["declared"]["length"] == "0.162" and shown["declared"]["strength"] == "0.001"
    assert shown["mesh"] == "a mesh of 60 x 6 elements" and "60 x 6" in shown["caution"]
    fine = summary.of_paper(run(n_x=400, n_y=150))
    assert (fine["mesh"], fine["caution"]) == ("the paper's mesh", "")
    assert summary.of_paper(run(role="own")) is None


# ---- Parts


@pytest.mark.slow
def test_sections_without_content_are_left_out(content):
    bare = page.build(**{**content, "claims": [], "pictures": [], "results": {}})
    for part in ("verdicts", "lengths", "answer"):
        assert f'id="{part}"' not in bare
    assert "<figure" not in bare
    assert 'id="theory"' in bare


@pytest.mark.slow
def test_every_claim_and_run_is_in_the_tables(html, table):
    assert html.count('<tr role="row" data-kind=') == 4
    (row,) = tables.run_rows(table, tables.LENGTH_COLUMNS)
    assert float(row["Length (m)"]) == pytest.approx(float(table["length"][0]), rel=1e-3)
    assert float(row["Time (s)"]) == pytest.approx(float(table["wall_seconds"][0]), rel=5e-3)
    ratio = float(table["length"][0] / table["critical_length"][0])
    assert float(row["Over theory"]) == pytest.approx(ratio, rel=5e-3)


def test_claims_as_they_are_shown(content):
    onset, ratio, unknown, wrong = verdicts.claim_rows(content["claims"])
    assert (onset["paper"], onset["ours"], onset["spread"]) == ("13 s", "12.78", "(12.78 to 12.87)")
    assert (ratio["ours"], ratio["spread"], ratio["unit"]) == ("2.356", "", "")
    assert (unknown["paper"], unknown["ours"], unknown["spread"]) == ("", "", "")
    assert wrong["spread"] == "(8 to 11)"
    counts = {c["verdict"]: c["count"] for c in verdicts.verdict_counts(content["claims"])}
    assert counts == dict.fromkeys(set(verdicts.VERDICTS) - {"taken as given", "not supported"}, 1)


def test_runs_without_an_event_have_dashes(table):
    without = table.assign(length=("run", [np.nan]), onset_time=("run", [np.nan]))
    (row,) = tables.run_rows(without, ("Onset (s)", "Over theory"))
    assert row == {"Onset (s)": "–", "Over theory": "–"}


def test_what_is_downloaded_has_a_line_for_each_row(table):
    """A table with curves beside its rows once made a report of 650 MB."""
    beside = table.assign(
        curve=("place", np.arange(50.0)), profile=(("case", "place"), np.ones((4, 50)))
    )
    head, *rows = tables.csv_of(beside).decode().splitlines()
    assert len(rows) == table.sizes["run"] and "height (m)" in head and "curve" not in head


# ---- Texts


def test_every_figure_has_a_caption_that_is_valid():
    names = {path.stem for path in (ROOT / "workflow" / "report").glob("*.rst")} - {"workflow"}
    assert names == {*catalogue.FIGURES, "figure_studies"}
    for name in names:
        template = (ROOT / "workflow" / "report" / f"{name}.rst").read_text(encoding="utf-8")
        shown = encode.caption_html(template, {"id": "the-run", "study": "the-run"})
        assert ("the-run" in shown) == ("{{" in template)
        assert "{" not in shown and ":math:" not in shown and "<script" not in shown
        assert ("<math" in shown) == (":math:" in template)


@pytest.mark.parametrize(
    ("template", "error"),
    [("{{ height }}", UndefinedError), ("*not closed", SystemMessage)],
)
def test_mistakes_in_captions_stop_the_report(template, error):
    with pytest.raises(error):
        encode.caption_html(template, {})


@pytest.mark.parametrize(("dots", "width"), [(300.0, 336), (None, 1050)])
def test_pictures_have_their_physical_width(dots, width):
    file = io.BytesIO()
    options = {"dpi": (dots, dots)} if dots else {}
    Image.new("RGB", (1050, 2)).save(file, "PNG", **options)
    assert encode.width(file.getvalue()) == width  # 3.5 inches of 96 dots


def test_no_text_can_end_the_script_that_holds_the_data():
    text = encode.script_json({"name": "</script><b>"})
    assert "</script" not in text
    assert json.loads(text) == {"name": "</script><b>"}
    with pytest.raises(ValueError, match="JSON compliant"):
        encode.script_json(float("nan"))


def test_catalogue_names_figures_that_exist_and_what_they_stand_on():
    drawn = {path.stem for path in (ROOT / "src/replication/figures").rglob("figure_*.py")}
    assert set(catalogue.FIGURES) == drawn - {"figure_studies"}
    assert "figure_3" not in catalogue.drawable(["mine"])
    assert {"figure_2", "figure_3"} <= set(catalogue.drawable(["paper"]))


EVIL = """'"><img src=x onerror=alert(1)></script><script>alert(2)</script><!--<script>{{ 7 }}"""


class Tags(HTMLParser):
    """The elements of a page, with their attributes, and the texts of its scripts."""

    def __init__(self, text):
        super().__init__()
        self.found, self.scripts, self._within = [], [], False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, dict(attrs)))
        self._within = tag == "script"
        if self._within:
            self.scripts.append("")

    def handle_endtag(self, tag):
        self._within = self._within and tag != "script"

    def handle_data(self, data):
        if self._within:
            self.scripts[-1] += data


def test_no_text_becomes_a_part_of_the_page(content):
    """Descriptions, names, claims and attributes of datasets may come from others."""
    lengths = content["results"]["lengths"].copy(deep=True)
    for name in ("id", "study"):
        lengths[name] = lengths[name].astype(object).where(False, EVIL).astype(str)
    lengths.attrs |= {"command": EVIL, "created": EVIL, "code_digest": EVIL}
    words = ("where", "statement", "paper", "unit", "reason", "quotation", "method")
    claims = [{**claim, **dict.fromkeys(words, EVIL)} for claim in content["claims"]]
    (picture,) = content["pictures"]
    evil = dict(
        content,
        config={**content["config"], "studies": {"s": {"description": EVIL}}, EVIL: EVIL},
        origin={"versions": json.dumps({EVIL: EVIL}), "created": EVIL, "code_digest": EVIL},
        results={**content["results"], "lengths": lengths, EVIL: lengths},
        pictures=[{**picture, "name": EVIL, "title": EVIL, "category": EVIL}],
        claims=claims,
    )
    good, bad = Tags(page.build(**content)), Tags(page.build(**evil))
    assert EVIL not in page.build(**evil)
    assert len(good.scripts) == len(bad.scripts)
    assert not [tag for tag, attributes in bad.found if any(a.startswith("on") for a in attributes)]
    kinds = {tag for tag, _ in good.found}
    assert {tag for tag, _ in bad.found} == kinds
