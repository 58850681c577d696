"""The command line. Commands are imported when they are called: `tumble --help` must not wait for numpy."""

import io
import os
import sys
from importlib import import_module

import click

from tumble import plugins
from tumble.app.signals import interrupting
from tumble.app.terminal import LONGEST_COMPLAINT, flush, lead_nowhere, prepare_streams, say, shown, speak
from tumble.drivers.errors import Interrupted
from tumble.messages import Language, Message

_COMMANDS = {
    "calibrate": "Run a programme, fit, close the loop, store and report: the whole job.",
    "gui": "Open the operator's window.",
    "run": "Run a programme and leave a recording.",
    "resume": "Go on with a run that was cut off, and with what was to follow it.",
    "control": "Have a run under way pause, continue, take its last point again, or stop.",
    "emulate": "Serve a simulated stand through the protocols of real instruments.",
    "plan": "Print what a programme measures and how long it takes; nothing moves.",
    "fit": "Fit a recording or an observation table.",
    "close-loop": "Trace what the declared model leaves of a recording or a table to its causes.",
    "reduce": "Reduce the samples of dwells at rest and under vibration to a table of dwells.",
    "predict": "Predict what a unit rectifies of random vibration with a given spectrum.",
    "allan": "Allan deviation of a long still recording: its kinds of noise, and how long to average.",
    "report": "Write the report of a recording, a table or a stored record.",
    "records": "List, show, compare, export and verify stored calibrations.",
    "stand": "List, show, learn and verify what is known of stands.",
    "effects": "Adopt, list, show and retire effects of the laboratory's own.",
    "export": "Write the observation table of a recording.",
}
"""Name of every command with the sentence that `--help` says of it.

Each is `tumble.app.commands.NAME:command`, with `_` for `-`.
"""
_ABOVE = {"gui": "tumble.window.command"}
"""A command that lives above the application: it is known by name only."""
_OF_METHODS = "tumble.commands"
"""Entry points of further commands, which methods bring along."""

_BROUGHT = "Of a method; its own --help says what it does."


class _Commands(click.Group):
    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        return [*_COMMANDS, *_of_methods()]

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        if cmd_name in _of_methods():
            brought: click.Command = plugins.load(_OF_METHODS, cmd_name, click.Command)
            return brought
        if cmd_name not in _COMMANDS:
            return None
        place = _ABOVE.get(cmd_name, f"tumble.app.commands.{cmd_name.replace('-', '_')}")
        command: click.Command = import_module(place).command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        with formatter.section("Commands"):
            formatter.write_dl([*_COMMANDS.items(), *((name, _BROUGHT) for name in _of_methods())])


def _of_methods() -> list[str]:
    """Commands that methods bring along; those of the program itself go first."""
    return [name for name in plugins.names(_OF_METHODS) if name not in _COMMANDS]


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="tumble")
@click.option(
    "--language",
    type=click.Choice([language.value for language in Language]),
    default=Language.ENGLISH.value,
    show_default=True,
    envvar="TUMBLE_LANGUAGE",
    show_envvar=True,
    help="What is said on the terminal is said in this language; help and JSON are in English.",
)
def cli(language: str) -> None:
    """Calibrate accelerometers on a dividing head.

    Exit status: 0 good; 1 a limit of the programme is not met, or not decided; 2 bad input, wrong usage, an unanswered
    prompt or a record that does not verify; 3 device fault; 4 stopped by the operator; 5 storage; 70 a fault of the
    program.
    """
    speak(Language(language))


def main() -> None:
    """Entry point of `tumble`: one sentence for every error that a user can act on."""
    prepare_streams()
    speak(Language.ENGLISH)
    limit_blas_threads()
    try:
        with interrupting():
            status = _carry_out(sys.argv[1:])
    except (click.Abort, KeyboardInterrupt) as stopped:
        by_signal = Message("interrupted by {signal}; a recording keeps its complete points", signal=stopped)
        by_key = Message("interrupted; a recording keeps its complete points")
        _complain(by_signal if isinstance(stopped, Interrupted) else by_key)
        status = 4
    except click.ClickException as error:
        status = _wrong_usage(error)
    except Exception as error:
        status = _failed(error)
    if status:
        sys.exit(status)


def limit_blas_threads() -> None:
    """Have this process and its workers run their BLAS in one thread, unless the user says otherwise.

    Called before numpy is imported; why: `tumble.calibrations.core.blas_threads`.
    """
    for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
        os.environ.setdefault(name, "1")


def _carry_out(arguments: list[str]) -> int:
    """Call the command that the arguments name; return its exit status."""
    check_text(arguments)
    try:
        with cli.make_context("tumble", arguments) as context:
            cli.invoke(context)
    except click.exceptions.Exit as leaving:
        status = leaving.exit_code
    except SystemExit as leaving:
        status = leaving.code if isinstance(leaving.code, int) else 0
    else:
        status = 0
    flush(sys.stdout)
    return status


def check_text(arguments: list[str]) -> None:
    """Make sure that arguments are text: what is none can be neither recorded nor shown. Raises `UsageError`."""
    for argument in arguments:
        if any("\ud800" <= character <= "\udfff" for character in argument):
            raise click.UsageError(
                Message(
                    "{argument} is no text in the encoding of this system; rename it or write it anew",
                    argument=argument,
                )
            )


def _wrong_usage(error: click.ClickException) -> int:
    """Say what click says."""
    told = io.StringIO()
    error.show(told)
    say(*told.getvalue().replace(error.message, shown(error.message)).splitlines(), err=True, most=LONGEST_COMPLAINT)
    return error.exit_code


def _failed(error: Exception) -> int:
    """Say what happened; return the exit status."""
    import traceback  # only when something went wrong

    from tumble.app.exits import Exit, sentence_of, status_of

    if isinstance(error, OSError) and error.filename is None:  # of a stream, which would fail again at the end
        lead_nowhere(sys.stdout)
    status = status_of(error)
    if status is not None:
        _complain(sentence_of(error))
        return int(status)
    say(*traceback.format_exc().splitlines(), err=True, most=LONGEST_COMPLAINT)
    _complain(Message("a fault of the program; report it with the lines above"))
    return int(Exit.INTERNAL)


def _complain(sentence: str) -> None:
    say(Message("tumble: {sentence}", sentence=sentence), err=True, most=LONGEST_COMPLAINT)
