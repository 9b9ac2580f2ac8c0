"""What of Snakemake the project uses: its public interface, and of that what is listed here."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
RULES = [ROOT / "Snakefile", *sorted((ROOT / "workflow").rglob("*.smk"))]
PYTHON = [*sorted((ROOT / "src").rglob("*.py")), *sorted((ROOT / "workflow").rglob("*.py"))]

IMPORTED = {"exceptions import WorkflowError", "logging import logger", "utils import min_version"}
OF_THE_WORKFLOW = {"current_basedir", "execution_settings", "is_main_process"}
OF_THE_PLAN = {
    "is_main_process",
    "executor_plugin",
    "dryrun",
    "touch",
    "dag_settings",
    "persistence",
    "iocache",
}


def asked(pattern: str, paths: list[Path]) -> set[str]:
    texts = (re.sub(r"#.*", "", path.read_text("utf-8")) for path in paths)
    return {found for text in texts for found in re.findall(pattern, text, re.M)}


def test_what_is_used_of_snakemake_is_what_is_listed():
    imported = r"^\s*(?:from|import)\s+snakemake\w*\.?(.*)$"
    assert asked(imported, RULES) == IMPORTED and asked(imported, PYTHON) == set()
    assert asked(r"import_module\(\s*[\"']snakemake", PYTHON) == set()
    assert asked(r"(?<![\w./\"-])workflow\.([a-z]\w*)", RULES) == OF_THE_WORKFLOW
    assert asked(r"\b(?:setattr|sys\.modules|sys\.argv)\b", RULES) == set()
    plan = ROOT / "src/replication/pipeline/planning.py"
    assert asked(r"\b(?:_workflow|workflow)\.(\w+)", [plan]) == OF_THE_PLAN
