"""The options of ``urdfkit new THING``: what a template asks, ours or the user's own."""

from __future__ import annotations

import argparse
from functools import partial
from itertools import takewhile
from typing import Any

from urdfkit.cli.parser import Parser
from urdfkit.scaffold import Question, Template, named_template, sanitised, template_at

_CALLED = {
    **dict.fromkeys(("-o", "--out", "--output", "--dir", "--dest"), "--into"),
    "--rate": "--update-rate",
    "--hz": "--update-rate",
    "--frequency": "--update-rate",
    "--joints": "--dof",
    "--axes": "--dof",
    "--arm": "--dof",
    "--link": "--parent",
    "--position": "--xyz",
    "--pose": "--xyz",
    "--origin": "--xyz",
}
"""What some call options of `urdfkit new`."""


class YesOrNo(argparse.BooleanOptionalAction):
    """``--option`` and ``--no-option``, kept as the answers ``yes`` and ``no`` of a template's question."""

    def __call__(self, parser: Any, namespace: Any, values: Any, option_string: str | None = None) -> None:
        """Keep the answer."""
        setattr(namespace, self.dest, "no" if (option_string or "").startswith("--no-") else "yes")


class Kind(Parser):
    """The parser of one template, or of the user's own that is named behind it: its options are the questions."""

    _is_filled = False

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Fill in the options first, now that it is known whose.

        Raises:
            UrdfkitError: there is no such template, it is wrong, or so are the arguments.
        """
        words = list(args or ())
        self.elsewhere = partial(_meant, self, words)
        self.prepare(words)
        return super().parse_known_args(words, namespace)

    def prepare(self, words: list[str]) -> None:
        """Add the options: the questions of the template that the words of the command line name.

        Raises:
            ResourceError: there is no such template, or it is wrong.
        """
        if not self._is_filled and self.get_default("thing") is not None:
            self._is_filled = True
            _fill(self, chosen(self.get_default("thing"), _own(words)))


def _meant(kind: argparse.ArgumentParser, words: list[str], unknown: str) -> str:
    """Return what to say of a word that is no option: whose it is, or that it stands by itself."""
    options = kind._option_string_actions
    for called in (_CALLED.get(unknown), "--arm" if _CALLED.get(unknown, unknown) == "--dof" else None):
        if called in options:
            return f"; did you mean `{called}`?"
    is_added = kind.get_default("thing") is None  # to a description that is there
    own = next((each for each in kind._actions if not each.option_strings and each.metavar), None)
    if own is not None and unknown in (("--kind", "--type", "--sensor") if is_added else ("--name",)):
        return f"; it stands by itself: {kind.prog} {own.metavar}"
    if unknown.startswith("-"):
        return ""
    if "--dof" in options and unknown.isdigit():
        return f"; did you mean `--dof {unknown}`?"
    if is_added:
        return f"; did you mean `--into {unknown}`?"
    names = list(takewhile(lambda word: not word.startswith("-"), words))  # a name is one word
    return f"; did you mean `{sanitised(' '.join(names))}`?" if unknown in names[1:] else ""


def _own(words: list[str]) -> str | None:
    """Return what is named by --template among the words of a command line; None where nothing is."""
    for number, word in enumerate(words):
        if word == "--template" and number + 1 < len(words):
            return words[number + 1]
        if word.startswith("--template="):
            return word.partition("=")[2]
    return None


def chosen(thing: str, own: str | None) -> Template:
    """Return the template of a thing, or the user's own instead.

    Args:
        thing: what ``urdfkit new`` is asked for.
        own: a folder, as typed.

    Raises:
        ResourceError: there is no such template, or it is wrong.
    """
    return template_at(own) if own is not None else named_template(thing)


def _fill(kind: argparse.ArgumentParser, template: Template) -> None:
    name = kind.get_default("thing")
    kind.description = f"Write {template.summary}."
    kind.epilog = "\n".join(["examples:", *(f"  urdfkit new {name} {example}" for example in template.examples)])
    for question in template.questions:
        _add(kind, question)
    kind.add_argument("--into", metavar="DIR", default=".", help="folder to write to (default: the one you stand in)")
    kind.add_argument(
        "--from", dest="recipe", metavar="FILE", help="answers in TOML, such as each result keeps; options come first"
    )
    kind.add_argument("--template", metavar="DIR", help="a template of your own, in the place of ours")
    kind.add_argument("-y", "--yes", action="store_true", help="ask nothing: defaults for what is left out")
    shown = "ask without showing the robot in the browser" if template.teleop else argparse.SUPPRESS
    kind.add_argument("--no-preview", action="store_true", help=shown)
    kind.add_argument(
        "--update",
        action="store_true",
        default=argparse.SUPPRESS,
        help="make again in place what was made in DIR, with these options, leaving alone what was edited",
    )
    kind.add_argument("--diff", action="store_true", help="with --update: show what would change, and change nothing")
    if template.teleop:
        kind.add_argument("--teleop", action="store_true", help="then drive it in the browser, as `urdfkit sim teleop`")
    for option in template.asks_later:
        kind.add_argument(f"--{option}", dest=f"later_{option}", nargs="?", const="", help=argparse.SUPPRESS)


def add_update(parser: argparse.ArgumentParser) -> None:
    """Add what `urdfkit new --update` takes without a thing; a thing has its own.

    Args:
        parser: of ``urdfkit new``.
    """
    parser.add_argument("--into", dest="above_into", metavar="DIR", default=".", help=argparse.SUPPRESS)
    parser.add_argument("-y", "--yes", dest="above_yes", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--diff", dest="above_diff", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--template", dest="above_template", metavar="DIR", help=argparse.SUPPRESS)


def _add(parser: argparse.ArgumentParser, question: Question) -> None:
    unit = f" [{question.unit}]" if question.unit else ""
    choices = f": {', '.join(question.choices)}" if question.choices else ""
    default = f" (default: {question.default.removeprefix('=').strip()})" if question.default else ""
    text = f"{question.prompt}{unit}{choices}{default}{'; ' if question.help else ''}{question.help}".replace("%", "%%")
    if question.default is None:
        parser.add_argument(question.name, nargs="?", metavar=question.name.upper(), help=text)
    elif question.kind == "flag":
        parser.add_argument(question.option, dest=question.name, action=YesOrNo, help=text)
    else:
        metavar = question.unit or question.name.upper()
        action = "append" if question.several else "store"
        option = parser.add_argument(question.option, dest=question.name, metavar=metavar, action=action, help=text)
        option.completer = lambda prefix, **_: [c for c in question.choices if c.startswith(prefix)]  # type: ignore[attr-defined]
