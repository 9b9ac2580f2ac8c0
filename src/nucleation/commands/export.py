"""``nucleation export``: fields of a simulation, or time series at points of its fault, as text."""

from pathlib import Path

import click

from ..model.parameters import Geometry
from ..model.quantities import declarations
from ..model.units import parse
from . import DONE, EXIT_CODES
from .output import require_directory, require_writable

LENGTH = declarations(Geometry)["length"]


@click.command("export", epilog=EXIT_CODES)
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path))
@click.option(
    "--at", "places", multiple=True, metavar="VALUE[m]",
    help="distance from the loaded edge; may be given several times. Without: all fields as CSV",
)  # fmt: skip
@click.option("--force", is_flag=True, help="replace files that exist")
def command(file: Path, folder: Path, places: tuple[str, ...], force: bool) -> int:
    """Write the fields of a simulation's fault as CSV, or with --at their time series at points.

    CSV: a file for each field, in SI units; the first column is the time, the first row x. Time
    series: a file for each point, in the format of the SEAS community's benchmark BP3 (fields t
    slip slip_rate shear_stress normal_stress state), which its tools for comparison read.

    \b
    Example:
      nucleation export run.nc fields
      nucleation export run.nc series --at 5cm --at 10cm
    """
    from ..analysis.seas import field_tables, time_series
    from ..datasets import netcdf

    dataset = netcdf.read(file, requires=["slip_rate", "driving_force"])
    texts = {}
    if not places:
        tables = field_tables(dataset).items()
        texts = {folder / f"{file.stem}_{name}.csv": text for name, text in tables}
    for place in places:
        position = parse("at", place, LENGTH)
        texts[folder / f"{file.stem}_x{position:g}m.dat"] = time_series(dataset, position)
    if not folder.exists():  # it alone is made
        require_directory(folder, folder.absolute().parent)
        folder.mkdir()
    for path in texts:
        require_writable(path, force)
    for path, text in texts.items():
        netcdf.write_text(text, path)
        click.echo(f"written to {path}")
    return DONE
