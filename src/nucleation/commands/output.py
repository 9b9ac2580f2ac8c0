"""Where commands may write: in directories that exist, over nothing that does."""

import os
import shlex
from pathlib import Path

from ..model.quantities import ParameterError


def require_writable(path: Path, force: bool) -> None:
    """Refuse a file that can't be written, or exists and may not be replaced by `force`."""
    if path.exists() and not force:
        raise ParameterError(f"{path} exists already; --force replaces it")
    require_directory(path, path.absolute().parent)


def require_directory(path: Path, folder: Path) -> None:
    """Refuse a path whose directory isn't there, or can't be written to."""
    if not folder.exists():
        make = shlex.join(["mkdir", "-p", str(folder)])
        raise ParameterError(f"{path} can't be written: there is no directory {folder}; {make}")
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        raise ParameterError(f"{path} can't be written: {folder} is no writable directory")
