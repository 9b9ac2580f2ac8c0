"""A release in one directory: results, article, report, source and wheel, with their checksums."""

import hashlib
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from ..configuration.load import load
from . import bundle
from .code import ROOT

CHECKOUT = ROOT.parent.parent
CHECKSUMS = "SHA256SUMS"
SHOWN = ("replication.pdf", "replication.tex", "report.html")
METADATA = ("CITATION.cff", "codemeta.json", ".zenodo.json")
MARK = "TO BE FILLED IN"


def build(directory: Path, configuration: Path) -> None:
    """Write a release to a new directory, from the commit and from results that are there.

    Raises
    ------
    OSError, BundleError, subprocess.CalledProcessError
        If the directory exists, or a part can't be made.
    """
    project = tomllib.loads((CHECKOUT / "pyproject.toml").read_text("utf-8"))["project"]
    stem = f"{project['name']}-{project['version']}"
    results = Path(load(configuration).results)
    directory.mkdir(parents=True)
    bundle.write(directory / f"{stem}-results.tar", configuration)
    for name in SHOWN:
        shutil.copyfile(results / name, directory / name)
    source = (directory / f"{stem}-source.tar.gz").resolve()
    git = ["git", "-C", str(CHECKOUT), "archive", f"--prefix={stem}/", f"--output={source}", "HEAD"]
    subprocess.run(git, check=True)
    with tempfile.TemporaryDirectory() as place:  # so that the wheel is of the commit, too
        subprocess.run(["tar", "-xzf", str(source), "-C", place], check=True)
        pip = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation"]
        subprocess.run([*pip, "-w", str(directory), f"{place}/{stem}"], check=True)
    lines = []
    for path in sorted(directory.iterdir()):
        with path.open("rb") as file:
            lines.append(f"{hashlib.file_digest(file, 'sha256').hexdigest()}  {path.name}\n")
    (directory / CHECKSUMS).write_text("".join(lines), "utf-8")


def missing(checkout: Path = CHECKOUT) -> list[str]:
    """What has to be done before the files are uploaded."""
    found = [f"{n}: {MARK}" for n in METADATA if MARK in (checkout / n).read_text("utf-8")]
    if commit(checkout).endswith("-dirty"):
        found.append("files differ from the commit, and are not in the release")
    return found


def commit(checkout: Path) -> str:
    """The commit of a checkout, with "-dirty" if files differ from it; empty outside of git."""
    git = ["git", f"--git-dir={checkout / '.git'}", f"--work-tree={checkout}"]
    command = [*git, "describe", "--always", "--dirty", "--abbrev=40", "--exclude=*"]
    try:
        return subprocess.run(command, capture_output=True, text=True).stdout.strip()
    except OSError:  # no git
        return ""


def main(directory: str, configuration: str = "config/config.yaml") -> None:
    """Write a release with the results of a configuration, and say what is to be done."""
    build(Path(directory), Path(configuration))
    for line in [*missing(), "see CONTRIBUTING.md, A release"]:
        print(f"Before uploading: {line}", file=sys.stderr)


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except (bundle.BundleError, ValueError, OSError, subprocess.CalledProcessError) as error:
        sys.exit(str(error))
