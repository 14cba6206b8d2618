"""Argument parser whose errors are one line with the nearest valid name."""

from __future__ import annotations

import argparse
import os
import re
import sys
from itertools import takewhile

from urdfkit.defect_message import Suggestion
from urdfkit.errors import UsageError, nearest, similar

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, NoReturn


OTHER_OPTIONS = {
    **dict.fromkeys(("--duration", "--time", "--seconds", "--sec", "-t"), "--for"),
    **dict.fromkeys(("--timestep", "--time-step", "--step-size"), "--dt"),
    **dict.fromkeys(("--headless", "--no-gui", "--no-window"), "--no-browser"),
    **dict.fromkeys(("--velocity", "--twist"), "--cmd-vel"),
    **dict.fromkeys(("--output-format", "--format"), "--json"),
}
"""Option of another tool → option of urdfkit, where the command has it."""

_NO_BREAK = "\N{NO-BREAK SPACE}"

ROBOT_OPTIONS = ("--robot", "--model", "--urdf", "--xacro", "--file")


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """Formatter of argparse that finds the width without shutil, whose import takes longer than parsing."""

    def __init__(
        self, prog: str, indent_increment: int = 2, max_help_position: int = 24, width: int | None = None
    ) -> None:
        super().__init__(prog, indent_increment, max_help_position, width or (columns() or 80) - 2)

    def add_usage(self, usage: str | None, actions: Any, groups: Any, prefix: str | None = None) -> None:
        """Wrap a usage that a command gives itself; bracketed arguments stay on one line."""
        if usage is not None and usage is not argparse.SUPPRESS:
            kept = re.sub(r"\[[^\[\]]*\]", lambda group: group[0].replace(" ", _NO_BREAK), f"usage: {usage}")
            parts = [re.sub(r"\n +", " ", part) for part in re.split(r"\n(?= +urdfkit)", kept)]
            usage = "\n".join(self._wrapped(part, " " * 11).replace(_NO_BREAK, " ") for part in parts)[len("usage: ") :]
        super().add_usage(usage, actions, groups, prefix)

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        """Wrap the long lines of a description or an epilog, but no commands and no XML, which are copied."""
        lines = super()._fill_text(text, width, indent).splitlines()
        return "\n".join(
            line if line.startswith(("  urdfkit ", "  <")) else self._wrapped(line, "  ") for line in lines
        )

    def _wrapped(self, line: str, indent: str) -> str:
        import textwrap

        return textwrap.fill(
            line, self._width, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
        )


def columns() -> int | None:
    """Return the width of the terminal in columns (``COLUMNS`` takes precedence); None without a terminal."""
    try:
        width = int(os.environ.get("COLUMNS") or 0)
        return width or os.get_terminal_size(sys.__stdout__.fileno() if sys.__stdout__ else 1).columns or None
    except (ValueError, OSError):
        return None


class Parser(argparse.ArgumentParser):
    """Parser of argparse that raises `UsageError` for a wrong argument instead of printing the usage."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        kwargs.setdefault("allow_abbrev", False)
        kwargs.setdefault("formatter_class", HelpFormatter)
        super().__init__(*args, **kwargs)
        self.intermixed = True
        """Whether options may stand between positional arguments."""
        self._words: list[str] = []
        self._commands: argparse.Action | None = None
        self._must_have_subcommand = False
        self.elsewhere: Callable[[str], str] = lambda _: ""
        """Return the suggestion for an option that this command does not have, e.g. the subcommand that has it."""
        self.default_subcommand = ""
        """Subcommand to suggest where a word that is no subcommand is given, e.g. a robot."""

    def add_subparsers(self, **options: Any) -> Any:
        """Add subcommands; a missing required one is reported with the list of all."""
        self._must_have_subcommand = options.pop("required", False)
        self._commands = super().add_subparsers(**options)
        return self._commands

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Accept options between positional arguments too: ``urdfkit tf simpleton --json base camera``.

        Raises:
            UsageError: an argument that this command does not have.
        """
        words = list(sys.argv[1:] if args is None else args)
        if not self.intermixed or {"-h", "--help"} & set(words):
            return super().parse_known_args(words, namespace)
        self._words = words
        self._check_flags()
        if self._commands is not None:
            parsed, unknown = super().parse_known_args(words, namespace)
            if unknown:
                self._refuse_unknown(unknown)
            if self._must_have_subcommand and getattr(parsed, self._commands.dest) is None:
                self._refuse_missing_subcommand(self._commands)
            return parsed, unknown
        self.intermixed = False  # argparse's own method for it calls this method again
        usage, self.usage = self.usage, self.usage or ""  # argparse would format it for its own error messages
        try:
            parsed, unknown = self.parse_known_intermixed_args(words, namespace)
        finally:
            self.intermixed, self.usage = True, usage
        if unknown:  # reported here, where the options of the subcommand are defined
            self._refuse_unknown(unknown)
        return parsed, unknown

    def prepare(self, words: list[str]) -> None:
        """Add the options that depend on the words of the command line; none by default."""

    def error(self, message: str) -> NoReturn:
        """Raise instead of exiting.

        Raises:
            UsageError: always.
        """
        self._refuse_misspelt_option()
        self._refuse(message)

    def _refuse_misspelt_option(self) -> None:
        """Refuse an unknown option, which often is the cause of a missing or wrong argument."""
        if (misspelt := self._unknown_option()) is not None:
            self._refuse_unknown([misspelt])

    def _refuse_unknown(self, words: list[str]) -> NoReturn:
        options, word = self._option_string_actions, words[0]
        subcommands = self._commands.choices or () if self._commands is not None else ()
        if (meant := OTHER_OPTIONS.get(word)) in options or (meant := word.lstrip("-")) in subcommands:
            hint: str = Suggestion(meant)
        elif word == "--json" and "--format" in options:
            hint = Suggestion("--format json")
        elif word in ROBOT_OPTIONS and any(action.dest == "model" for action in self._actions):
            hint = f"; it is a positional argument: {self.prog} ROBOT"
        else:
            names = {option.lstrip("-"): option for option in options if option.startswith("--")}
            hint = self.elsewhere(word) or Suggestion(names.get(nearest(word.lstrip("-"), names) or ""))
        self._refuse(f"unrecognized arguments: {' '.join(words)}{hint}")

    def _refuse(self, message: str) -> NoReturn:
        raise UsageError(f"{self.prog.removeprefix('urdfkit').strip()}: {message}".removeprefix(": "))

    def _refuse_missing_subcommand(self, commands: argparse.Action) -> NoReturn:
        if self.prog == "urdfkit":
            raise UsageError("pass a command: `urdfkit --help` lists all; try `urdfkit view simpleton`")
        self._refuse(f"pass a {str(commands.metavar).lower()}: {', '.join(commands.choices or ())}")

    def _check_flags(self) -> None:
        """Refuse a value of an option that accepts none; argparse reports it as "ignored"."""
        for word in self._own_words():
            name, separator, value = word.partition("=")
            action = self._option_string_actions.get(name if name.startswith("--") else word[:2])
            if action is None or action.nargs != 0:
                continue
            if not name.startswith("--"):  # `-qv` stands for `-q -v`
                value = word[2:]
                separator = "" if f"-{value[:1]}" in self._option_string_actions else value
            if separator:
                self._refuse(f"argument {'/'.join(action.option_strings)}: accepts no value, got `{value}`")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        choices = [str(choice) for choice in action.choices or ()]
        if not choices or str(value) in choices:
            return
        listed = f"{', '.join(choices[:-1])} or {choices[-1]}"
        if action is not self._commands:
            near = next(iter(similar(str(value), choices, cutoff=0.7)), None)  # `tcsh` is no misspelt `zsh`
            hint = Suggestion(near) or f"; use {listed}"
            raise argparse.ArgumentError(action, f"`{value}` is not available{hint}")
        self._refuse_misspelt_option()
        if (option := f"--{value}") in self._option_string_actions:
            self._refuse(f"no {str(action.metavar).lower()} `{value}`; did you mean `{option}`?")
        near = nearest(str(value), choices)
        if near is None and self.default_subcommand:
            hint = f"; did you mean `{self.prog} {self.default_subcommand} {value}`?"
        else:
            hint = Suggestion(near) or f"; use {listed}"
        self._refuse(f"no {str(action.metavar).lower()} `{value}`{hint}")

    def _match_argument(self, action: argparse.Action, arg_strings_pattern: str) -> int:
        try:
            return super()._match_argument(action, arg_strings_pattern)
        except argparse.ArgumentError as error:
            if action.nargs == 3:
                error.message += ": three numbers separated by spaces, such as 0.1 0 0.2"
            raise

    def _unknown_option(self) -> str | None:
        """Return the first long option that this command does not have."""
        named = (word.partition("=")[0] for word in self._own_words() if word.startswith("--"))
        return next((name for name in named if name not in self._option_string_actions), None)

    def _own_words(self) -> list[str]:
        """Return the words before `--`; of a command with subcommands, those before the subcommand."""
        words = self._words[: self._words.index("--")] if "--" in self._words else self._words
        return words if self._commands is None else list(takewhile(lambda word: word.startswith("-"), words))

    def _get_value(self, action: argparse.Action, arg_string: str) -> Any:
        try:
            return super()._get_value(action, arg_string)
        except argparse.ArgumentError as error:
            if (expected := {int: "an integer", float: "a number"}.get(action.type)) is not None:  # type: ignore[call-overload]
                error.message = f"`{arg_string}` is not {expected}"
            raise


def add_model(parser: argparse.ArgumentParser) -> None:
    """Add the ROBOT argument and the ``key:=value`` xacro arguments that may follow it.

    They arrive as ``arguments.model`` (a list: ROBOT, if given, then ``key:=value`` words) and
    ``arguments.package_path``; `urdfkit.resources.find_model` takes both.
    """
    parser.add_argument(
        "model",
        nargs="*",
        metavar="ROBOT",
        help="a .urdf or .xacro file, a package folder or a robot name; then key:=value xacro arguments",
    )
    add_package_path(parser)


def add_package_path(parser: argparse.ArgumentParser) -> None:
    """Add ``--package-path``; its folders arrive as ``arguments.package_path``."""
    parser.add_argument(
        "--package-path",
        action="append",
        default=[],
        metavar="DIR",
        help="search this folder for packages too (repeatable)",
    )


def add_common(parser: argparse.ArgumentParser, *, nested: bool = False) -> None:
    """Add the common options ``-q``, ``-v`` and ``--color``, unless the command defines its own.

    Args:
        parser: parser of the command; its subcommands get the options too.
        nested: whether a parent parser has the options already, with their defaults.
    """
    defined = parser._option_string_actions
    off, auto = (argparse.SUPPRESS, argparse.SUPPRESS) if nested else (False, "auto")
    if "--quiet" not in defined and "-q" not in defined:
        parser.add_argument(
            "-q", "--quiet", action="store_true", default=off, help="print results and warnings only, no notes"
        )
    if "--verbose" not in defined and "-v" not in defined:
        parser.add_argument("-v", "--verbose", action="store_true", default=off, help="print more notes")
    if "--color" not in defined:
        parser.add_argument(
            "--color", choices=("auto", "always", "never"), default=auto, help="colour the output (default: auto)"
        )
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for subcommand in action.choices.values():
                add_common(subcommand, nested=True)


def add_time_limit(parser: argparse.ArgumentParser) -> None:
    """Add --time-limit."""
    from urdfkit.lint.project.options import TIME_LIMIT

    parser.add_argument(
        "--time-limit",
        type=seconds(0.0, 1e9),
        default=TIME_LIMIT,
        metavar="S",
        help=f"stop reading a file after S seconds of CPU (default: {TIME_LIMIT:g}; 0: no limit)",
    )


def seconds(least: float, most: float, kind: str = "number of seconds") -> Callable[[str], float]:
    """Return a parser of a number of seconds from `least` to `most`; its error states the kind of number."""

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = -1.0
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(f"`{text}` is not a {kind}")
        return value

    return read


def count(kind: str = "whole number of at least 1") -> Callable[[str], int]:
    """Return a parser of a whole number of at least 1; its error states the kind of number."""

    def read(text: str) -> int:
        if not text.isdecimal() or int(text) < 1:
            raise argparse.ArgumentTypeError(f"`{text}` is not a {kind}")
        return int(text)

    return read
