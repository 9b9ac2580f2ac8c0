"""A release in one directory: results, article, report, source and wheel, with their checksums."""

from __future__ import annotations

import hashlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import click

from ..configuration.load import load
from . import bundle
from .crate import CHECKOUT, commit

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


@click.command()
@click.argument("directory", type=click.Path(path_type=Path))
@click.argument("configuration", type=click.Path(path_type=Path), default="config/config.yaml")
def main(directory: Path, configuration: Path) -> None:
    """Write a release with the results of CONFIGURATION to DIRECTORY, and say what to upload."""
    build(directory, configuration)
    told = (CHECKOUT / "CONTRIBUTING.md").read_text("utf-8")
    click.echo(re.findall(r"^## A release\n.*?(?=^## |\Z)", told, re.M | re.S)[0].strip())
    for line in missing():
        click.echo(f"Before uploading: {line}", err=True)


if __name__ == "__main__":
    try:
        main.main(standalone_mode=True)
    except (bundle.BundleError, ValueError, OSError, subprocess.CalledProcessError) as error:
        sys.exit(str(error))
