"""What an archive of results says of itself to machines: RO-Crate 1.1.

https://w3id.org/ro/crate/1.1: a flat list of entities that refer to each other. Here: the archive,
its files, the code that made them, its authors and licence, and the paper.
"""

import json
import mimetypes
import subprocess
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import quote

import yaml

from ..datasets.provenance import moment
from .code import ROOT

CRATE = "ro-crate-metadata.json"
CHECKOUT = ROOT.parent.parent
SPECIFICATION = "https://w3id.org/ro/crate/1.1"
# the digest of a file is not among the terms of version 1.1
TERMS = [f"{SPECIFICATION}/context", {"sha256": "https://schema.org/sha256"}]


class Packed(NamedTuple):
    """A file of an archive: its name there, its source, size (bytes) and SHA-256."""

    name: str
    source: Path | bytes
    size: int
    digest: str


def crate(files: Iterable[Packed]) -> bytes:
    """The content of ``ro-crate-metadata.json``, with files in its list."""
    cited, created = _citation(), moment().isoformat(timespec="seconds")
    article, address = cited["references"][0], f"https://spdx.org/licenses/{cited['license']}"
    licence = _entity(address, "CreativeWork", name=cited["license"])
    developers, authors = ([*map(_agent, one["authors"])] for one in (cited, article))
    paper = _entity(
        f"https://doi.org/{article['doi']}", "ScholarlyArticle", name=article["title"],
        datePublished=str(article["year"]), author=_ids(*authors),
    )  # fmt: skip
    code = _entity(
        "#code", "SoftwareSourceCode", name=cited["title"], version=str(cited["version"]),
        identifier=commit(CHECKOUT) or "none", license=_ids(licence), author=_ids(*developers),
    )  # fmt: skip
    described = [_file(file) for file in files]
    root = _entity(
        "./", "Dataset", name=f"Results of {cited['title']}", description=cited["abstract"],
        datePublished=created, license=_ids(licence), author=_ids(*developers),
        citation=_ids(paper), hasPart=_ids(*described), isBasedOn=_ids(code),
    )  # fmt: skip
    about = _entity(CRATE, "CreativeWork", conformsTo={"@id": SPECIFICATION}, about=_ids(root))
    graph = [about, root, code, licence, paper, *authors, *developers, *described]
    return json.dumps({"@context": TERMS, "@graph": graph}, indent=1).encode()


def _citation() -> dict[str, Any]:
    return dict(yaml.safe_load((CHECKOUT / "CITATION.cff").read_text(encoding="utf-8")))


def _entity(id: str, kind: str, **fields: Any) -> dict[str, Any]:
    return {"@id": id, "@type": kind, **fields}


def _ids(*entities: dict[str, Any]) -> Any:
    """A reference to an entity, or to several."""
    found = [{"@id": entity["@id"]} for entity in entities]
    return found[0] if len(found) == 1 else found


def _file(file: Packed) -> dict[str, Any]:
    return _entity(
        quote(file.name), "File", name=file.name, contentSize=str(file.size), sha256=file.digest,
        encodingFormat=mimetypes.guess_type(file.name)[0] or "text/plain",
    )  # fmt: skip


def _agent(author: dict[str, str]) -> dict[str, Any]:
    """A person or, named by one name, a group of people."""
    name = author.get("name") or f"{author['given-names']} {author['family-names']}"
    kind = "Organization" if "name" in author else "Person"
    return _entity(author.get("orcid", f"#{quote(name)}"), kind, name=name)


def commit(checkout: Path) -> str:
    """The commit of a checkout, with "-dirty" if files differ from it; empty outside of git."""
    git = ["git", f"--git-dir={checkout / '.git'}", f"--work-tree={checkout}"]
    command = [*git, "describe", "--always", "--dirty", "--abbrev=40", "--exclude=*"]
    try:
        return subprocess.run(command, capture_output=True, text=True).stdout.strip()
    except OSError:  # no git
        return ""
