"""What of Snakemake the project uses: its public interface, and of that what is listed here."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
RULES = [ROOT / "Snakefile", *sorted((ROOT / "workflow").rglob("*.smk"))]
PYTHON = [*sorted((ROOT / "src").rglob("*.py")), *sorted((ROOT / "workflow").rglob("*.py"))]

IMPORTED = {
    "snakemake.exceptions.WorkflowError",
    "snakemake.logging.logger",
    "snakemake.utils.min_version",
}

OF_THE_WORKFLOW = {"workflow.current_basedir"}
"""What the rules ask the workflow itself. `rules` is handed on, and asked as rules.NAME.input."""

ABOUT_RULES = {"said.input", "said.params", "said.output"}
"""What is read of a rule by :class:`nucleation.pipeline.steps.Steps`."""

OF_A_SCRIPT = {"input", "output", "params", "log", "rule"}
"""What a script reads of the object ``snakemake`` that it is given."""


def imports(text: str) -> set[str]:
    """Names of Snakemake, or of its plug-ins, that a text imports or names as modules."""
    found = set()
    imported = r"^[ \t]*from\s+(snakemake[\w.]*)\s+import\s+(.+)$"
    for module, names in re.findall(imported, text, re.M):
        found |= {f"{module}.{name.strip()}" for name in names.strip("()").split(",")}
    found |= set(re.findall(r"^[ \t]*import\s+.*?(snakemake\w*[\w.]*)", text, re.M))
    return found | set(re.findall(r"""import_module\(\s*["'](snakemake[\w.]*)""", text))


def test_imports_of_snakemake_are_those_listed():
    found = {path: imports(path.read_text("utf-8")) for path in [*PYTHON, *RULES]}
    assert set().union(*found.values()) == IMPORTED
    assert not any(found.get(path) for path in PYTHON), "no module of the package needs Snakemake"


def test_rules_ask_the_workflow_for_what_is_public():
    text = "\n".join(re.sub(r"#.*", "", path.read_text("utf-8")) for path in RULES)
    assert set(re.findall(r"(?<![\w./\"-])workflow\.[a-z]\w*", text)) == OF_THE_WORKFLOW
    assert set(re.findall(r"(?<![\w./\"-])rules\b(?:\.\w+)?(?=[\s.,)\[])", text)) == {"rules"}
    assert "steps = Steps(rules, RESULTS, tidies=FIRST)" in text
    assert not re.findall(r"\b(?:setattr|sys\.modules|sys\.argv)\b", text)


def test_scripts_and_steps_read_what_is_public():
    package = [path for path in PYTHON if path.parent.name == "pipeline"]
    text = "\n".join(path.read_text("utf-8") for path in package)
    assert set(re.findall(r"(?<!\w)said\.\w+", text)) == ABOUT_RULES
    asked = set(re.findall(r"(?<![\w./])snakemake\.(\w+)", text))
    assert asked == OF_A_SCRIPT
