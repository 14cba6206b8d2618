"""The command line: `main(argv) -> int`, one module per command, each imported only when it is called.

A command module has two functions: ``configure(parser)`` adds its arguments, ``run(arguments) -> int`` does the work
and returns the exit code (0 done, 1 done and something to report, 2 could not do it). Whatever it raises as an
`UrdfkitError` is printed in one line.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence
from importlib import import_module
from io import TextIOWrapper
from keyword import iskeyword

from urdfkit.errors import UrdfkitError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import ModuleType

COMMANDS = {
    "new": "write robots, worlds and packages; add sensors, arms and controllers",
    "import": "wrap a bare URDF, as of a CAD program, into packages",
    "lint": "find and mend the defects of a URDF or xacro",
    "rule": "print the page of a lint rule, or the catalogue",
    "lsp": "serve an editor: diagnostics, hover, definitions, completion, fixes",
    "expand": "xacro to URDF, without ROS installed",
    "info": "links, joints, mass, sensors, drives",
    "inertia": "compute masses and inertia from shapes, beside what is written",
    "view": "look at a robot in the browser",
    "tf": "compute a transform, or draw the frame tree",
    "sim": "simulate a robot: teleop, run, bench, warmup",
    "topic": "talk to a running simulation: list, info, echo, hz, bw, pub",
}
"""Command → what it does. The module ``urdfkit.cli.<command>`` implements it; ``import_`` is ``import``."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command.

    Args:
        argv: the arguments after the program name; those of the process when None.

    Returns:
        The exit code.
    """
    arguments = list(sys.argv[1:] if argv is None else argv)
    for stream in (sys.stdout, sys.stderr):
        # Units and arrows are not in every terminal's character set: `?` is better than an error.
        if isinstance(stream, TextIOWrapper) and (stream.encoding or "").lower().replace("-", "") != "utf8":
            stream.reconfigure(errors="replace")
    try:
        return _run(arguments)
    except UrdfkitError as error:
        print(f"urdfkit: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        # The reader of our output went away (`| head`); keep the interpreter from complaining at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    except OSError as error:
        place = f" {error.filename}:" if error.filename else ""
        print(f"urdfkit:{place} {error.strerror or error}", file=sys.stderr)
        return 2
    except Exception as error:
        if {"-v", "--verbose"} & set(arguments):
            raise
        from urdfkit.errors import bug

        print(f"urdfkit: {bug(error)}; -v shows the traceback", file=sys.stderr)
        return 2


def program() -> None:
    """Be the program ``urdfkit``: run one command and leave with its exit code.

    The light commands leave without taking the interpreter apart: freeing, object by object, what is about to vanish
    takes a fifth of the time of a lint. What has threads or compiled libraries to wind down leaves as usual.
    """
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by who started us (`2>&-`): notes go nowhere then
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_WRONLY), "w"))
    # Looking for cyclic garbage while modules load and trees are built finds none, and takes a fifteenth of a lint.
    gc.set_threshold(100_000)
    code = main()
    if not {"numpy", "threading", "atexit"}.isdisjoint(sys.modules):
        sys.exit(code)
    try:
        sys.stdout.flush()
        sys.stderr.flush()
    except OSError:
        os._exit(code or 141)
    os._exit(code)


def _run(arguments: list[str]) -> int:
    if arguments[:1] == ["lint"]:
        from urdfkit.cli.plain import plain

        if (parsed := plain(arguments[1:])) is not None:
            return int(_module("lint").run(parsed))
    from urdfkit.cli.parser import Parser, add_common

    command = next((a for a in arguments if not a.startswith("-")), None)
    parser = Parser(
        prog="urdfkit",
        description="From a URDF or xacro to a robot you drive in the browser.",
        epilog="examples:\n  urdfkit new robot scout\n  urdfkit sim teleop simpleton",
    )
    parser.add_argument("--version", action="version", version=f"urdfkit {_version()}")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True, prog="urdfkit")
    names = (command,) if command in COMMANDS and arguments[0] == command else tuple(COMMANDS)
    for name in names:
        sub = commands.add_parser(name, help=COMMANDS[name], description=COMMANDS[name])
        if name == command:
            _module(name).configure(sub)
            add_common(sub)
    parsed = parser.parse_args(arguments)
    return int(_module(parsed.command).run(parsed))


def _module(command: str) -> ModuleType:
    return import_module(f"urdfkit.cli.{command}{'_' if iskeyword(command) else ''}")


def _version() -> str:
    from urdfkit import __version__

    return __version__
