"""``nucleation export``: fields of a simulation as text."""

from pathlib import Path

import click
import xarray as xr

from . import DONE, EXIT_CODES
from .text import require_directory, require_writable


@click.command("export", epilog=EXIT_CODES)
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path))
@click.option("--force", is_flag=True, help="replace files that exist")
def command(file: Path, folder: Path, force: bool) -> int:
    """Write the fields of a simulation's fault as CSV.

    A file for each field, in SI units; the first column is the time, the first row x.

    \b
    Example:
      nucleation export run.nc fields
    """
    from ..datasets import netcdf

    dataset = netcdf.read(file, requires=["slip_rate", "driving_force"])
    texts = {
        folder / f"{file.stem}_{name}.csv": _csv(field)
        for name, field in dataset.data_vars.items()
        if set(field.dims) == {"time", "x"}
    }
    if not folder.exists():  # it alone is made
        require_directory(folder, folder.absolute().parent)
        folder.mkdir()
    for path in texts:
        require_writable(path, force)
    for path, text in texts.items():
        netcdf.write_text(text, path)
        click.echo(f"written to {path}")
    return DONE


def _csv(field: xr.DataArray) -> str:
    """A field on (time, x), times (s) down and x (m) across."""
    head = f"{field.name} ({field.attrs['units']}): time (s) down / x (m) across"
    table = field.transpose("time", "x").to_pandas()
    return str(table.to_csv(index_label=head, float_format="%.9g"))
