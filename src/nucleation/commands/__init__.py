"""The command ``nucleation``: lengths of a fault, simulations, and summaries of datasets.

:func:`run` turns every failure into one message on the standard error and an exit code.
"""

import difflib
import importlib
import io
import os
import signal
import sys
from collections.abc import Sequence

import click

from .. import __version__
from ..installed import MissingExtra

DONE = 0
FAILED = 1
REFUSED = 2
STABLE = 3
INTERRUPTED = 128 + signal.SIGINT

EXIT_CODES = f"""\b
Exit codes:
  {DONE}    done
  {FAILED}    the simulation failed numerically; its record is kept beside
  {REFUSED}    a value, an option or a file is wrong, or can't be written
  {STABLE}    homogeneous sliding is stable: there is no critical length
  {INTERRUPTED}  interrupted
"""

COMPLETION = """\b
Completion of commands and options in bash (zsh and fish in the same way):
  eval "$(_NUCLEATION_COMPLETE=bash_source nucleation)"
"""

COMMANDS = {
    "length": "Nucleation lengths of a fault: the theory's, the one at the drop, others in use.",
    "specimen": "Normal stress, slip distance or modulus at which a nucleation length fits into a "
    "specimen.",
    "simulate": "Simulate a block pushed from its side and write the record to OUTPUT (netCDF).",
    "show": "Summarise a dataset of the project: its kind, origin and variables.",
}
"""The first sentence of the help of each command, so that listing them imports none of them."""


class _LazyGroup(click.Group):
    """Commands of this package, each imported on use, so that help and completion are quick."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        if name not in COMMANDS:
            close = difflib.get_close_matches(name, COMMANDS, n=1)
            hint = f"; did you mean {close[0]}?" if close else ""
            ctx.fail(f"there is no command {name!r}{hint}")
        return importlib.import_module(f".{name}", __package__).command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.command(
    cls=_LazyGroup,
    epilog=f"{EXIT_CODES}\n{COMPLETION}",
    context_settings={"max_content_width": 100},
)
@click.version_option(__version__, prog_name="nucleation")
def main() -> None:
    """How long must a slipping patch of a frictional fault grow before it runs away?

    Values are written with their unit, "30 GPa", 5um, 1mm/yr, or as a bare number in SI units.
    """


def run(arguments: Sequence[str] | None = None) -> int:
    """Run a command line, without its name, and return the exit code."""
    from ..datasets import DatasetError
    from ..model.quantities import ParameterError

    code = REFUSED
    try:
        if os.environ.get("SOURCE_DATE_EPOCH"):  # a wrong one would stop the import of NumPy
            from ..datasets.provenance import moment

            moment()
        return main.main(arguments, prog_name="nucleation", standalone_mode=False) or DONE
    except click.ClickException as error:
        if isinstance(error, click.NoSuchOption) and error.ctx:
            from ..model.hints import hint

            parameters = error.ctx.command.get_params(error.ctx)
            known = [word for parameter in parameters for word in parameter.opts]
            suggestion = hint(error.option_name, [word for word in known if word[:2] == "--"])
            if suggestion:
                message = f"No such option {error.option_name!r}; {suggestion}"
                error = click.NoSuchOption(error.option_name, message, ctx=error.ctx)
        elif "unexpected extra argument" in error.message:
            text = f"{error.message}; write a value and its unit as one word, 10cm, or in quotes"
            error = click.UsageError(text, getattr(error, "ctx", None))
        shown = io.StringIO()
        error.show(shown)
        lines, code = shown.getvalue().splitlines(), error.exit_code
    except click.Abort:
        click.echo("Interrupted", err=True)
        return INTERRUPTED
    except BrokenPipeError:  # such as `| head`: nobody reads the rest
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return REFUSED
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        lines = [f"Error: {place}{error.strerror or error}"]
    except (ParameterError, DatasetError, MissingExtra, MemoryError) as error:
        lines = [f"Error: {str(error) or 'not enough memory'}"]
    from .text import wrapped

    click.echo("\n".join(wrapped(*lines, err=True)), err=True)
    return code
