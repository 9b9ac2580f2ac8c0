"""The site of the documentation, which takes a minute and a half to build: tutorials simulate."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from docs.samples import ROOT
from once import once


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """The built site, by the command of `make docs`, once for all workers."""
    makefile = (ROOT / "Makefile").read_text()
    recipe = re.search(r"^docs:.*\n\t\$\(BIN\)/sphinx-build (-W .*)$", makefile, re.M)[1]

    def build(directory: Path) -> None:
        options = recipe.replace("docs/_build/html", str(directory)).split()
        done = subprocess.run(
            [sys.executable, "-m", "sphinx", *options], cwd=ROOT, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=1500,
        )  # fmt: skip
        assert done.returncode == 0, done.stdout

    return once(tmp_path_factory, "site", build)
