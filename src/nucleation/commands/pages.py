"""The pages of the documentation: where a message finds them in this installation.

Messages name a page by its place in a checkout, ``docs/drop.md``. An installation has the pages
too, in the directory ``share/doc/nucleation-length`` of its environment.
"""

import importlib.metadata
import re
from functools import cache
from pathlib import Path

from ..installed import DISTRIBUTION

_CITED = re.compile(r"\bdocs/(\w+\.md)\b")
_CHECKOUT = Path(__file__).parents[3] / "docs"


def with_addresses(text: str) -> str:
    """The text, each page that it cites by an address at which the user finds it.

    Parameters
    ----------
    text : str
        A message that may name pages as ``docs/drop.md``.
    """
    return _CITED.sub(lambda cited: address(cited[1]), text)


@cache
def address(page: str) -> str:
    """The address of a page, ``drop.md``: its path if it is installed, else that in a checkout."""
    in_checkout = f"docs/{page}"
    if (_CHECKOUT / page).exists():
        return in_checkout
    try:
        files = importlib.metadata.files(DISTRIBUTION) or []
    except importlib.metadata.PackageNotFoundError:
        return in_checkout
    for file in files:
        if file.name == page and "doc" in file.parts:
            return str(Path(str(file.locate())).resolve())
    return in_checkout
