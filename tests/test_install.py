"""The set-up: uv installs with pip's settings, and pip where uv can't."""

import hashlib
import os
import shutil
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest

from workflow import install

ROOT = Path(__file__).parents[1]


def test_settings_of_pip_are_settings_of_uv():
    given = {
        "index-url": "https://one.example/simple",
        "extra-index-url": "https://two.example/simple\nhttps://three.example/simple",
        "find-links": "/wheels /more",
        "cert": "/own.pem",
        "retries": "7",
    }
    assert install.variables_of_uv(given) == {
        "UV_INDEX_STRATEGY": "unsafe-best-match",
        "UV_DEFAULT_INDEX": "https://one.example/simple",
        "UV_INDEX": "https://two.example/simple https://three.example/simple",
        "UV_FIND_LINKS": "/wheels,/more",
        "SSL_CERT_FILE": "/own.pem",
    }
    assert install.variables_of_uv({"only-binary": ":all:"}) is None


@pytest.fixture(scope="module")
def links(tmp_path_factory):
    """A directory with one wheel, and its pinned and hashed requirement."""
    folder = tmp_path_factory.mktemp("links")
    wheel = folder / "pebble-1.0-py3-none-any.whl"
    about = "pebble-1.0.dist-info"
    with zipfile.ZipFile(wheel, "w") as archive:
        archive.writestr("pebble.py", "weight = 3\n")
        archive.writestr(f"{about}/METADATA", "Metadata-Version: 2.1\nName: pebble\nVersion: 1.0\n")
        archive.writestr(f"{about}/WHEEL", "Wheel-Version: 1.0\nTag: py3-none-any\n")
        archive.writestr(f"{about}/RECORD", "")
    digest = hashlib.sha256(wheel.read_bytes()).hexdigest()
    (folder / "pinned.txt").write_text(f"pebble==1.0 --hash=sha256:{digest}\n")
    (folder / "wrong.txt").write_text(f"pebble==1.0 --hash=sha256:{digest[::-1]}\n")
    return folder


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """One for all tests, each of which leaves it as it was: pip takes two seconds to be there."""
    directory = tmp_path_factory.mktemp("venv")
    venv.create(directory, with_pip=True)
    return directory


def installed(environment, links, requirements, **settings):
    """The exit status, and the program that installed the wheel."""
    program = shutil.which("uv") or Path(sys.executable).with_name("uv")
    given = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")}
    given |= {"PIP_CONFIG_FILE": os.devnull, "PIP_NO_INDEX": "1", "PIP_FIND_LINKS": str(links)}
    given["PATH"] = os.pathsep.join([str(Path(program).parent), given["PATH"]])
    command = [environment / "bin" / "python", "-P", ROOT / "workflow" / "install.py"]
    done = subprocess.run([*command, links / requirements], env=given | settings, timeout=120)
    (site,) = environment.glob("lib/python*/site-packages")
    about = site / "pebble-1.0.dist-info"
    installer = (about / "INSTALLER").read_text().strip() if about.exists() else ""
    shutil.rmtree(about, ignore_errors=True)  # installed no longer
    (site / "pebble.py").unlink(missing_ok=True)
    return done.returncode, installer


@pytest.mark.slow
def test_uv_installs_with_the_settings_of_pip(environment, links):
    assert installed(environment, links, "pinned.txt") == (0, "uv")


@pytest.mark.slow
def test_pip_installs_where_uv_lacks_a_setting(environment, links):
    assert installed(environment, links, "pinned.txt", PIP_ONLY_BINARY=":all:") == (0, "pip")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("requirements", "constraint"),
    [("wrong.txt", ""), ("pinned.txt", "pebble<1")],
    ids=["other hash", "excluded by a constraint"],
)
def test_refused_by_both(environment, links, tmp_path, requirements, constraint):
    (tmp_path / "constraints.txt").write_text(constraint)
    given = {"PIP_CONSTRAINT": str(tmp_path / "constraints.txt")}
    code, installer = installed(environment, links, requirements, **given)
    assert code != 0 and installer == ""
