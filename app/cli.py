"""The command line. Commands are imported when they are called: `tumble --help` must not wait for numpy."""

import io
import os
import sys
import traceback
from importlib import import_module

import click

_COMMANDS = {
    "calibrate": "Run a programme, fit, close the loop, store and report: the whole job.",
    "gui": "Open the operator's window.",
    "run": "Run a programme and leave a recording.",
    "resume": "Go on with a run that was cut off, and with what was to follow it.",
    "emulate": "Serve a simulated stand through the protocols of real instruments.",
    "plan": "Print the steps of a programme and how long they take; nothing moves.",
    "fit": "Fit a recording or an observation table.",
    "close-loop": "Trace what the declared model leaves of a recording or a table to its causes.",
    "report": "Write the report of a recording, a table or a stored record.",
    "records": "List, show, compare, export and verify stored calibrations.",
    "stand": "List, show, learn and verify what is known of stands.",
    "export": "Write the observation table of a recording.",
}
"""Name of every command with the sentence that `--help` says of it; each is `app.commands.NAME:command` (_ for -)."""
_ABOVE = {"gui": "window.command"}
"""A command that lives above the application: it is known by name only."""


class _Commands(click.Group):
    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        return list(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        if cmd_name not in _COMMANDS:
            return None
        place = _ABOVE.get(cmd_name, f"app.commands.{cmd_name.replace('-', '_')}")
        command: click.Command = import_module(place).command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        with formatter.section("Commands"):
            formatter.write_dl(list(_COMMANDS.items()))


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="tumble")
def cli() -> None:
    """Calibrate accelerometers on a dividing head.

    Exit status: 0 good; 1 outside the programme's limits; 2 bad input, wrong usage, an unanswered prompt or a
    record that does not verify; 3 device fault; 4 stopped by the operator; 5 storage; 70 a fault of the program.
    """


def main() -> None:
    """Entry point of `tumble`: one sentence for every error that a user can act on."""
    _redirect_as_utf_8()
    limit_blas_threads()
    try:
        with cli.make_context("tumble", sys.argv[1:]) as context:
            cli.invoke(context)
        sys.stdout.flush()
    except click.exceptions.Exit as leaving:
        if leaving.exit_code:
            sys.exit(leaving.exit_code)
    except (click.Abort, KeyboardInterrupt):
        click.echo("tumble: interrupted; a recording keeps its complete points", err=True)
        sys.exit(4)
    except BrokenPipeError:  # whoever read the output has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except click.ClickException as error:
        error.show()
        sys.exit(error.exit_code)
    except Exception as error:
        from app.exits import Exit, status_of  # only when something went wrong

        status = status_of(error)
        if status is None:
            traceback.print_exc()
            click.echo("tumble: a fault of the program; report it with the lines above", err=True)
            sys.exit(int(Exit.INTERNAL))
        click.echo(f"tumble: {error}", err=True)
        sys.exit(int(status))


def limit_blas_threads() -> None:
    """Have this process and its workers run their BLAS in one thread, unless the user says otherwise.

    Called before numpy is imported; why: `calibrations.blas_threads`.
    """
    for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
        os.environ.setdefault(name, "1")


def _redirect_as_utf_8() -> None:
    """Write UTF-8 into files and pipes: not every system has a sign for arc seconds, and JSON is nothing else."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper) and not stream.isatty():
            stream.reconfigure(encoding="utf-8")
