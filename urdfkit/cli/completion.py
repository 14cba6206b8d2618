"""``urdfkit completion SHELL``: completion of commands, options and names on the command line, by argcomplete."""

import argparse
import os
from collections.abc import Callable

SHELLS = ("bash", "zsh", "fish")


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit completion``."""
    parser.epilog = (
        "examples:\n"
        "  urdfkit completion bash > ~/.local/share/bash-completion/completions/urdfkit\n"
        "  urdfkit completion fish > ~/.config/fish/completions/urdfkit.fish\n"
        "zsh: put the script into a file `_urdfkit` of a folder in $fpath"
    )
    parser.add_argument("shell", choices=SHELLS, metavar="{bash,zsh,fish}", help="shell to print the script for")


def run(arguments: argparse.Namespace) -> int:
    """Print the script that a shell reads to complete ``urdfkit``."""
    from argcomplete.shell_integration import shellcode

    print(shellcode(["urdfkit"], shell=arguments.shell))
    return 0


def complete(parser_of: Callable[[str | None], argparse.ArgumentParser]) -> None:
    """Print the completions to the shell that requests them (``_ARGCOMPLETE``), then exit.

    Args:
        parser_of: returns the parser of the command line, with the arguments of one command.
    """
    import argcomplete

    from urdfkit.cli.parser import Parser

    words = os.environ.get("COMP_LINE", "")[: int(os.environ.get("COMP_POINT") or 0) or None].split()
    command = next((word for word in words[1:] if not word.startswith("-")), None)
    parser = parser_of(command)
    for each in _with_subcommands(parser):
        if isinstance(each, Parser):
            each.intermixed = False  # argcomplete reads the words as plain argparse does
            each.prepare(words)
        _add_completers(each)
    argcomplete.autocomplete(parser)


def _with_subcommands(parser: argparse.ArgumentParser) -> list[argparse.ArgumentParser]:
    """Return a parser and the parsers of its subcommands, at any depth."""
    parsers = [parser]
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for subcommand in action.choices.values():
                parsers += _with_subcommands(subcommand)
    return parsers


def _add_completers(parser: argparse.ArgumentParser) -> None:
    """Complete arguments by the names of bundled robots, worlds and rules, and by files."""
    from argcomplete.completers import FilesCompleter

    from urdfkit.description.sdf.model_library import world_names
    from urdfkit.lint.catalogue import rules
    from urdfkit.resources import robot_names

    def rule_codes() -> list[str]:
        return [rule.code for rule in rules()]

    names = {
        **dict.fromkeys(("model", "words"), robot_names),
        "world": world_names,
        **dict.fromkeys(("code", "select", "ignore"), rule_codes),
    }
    for action in parser._actions:
        listed = names.get(action.dest)
        if listed is None:
            continue

        def completer(prefix: str, *, names_of: Callable[[], list[str]] = listed, **_: object) -> list[str]:
            return [*(name for name in names_of() if name.startswith(prefix)), *FilesCompleter()(prefix)]

        action.completer = completer  # type: ignore[attr-defined]
