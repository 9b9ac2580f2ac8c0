"""A release in one directory: results, article, report, source and wheel, with their checksums."""

import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from ..configuration.load import load
from . import bundle
from .code import ROOT
from .store import content

CHECKOUT = ROOT.parent.parent
CHECKSUMS = "SHA256SUMS"
SHOWN = ("replication.pdf", "replication.tex", "report.html")


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
    lines = [f"{content(path)}  {path.name}\n" for path in sorted(directory.iterdir())]
    (directory / CHECKSUMS).write_text("".join(lines), "utf-8")


def main(directory: str, configuration: str = "config/config.yaml") -> None:
    """Write a release with the results of a configuration, and say what is to be done."""
    build(Path(directory), Path(configuration))
    print("Before uploading: see CONTRIBUTING.md, A release", file=sys.stderr)


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except (bundle.BundleError, ValueError, OSError, subprocess.CalledProcessError) as error:
        sys.exit(str(error))
