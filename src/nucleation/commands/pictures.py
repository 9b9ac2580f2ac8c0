"""Pictures that commands write."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ..model.quantities import ParameterError
from .text import require_writable

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def require_picture(
    option: str,
    path: Path,
    force: bool,
    ends: tuple[str, ...] = (".png", ".pdf"),
) -> None:
    """Refuse a picture of another format, and one that can't be written.

    Parameters
    ----------
    option : str
        Name of the option or argument with the path.
    path : Path
        The file.
    force : bool
        Whether an existing file may be replaced.
    ends : tuple of str
        The allowed ends of the name.

    Raises
    ------
    ParameterError
        If the file is refused.
    """
    if path.suffix not in ends:
        listed = f"{', '.join(ends[:-1])} or {ends[-1]}"
        raise ParameterError(f"{option} = '{path}' is not allowed: it must end in {listed}")
    require_writable(path, force)


def save(figure: Figure, path: Path) -> None:
    """Write a figure in the style of the project, in the format of the name."""
    import matplotlib as mpl

    from ..datasets.files import replacing
    from ..pictures import style

    with mpl.rc_context(style.STYLE), replacing(path) as temporary:
        figure.savefig(temporary, format=path.suffix[1:])
