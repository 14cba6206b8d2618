"""The command line: `main(argv) -> int`, one module per command, each imported only when it is called.

A command module has two functions: ``configure(parser)`` adds its arguments, ``run(arguments) -> int`` does the work
and returns the exit code (0: success, 1: success, with findings to report, 2: failure). An `UrdfkitError` is
printed in one line.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Sequence
from importlib import import_module
from io import TextIOWrapper
from keyword import iskeyword

from urdfkit.errors import UrdfkitError, one_line

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import ModuleType

    from urdfkit.cli.parser import Parser

COMMANDS = {
    "new": "create a robot, world or package; add a sensor, an arm or controllers",
    "import": "turn a single URDF file, such as a CAD export, into ROS packages",
    "lint": "find and fix defects in URDF and xacro files",
    "format": "format URDF and xacro files: indentation, white space, line breaks",
    "rule": "print the page of a lint rule, or list all rules",
    "lsp": "run the language server: diagnostics, hover, definitions, completion, fixes",
    "mcp": "run a server for the Model Context Protocol (MCP): lint, fix, ik, sim run, pictures",
    "expand": "expand xacro to URDF; needs no ROS",
    "info": "print links, joints, mass, sensors and drives",
    "inertia": "compute masses and inertias from shapes and compare them with the file",
    "view": "show a robot in the browser",
    "tf": "compute a transform, or draw the frame tree",
    "ik": "compute joint positions that place a link at a pose: inverse kinematics",
    "jacobian": "compute the Jacobian of a link, its singular values and lost directions of motion",
    "reach": "compute a map of the positions and orientations that a link reaches",
    "retime": "compute the fastest motion through waypoints within the limits of the joints",
    "srdf": "write the SRDF for MoveIt: groups and disabled collisions",
    "sim": "simulate a robot: teleop, run, sweep, warmup",
    "topic": "inspect and publish topics of a simulation or live robot: list, info, type, find, echo, hz, bw, pub",
    "service": "list and call services of a simulation or live robot: list, type, call",
    "action": "send goals to actions of a simulation or live robot: list, send",
    "replay": "show a ROS 1, ROS 2 or urdfkit recording in the browser",
    "bag": "print the duration, topics and types of a recording: info",
    "licenses": "print versions and licences of the dependencies, or a software bill of materials",
    "completion": "print the completion script of bash, zsh or fish",
}
"""Command → its description. The module ``urdfkit.cli.<command>`` implements it; ``import_`` is ``import``."""

_FOLDERS = {
    **dict.fromkeys(("tf", "ik", "jacobian", "reach", "retime", "srdf"), "kinematics"),
    **dict.fromkeys(("replay", "bag"), "recordings"),
    **dict.fromkeys(("service", "action"), "topic"),
    "licenses": "installation",
}
"""Command → the package in ``urdfkit.cli`` that its module is in."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command.

    Args:
        argv: the arguments after the program name; those of the process when None.

    Returns:
        The exit code.
    """
    arguments = list(sys.argv[1:] if argv is None else argv)
    for stream in (sys.stdout, sys.stderr):
        # Units and arrows are missing in some terminals' character sets: `?` is better than an error.
        if isinstance(stream, TextIOWrapper) and (stream.encoding or "").lower().replace("-", "") != "utf8":
            stream.reconfigure(errors="replace")
    try:
        if "_ARGCOMPLETE" in os.environ:  # a shell requests completions
            from urdfkit.cli.completion import complete

            complete(parser_of)
        try:
            return _run(arguments)
        finally:
            if not sys.stdout.closed:  # the language server closes it
                sys.stdout.flush()  # output that cannot be written is an error of the command, not of the interpreter
    except UrdfkitError as error:
        print(f"urdfkit: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        # The reader of the output closed the pipe (`| head`).
        _discard_output()
        return 141
    except OSError as error:
        _discard_output()
        place = f" {error.filename}:" if error.filename else ""
        print(f"urdfkit:{one_line(place)} {error.strerror or error}", file=sys.stderr)
        return 2
    except Exception as error:
        if {"-v", "--verbose"} & set(arguments):
            raise
        from urdfkit.errors import bug

        print(f"urdfkit: {bug(error)}; -v shows the traceback", file=sys.stderr)
        return 2


def program() -> None:
    """Run the program ``urdfkit``: execute one command and exit with its exit code.

    The light commands exit without finalizing the interpreter: deallocating every object takes a fifth of the time of a
    lint. Commands with threads or compiled libraries exit as usual, so that their exit handlers run.

    SIGINT interrupts also where the program was started with SIGINT ignored, as shells start the background jobs
    (``&``) of a script: otherwise ``kill -INT`` could not end a server or a simulation. SIGHUP stays ignored (nohup).
    """
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by the parent process (`2>&-`): output is discarded
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_WRONLY), "w"))
    # A lint creates no cyclic garbage while it loads modules and builds trees; searching takes a fifth of the lint of
    # a robot with 1,200 links.
    gc.set_threshold(500_000)
    code = main()
    if not {"numpy", "threading", "atexit"}.isdisjoint(sys.modules):
        sys.exit(code)
    for stream in (sys.stdout, sys.stderr):
        if not stream.closed:
            stream.flush()
    os._exit(code)


def _discard_output() -> None:
    """Discard what standard output still holds if it cannot be written, which the interpreter would report at exit."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _run(arguments: list[str]) -> int:
    if "--" in arguments:  # argparse passes the words after it to the parser of the command, without it
        start = arguments.index("--")
        files = [f"./{word}" if word.startswith("-") and os.path.lexists(word) else word for word in arguments[start:]]
        arguments = [*arguments[:start], *files]
    if arguments[:1] == ["lint"]:
        from urdfkit.cli.lint.fast_arguments import parse_simple

        if (parsed := parse_simple(arguments[1:])) is not None:
            return int(_module("lint").run(parsed))
    if "--version" in arguments and set(arguments) <= {"--version", "-v", "--verbose"} and len(arguments) > 1:
        from urdfkit.cli.installation.version_report import report

        print(report())
        return 0
    command = next((a for a in arguments if not a.startswith("-")), None)
    if command is not None and command not in COMMANDS and command == arguments[0]:
        from urdfkit.cli.unknown_command import refuse

        refuse(command, list(COMMANDS), arguments[1:])
    parsed = parser_of(command, complete=arguments[:1] != [command]).parse_args(arguments)
    return int(_module(parsed.command).run(parsed))


def parser_of(command: str | None, *, complete: bool = True) -> Parser:
    """Return the parser of the command line; only `command` gets its arguments, because configuring all takes time.

    Args:
        command: the command to configure; None for none.
        complete: whether the other commands are listed too.
    """
    from urdfkit.cli.parser import Parser, add_common

    parser = Parser(
        prog="urdfkit",
        description="Check, view, simulate and create URDF and xacro robots.",
        epilog="examples:\n  urdfkit new robot scout\n  urdfkit sim teleop simpleton",
    )
    parser.add_argument(
        "--version",
        action="version",
        version=f"urdfkit {_version()}",
        help="print the version and exit; with --verbose also versions of the platform and the dependencies",
    )
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True, prog="urdfkit")
    for name in COMMANDS if complete or command is None else (command,):
        sub = commands.add_parser(name, help=COMMANDS[name], description=COMMANDS[name])
        if name == command:
            _module(name).configure(sub)
            add_common(sub)
    return parser


def _module(command: str) -> ModuleType:
    folder = f"{_FOLDERS[command]}." if command in _FOLDERS else ""
    return import_module(f"urdfkit.cli.{folder}{command}{'_' if iskeyword(command) else ''}")


def _version() -> str:
    from urdfkit import __version__

    return __version__
