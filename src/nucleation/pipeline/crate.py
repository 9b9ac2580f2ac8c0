"""An archive of results described as a research object: RO-Crate 1.1, JSON-LD that machines read.

https://w3id.org/ro/crate/1.1: one flat list of entities that refer to each other. Here: the
archive, its files, the parameters, the code that made them, its authors and licence, and the paper.
"""

from __future__ import annotations

import json
import mimetypes
import subprocess
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import quote

import yaml

from ..configuration.load import Configuration
from ..datasets.provenance import PACKAGE, versions
from ..model.quantities import declarations
from .archives import CONFIGURATION, CRATE, MANIFEST, BundleError
from .code import ROOT

CHECKOUT = ROOT.parent.parent
CONTEXT = ["https://w3id.org/ro/crate/1.1/context", {"sha256": "https://schema.org/sha256"}]
"""The terms; the digest of a file is not among those of version 1.1."""

FORMATS = {
    ".nc": "application/x-netcdf", ".md": "text/markdown", ".yaml": "application/yaml",
    ".yml": "application/yaml", ".log": "text/plain",
}  # fmt: skip
"""Media types that Python's table may lack."""

Entity = dict[str, Any]


class Packed(NamedTuple):
    """What is said of a file in the archive: its digest (SHA-256) and its size (bytes)."""

    digest: str
    size: int


def text(settings: Configuration, files: dict[str, Packed], created: str) -> str:
    """The text of ``ro-crate-metadata.json``.

    Parameters
    ----------
    settings : Configuration
        What the results were made with.
    files : dict
        The archive's files by name, without Snakemake's notes.
    created : str
        Date and time, ISO 8601.
    """
    citation = _citation()
    licence = {
        "@id": f"https://spdx.org/licenses/{citation['license']}",
        "@type": "CreativeWork",
        "name": citation["license"],
    }
    authors = [_agent(author, f"#author-{n}") for n, author in enumerate(citation["authors"], 1)]
    papers = [paper for entry in citation["references"] for paper in _article(entry)]
    parameters = _parameters(settings)
    code = _code(citation, licence, authors)
    described = [_file(name, packed) for name, packed in files.items()]
    root = {
        "@id": "./",
        "@type": "Dataset",
        "name": f"Results of {citation['title']}",
        "description": citation["abstract"].strip(),
        "datePublished": created,
        "license": _reference(licence),
        "author": [_reference(author) for author in authors],
        "citation": [_reference(paper) for paper in papers if paper["@type"] == "ScholarlyArticle"],
        "hasPart": [_reference(file) for file in described],
        "mentions": {"@id": "#making"},
    }
    making = {
        "@id": "#making",
        "@type": "CreateAction",
        "name": "The workflow run that made the results",
        "endTime": created,
        "instrument": _reference(code[0]),
        "object": [{"@id": CONFIGURATION}, *(_reference(value) for value in parameters)],
        "result": [_reference(f) for f in described if f["@id"] not in (CONFIGURATION, MANIFEST)],
    }
    graph = [
        _descriptor(),
        root,
        *described,
        making,
        *code,
        *parameters,
        licence,
        *authors,
        *papers,
    ]
    return json.dumps({"@context": CONTEXT, "@graph": graph}, indent=1, ensure_ascii=False) + "\n"


def _descriptor() -> Entity:
    return {
        "@id": CRATE,
        "@type": "CreativeWork",
        "conformsTo": {"@id": "https://w3id.org/ro/crate/1.1"},
        "about": {"@id": "./"},
    }


def _reference(entity: Entity) -> Entity:
    return {"@id": entity["@id"]}


def _file(name: str, packed: Packed) -> Entity:
    suffix = Path(name).suffix
    return {
        "@id": quote(name),
        "@type": "File",
        "name": name,
        "contentSize": str(packed.size),
        "encodingFormat": FORMATS.get(suffix) or mimetypes.guess_type(name)[0] or "text/plain",
        "sha256": packed.digest,
    }


def _parameters(settings: Configuration) -> list[Entity]:
    """Every value that the results stand on, also those left out of the configuration's file."""
    base = settings.base
    groups = {
        "material": base.material, "friction": base.friction, "loading": base.loading,
        "stepping": base.stepping, "extraction": settings.extraction, "curves": settings.curves,
    }  # fmt: skip
    found = []
    for group, values in groups.items():
        for name, entry in declarations(type(values)).items():
            value = getattr(values, name)
            unit = {} if entry.unit in ("", "1") else {"unitText": entry.unit}
            found.append(
                {
                    "@id": f"#{group}.{name}",
                    "@type": "PropertyValue",
                    "name": f"{group}.{name}",
                    "description": entry.description,
                    "value": list(value) if isinstance(value, tuple) else value,
                    **unit,
                }
            )
    return found


def _code(citation: Entity, licence: Entity, authors: list[Entity]) -> list[Entity]:
    """The project's code, with its commit if it has one, and the libraries it ran with."""
    libraries = [
        {"@id": f"#{name}", "@type": "SoftwareApplication", "name": name, "version": version}
        for name, version in versions().items()
        if name != PACKAGE
    ]
    code = {
        "@id": "#code",
        "@type": "SoftwareSourceCode",
        "name": citation["title"],
        "version": str(citation["version"]),
        "programmingLanguage": {"@id": "#python"},
        "license": _reference(licence),
        "author": [_reference(author) for author in authors],
        "softwareRequirements": [_reference(library) for library in libraries],
    }
    if revision := commit(CHECKOUT):
        code["identifier"] = revision
    return [code, *libraries]


def commit(checkout: Path) -> str | None:
    """The commit of a checkout, with a remark if files differ from it; None outside of git."""

    def said(*arguments: str) -> str:
        command = ["git", "-C", str(checkout), *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()

    try:
        if Path(said("rev-parse", "--show-toplevel")) != checkout.resolve():
            return None  # of another project around an unpacked release
        changed = said("status", "--porcelain", "--untracked-files=no")
        return said("rev-parse", "HEAD") + (
            ", with changes that are not committed" if changed else ""
        )
    except (OSError, subprocess.CalledProcessError):
        return None


def _citation() -> Entity:
    try:
        return yaml.safe_load((CHECKOUT / "CITATION.cff").read_text(encoding="utf-8"))
    except OSError as error:
        raise BundleError(
            f"the authors are named in CITATION.cff, which can't be read: {error}"
        ) from error


def _agent(author: Entity, id: str) -> Entity:
    """A person or, named by one name, a group of people."""
    if "name" in author:
        return {"@id": id, "@type": "Organization", "name": author["name"]}
    names = author["given-names"], author["family-names"]
    found = {
        "@type": "Person",
        "name": " ".join(names),
        "givenName": names[0],
        "familyName": names[1],
    }
    return {"@id": author.get("orcid", id), **found}


def _article(entry: Entity) -> list[Entity]:
    """A paper that the code replicates, followed by its authors."""
    address = f"https://doi.org/{entry['doi']}"
    authors = [_agent(author, f"{address}#{n}") for n, author in enumerate(entry["authors"], 1)]
    paper = {
        "@id": address,
        "@type": "ScholarlyArticle",
        "name": entry["title"],
        "identifier": address,
        "datePublished": str(entry["year"]),
        "author": [_reference(author) for author in authors],
    }
    return [paper, *authors]
