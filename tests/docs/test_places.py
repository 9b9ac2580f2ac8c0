"""What pages and sources name is there; the house is as CONTRIBUTING draws it."""

import inspect
import pydoc
import re
import tomllib
from functools import cache

import pytest
from docs.samples import FENCE, PAGES, ROOT, samples

SOURCE = ROOT / "src" / "nucleation"
REPLICATION = ROOT / "src" / "replication"
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
ROOTS = ("src", "benchmarks", "workflow", "docs")
FILES = [ROOT / "Snakefile", *sorted((ROOT / "workflow").rglob("*.smk"))]
FILES += [path for root in ROOTS for path in sorted((ROOT / root).rglob("*.py"))]

ROLE = re.compile(r"[:{](?:mod|class|exc|func|meth|attr|data|obj)[:}]`(?:[^`<]*<)?~?([\w.]+)>?`")
DOTTED = re.compile(
    r"(?<![\w./-])(?:nucleation|replication)(?!\.(?:sif|tar|pdf|tex|md))"
    r"(?:\.[A-Za-z_]\w*)+(?![\w*/])"
)
FILE = re.compile(
    r"(?<![\w/.{}<>~:-])((?:[\w.-]+/)+[\w-][\w.-]*\.(?:py|smk|edp|html|js|css|md|rst|yaml|sh)"
    r"|\w+\.(?:py|smk|edp|js|css))\b(?![\w/*]|\.in\b)"
)
"""A file with its folder, or the bare name of a source."""
OF_OTHERS = {"sitecustomize.py"}


@cache
def exists(name):
    """Whether a name with its dots is of anything, or of what the objects of a class have."""
    owner, _, last = name.rpartition(".")
    found = owner and pydoc.locate(owner)
    if not isinstance(found, type):
        return bool(owner) and (hasattr(found, last) or pydoc.locate(name) is not None)
    own = [
        base for base in found.__mro__ if base.__module__.startswith(("nucleation", "replication"))
    ]
    return hasattr(found, last) or any(
        last in vars(base).get("__annotations__", {}) or f"self.{last}" in inspect.getsource(base)
        for base in own
    )


def resolves(target, path):
    """Whether a role's target is a name, seen from a file, its packages or one of its classes."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    place = ".".join(parts[parts[0] == "src" :]).removesuffix(".__init__")
    outer = [place.rsplit(".", n)[0] for n in range(place.count(".") + 1)]
    classes = re.findall(r"^class (\w+)", path.read_text(encoding="utf-8"), re.M)
    tail = target.removeprefix(".")
    names = [f"{start}.{tail}" for start in (*outer, *(f"{place}.{name}" for name in classes))]
    return any(map(exists, names if target.startswith(".") else [target, *names]))


def text_of(path):
    """A page without its samples, or a source."""
    text = path.read_text(encoding="utf-8")
    return FENCE.sub("", text) if path.suffix == ".md" else text


def test_roles_and_names_with_dots_resolve():
    """Each ``:func:``, ``{class}`` and so on, and each name that begins with the package's."""
    stale = {}
    for path in (*PAGES, *FILES):
        text = text_of(path)
        missing = {name for name in ROLE.findall(text) if not resolves(name, path)}
        missing |= {name for name in DOTTED.findall(text) if not exists(name)}
        if missing:
            stale[str(path.relative_to(ROOT))] = missing
    assert stale == {}


def test_files_exist():
    """With their folders, and sources by their bare names."""
    known = {p.name for root in (*ROOTS, "tests") for p in (ROOT / root).rglob("*.*")} | OF_OTHERS
    stale = {}
    for path in (*PAGES, *FILES):
        named = {n for n in FILE.findall(text_of(path)) if not n.startswith("results/")} - known
        roots = (
            ROOT,
            SOURCE,
            REPLICATION,
            SOURCE.parent,
            ROOT / "docs",
            ROOT / "tests",
            path.parent,
        )
        missing = {name for name in named if not any((root / name).exists() for root in roots)}
        if path.suffix == ".md":  # without what a page has its readers write
            missing -= {sample.file for sample in samples(path)}
        if missing:
            stale[str(path.relative_to(ROOT))] = missing
    assert stale == {}


@pytest.mark.parametrize("package", ["nucleation", "replication"])
def test_rooms_are_those_of_the_contracts(package):
    """From the roof to the ground, those on one floor in one line."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    (layers,) = (
        contract["layers"]
        for contract in project["tool"]["importlinter"]["contracts"]
        if contract.get("containers") == [package]
    )
    floors = [re.findall(r"\w+", layer) for layer in layers if layer != "__main__"]
    table = CONTRIBUTING.split(f"| in `src/{package}` |")[1].split("\n\n")[0]
    rows = re.findall(r"^\| (`.*?`) \|", table, re.M)
    assert [re.findall(r"`(\w+)", row) for row in rows] == floors
    entries = {
        p.stem
        for p in (ROOT / "src" / package).iterdir()
        if p.suffix == ".py" or (p / "__init__.py").exists()
    }
    assert entries - {"__init__", "__main__"} == {room for floor in floors for room in floor}


def test_every_target_is_in_the_table_of_targets():
    """Rules without wildcards that draw a figure, and those that gather others' results."""
    places = ROOT / "workflow" / "rules"
    rules = set()
    for name in ("targets.smk", "figures.smk"):
        text = (places / name).read_text(encoding="utf-8")
        for rule in re.split(r"^rule ", text, flags=re.M)[1:]:
            if "{{study}}" not in rule:
                rules.add(rule.partition(":")[0])
    page = (ROOT / "docs" / "studies.md").read_text(encoding="utf-8")
    table = page.split("| target |")[1].split("\n\n")[0]
    assert len(rules) >= 15
    assert rules <= set(re.findall(r"`(\w+)`", table))


def headings(page):
    """The addresses within a page: its headings as the forge names them, and its anchors."""
    text = page.read_text(encoding="utf-8")
    titles = re.findall(r"^#+ (.+)$", FENCE.sub("", text), re.M)
    without_links = [re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", title) for title in titles]
    plain = [re.sub(r"[^\w\s-]", "", title.lower()) for title in without_links]
    slugs = {re.sub(r"\s", "-", title.strip()) for title in plain}
    return slugs | set(re.findall(r'<a id="([\w-]+)">', text))


@pytest.mark.parametrize("page", [*PAGES, ROOT / "CHANGELOG.md"], ids=lambda page: page.name)
def test_linked_pages_and_headings_exist(page):
    links = re.findall(r"\]\(([\w./-]+?)(?:#([\w-]+))?\)", page.read_text(encoding="utf-8"))
    for name, heading in links:
        target = page.parent / name
        assert target.exists(), name
        assert not heading or target.suffix != ".md" or heading in headings(target), heading
