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

OF_THE_WORKFLOW = {
    "workflow.current_basedir",
    "workflow.execution_settings",
    "workflow.is_main_process",
}
"""What the rules ask the workflow themselves."""

OF_THE_PLAN = {
    "is_main_process",
    "executor_plugin",
    "dryrun",
    "touch",
    "dag_settings",
    "persistence",
    "iocache",
}
"""What :class:`replication.pipeline.planning.Plan` asks the workflow."""


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
    assert not any(found[path] for path in PYTHON), "the packages need no Snakemake"


def test_rules_ask_the_workflow_for_what_is_listed():
    text = "\n".join(re.sub(r"#.*", "", path.read_text("utf-8")) for path in RULES)
    assert set(re.findall(r"(?<![\w./\"-])workflow\.[a-z]\w*", text)) == OF_THE_WORKFLOW
    assert not re.findall(r"\b(?:setattr|sys\.modules|sys\.argv)\b", text)


def test_the_plan_asks_the_workflow_for_what_is_listed():
    text = (ROOT / "src/replication/pipeline/planning.py").read_text("utf-8")
    asked = re.findall(r"\b(?:_workflow|workflow)\.(\w+)", text)
    assert set(asked) == OF_THE_PLAN
