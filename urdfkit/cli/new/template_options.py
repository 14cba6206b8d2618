"""Options of ``urdfkit new KIND``: the questions of a bundled template or of the user's own."""

import argparse
from functools import partial
from itertools import takewhile
from typing import Any

from urdfkit.cli.parser import Parser
from urdfkit.scaffold import Question, Template, named_template, sanitised, template_at

_ALIASES = {
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
"""Other names → options of `urdfkit new`."""


class YesOrNo(argparse.BooleanOptionalAction):
    """``--option`` and ``--no-option``, stored as the answers ``yes`` and ``no`` of a template's question."""

    def __call__(self, parser: Any, namespace: Any, values: Any, option_string: str | None = None) -> None:
        """Store the answer."""
        setattr(namespace, self.dest, "no" if (option_string or "").startswith("--no-") else "yes")


class KindParser(Parser):
    """Parser of one template, bundled or named by ``--template``: its options are the template's questions."""

    _is_filled = False

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Add the template's options, then parse.

        Raises:
            UrdfkitError: the template does not exist or is invalid, or an argument is.
        """
        words = list(args or ())
        self.elsewhere = partial(_suggestion, self, words)
        self.prepare(words)
        return super().parse_known_args(words, namespace)

    def prepare(self, words: list[str]) -> None:
        """Add the options: the questions of the template that the words of the command line name.

        Raises:
            ResourceError: the template does not exist or is invalid.
        """
        if not self._is_filled and self.get_default("new_kind") is not None:
            self._is_filled = True
            _fill(self, chosen(self.get_default("new_kind"), _own_template(words)))


def _suggestion(kind: argparse.ArgumentParser, words: list[str], unknown: str) -> str:
    """Return the option or position that an unknown word probably stands for, as the end of a message."""
    options = kind._option_string_actions
    for alias in (_ALIASES.get(unknown), "--arm" if _ALIASES.get(unknown, unknown) == "--dof" else None):
        if alias in options:
            return f"; did you mean `{alias}`?"
    is_addition = kind.get_default("new_kind") is None
    own = next((each for each in kind._actions if not each.option_strings and each.metavar), None)
    if own is not None and unknown in (("--kind", "--type", "--sensor") if is_addition else ("--name",)):
        return f"; it is a positional argument: {kind.prog} {own.metavar}"
    if unknown.startswith("-"):
        return ""
    if "--dof" in options and unknown.isdigit():
        return f"; did you mean `--dof {unknown}`?"
    if is_addition:
        return f"; did you mean `--into {unknown}`?"
    names = list(takewhile(lambda word: not word.startswith("-"), words))  # a name is one word
    return f"; did you mean `{sanitised(' '.join(names))}`?" if unknown in names[1:] else ""


def _own_template(words: list[str]) -> str | None:
    """Return the value of --template on the command line; None without the option."""
    for number, word in enumerate(words):
        if word == "--template" and number + 1 < len(words):
            return words[number + 1]
        if word.startswith("--template="):
            return word.partition("=")[2]
    return None


def chosen(kind: str, own_template: str | None) -> Template:
    """Return the template of a kind, or the user's own template.

    Args:
        kind: the KIND of ``urdfkit new``.
        own_template: folder of the user's own template, as typed.

    Raises:
        ResourceError: the template does not exist or is invalid.
    """
    return template_at(own_template) if own_template is not None else named_template(kind)


def _fill(kind: argparse.ArgumentParser, template: Template) -> None:
    name = kind.get_default("new_kind")
    kind.description = f"Write {template.summary}."
    kind.epilog = "\n".join(["examples:", *(f"  urdfkit new {name} {example}" for example in template.examples)])
    for question in template.questions:
        _add(kind, question)
    kind.add_argument("--into", metavar="DIR", default=".", help="folder to write to (default: the working directory)")
    kind.add_argument(
        "--from",
        dest="recipe",
        metavar="FILE",
        help="read answers from the urdfkit-new.toml FILE; options override them",
    )
    kind.add_argument("--template", metavar="DIR", help="folder of your own template, used instead of the bundled one")
    kind.add_argument("-y", "--yes", action="store_true", help="skip the questions; use defaults for missing options")
    shown = "do not show a preview in the browser" if template.teleop else argparse.SUPPRESS
    kind.add_argument("--no-preview", action="store_true", help=shown)
    kind.add_argument(
        "--update",
        action="store_true",
        default=argparse.SUPPRESS,
        help="recreate in place the packages in DIR with these options; files you edited stay unchanged",
    )
    kind.add_argument("--diff", action="store_true", help="with --update: print the changes without writing them")
    if template.teleop:
        kind.add_argument(
            "--teleop",
            action="store_true",
            help="after writing the packages, start teleop in the browser, like `urdfkit sim teleop`",
        )


def add_update(parser: argparse.ArgumentParser) -> None:
    """Add the options of `urdfkit new --update` without a KIND; each KIND has its own.

    Args:
        parser: the parser of ``urdfkit new``.
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
