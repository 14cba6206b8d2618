"""``urdfkit new``: write packages from a template."""

from __future__ import annotations

import argparse
import sys
from datetime import datetime, timezone
from importlib import import_module
from pathlib import Path

from urdfkit.cli.identity import identity
from urdfkit.errors import UrdfkitError, UsageError
from urdfkit.resources import templates_dir
from urdfkit.scaffold import Question, Template, applies, computed, create, load_template, read_recipe, template_names

ADDED = ("sensor",)
"""What is added to a description that is there: ``urdfkit new KIND`` is the module ``urdfkit.cli.new_KIND``."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add one subcommand per template, with an option per question, and one per kind that is added.

    Args:
        parser: of this command.
    """
    parser.epilog = "examples:\n  urdfkit new robot scout\n  urdfkit new robot scout --ros noetic --into src --yes"
    kinds = parser.add_subparsers(dest="thing", metavar="KIND", required=True)
    for name in template_names():
        template = load_template(templates_dir() / name)
        kind = kinds.add_parser(
            name,
            help=template.summary,
            description=f"Write {template.summary}.",
            formatter_class=argparse.RawDescriptionHelpFormatter,
            epilog="\n".join(["examples:", *(f"  urdfkit new {name} {example}" for example in template.examples)]),
        )
        for question in template.questions:
            _add(kind, question)
        kind.add_argument(
            "--into", metavar="DIR", default=".", help="folder to write to (default: the one you stand in)"
        )
        kind.add_argument(
            "--from",
            dest="recipe",
            metavar="FILE",
            help="answers in TOML, such as each result keeps; options come first",
        )
        kind.add_argument("-y", "--yes", action="store_true", help="ask nothing: defaults for what is left out")
        for option in template.asks_later:
            kind.add_argument(f"--{option}", dest=f"later_{option}", nargs="?", const="", help=argparse.SUPPRESS)
    for name in ADDED:
        module = import_module(f"urdfkit.cli.new_{name}")
        module.configure(kinds.add_parser(name, help=module.SUMMARY))


def run(arguments: argparse.Namespace) -> int:
    """Ask, render, check, move into place.

    Args:
        arguments: from the command line.

    Raises:
        UrdfkitError: it could not be done; nothing was written then.
    """
    if arguments.thing in ADDED:
        return int(import_module(f"urdfkit.cli.new_{arguments.thing}").run(arguments))
    template = load_template(templates_dir() / arguments.thing)
    for option in template.asks_later:
        if getattr(arguments, f"later_{option}") is not None:
            there = ", ".join(question.option for question in template.questions if question.kind != "package")
            raise UsageError(f"--{option} is not available yet; there is: {there}")
    given = {
        question.name: " ".join(value) if isinstance(value, list) else value
        for question in template.questions
        if (value := getattr(arguments, question.name)) is not None
    }
    into = Path(arguments.into)
    for name, answer in given.items():
        template.question(name).accept(answer)
    if arguments.recipe is not None:
        given = read_recipe(template, Path(arguments.recipe), given)
    given = {**identity(template), **given}
    if not arguments.yes and sys.stdin.isatty() and sys.stderr.isatty():
        given |= _ask(template, given)
    answers = template.answers(given)
    answers |= computed(template.folder.name, answers)
    answers |= {"year": str(datetime.now(timezone.utc).year), "into": into.as_posix()}
    files = create(template, answers, into, check=_findings)
    _tell(template, answers, files, into.resolve(), quiet=arguments.quiet)
    return 0


def _add(parser: argparse.ArgumentParser, question: Question) -> None:
    unit = f" [{question.unit}]" if question.unit else ""
    choices = f": {', '.join(question.choices)}" if question.choices else ""
    default = f" (default: {question.default.removeprefix('=').strip()})" if question.default else ""
    text = f"{question.prompt}{unit}{choices}{default}{'; ' if question.help else ''}{question.help}".replace("%", "%%")
    if question.default is None:
        parser.add_argument(question.name, nargs="?", metavar=question.name.upper(), help=text)
    elif question.kind == "flag":
        parser.add_argument(question.option, dest=question.name, action="store_const", const="yes", help=text)
        parser.add_argument(
            f"--no-{question.option[2:]}", dest=question.name, action="store_const", const="no", help=argparse.SUPPRESS
        )
    else:
        metavar = question.unit or question.name.upper()
        action = "append" if question.several else "store"
        parser.add_argument(question.option, dest=question.name, metavar=metavar, action=action, help=text)


def _ask(template: Template, given: dict[str, str]) -> dict[str, str]:
    """Ask on the terminal for what is left out; Enter takes the default."""
    found = dict(given)
    for question in template.questions:
        default = question.default_given(found)
        asked = question.ask and len(question.choices) != 1 and applies(question.when, found)
        if question.name in given or not asked:
            found.setdefault(question.name, default or "")
            continue
        while question.name not in found:
            try:
                answer = _answered(question, default)
                found[question.name] = question.accept(answer or default or "")
            except UsageError as error:
                print(f"  {error}", file=sys.stderr)
    return {q.name: found[q.name] for q in template.questions if q.ask and applies(q.when, found)}


def _answered(question: Question, default: str | None) -> str:
    unit = f" [{question.unit}]" if question.unit else ""
    among = ("yes", "no") if question.kind == "flag" else question.choices
    choices = f" ({', '.join(among)})" if len(among) > 1 else ""
    offered = f" = {default}" if default is not None else ""
    print(f"{question.prompt}{choices}{unit}{offered}: ", end="", file=sys.stderr, flush=True)
    line = sys.stdin.readline()
    if not line:
        print(file=sys.stderr)
        raise UrdfkitError("no more answers: nothing was written")
    return line.strip()


def _findings(folder: Path) -> list[str]:
    from urdfkit.description.world import load_world
    from urdfkit.lint import lint
    from urdfkit.resources import models_in

    for world in (*folder.glob("*.sdf"), *folder.glob("*.world")):
        load_world(world)
    if not models_in(folder):
        return []
    found = lint([folder], package_path=[folder])
    return [f"{f.code} {f.message} ({Path(f.file).name}:{f.line})" for f in found if f.severity != "info"]


def _tell(template: Template, answers: dict[str, str], files: list[Path], into: Path, *, quiet: bool) -> None:
    """Print what was written and, unless `quiet`, what to do with it."""
    counts: dict[str, int] = {}
    for file in files:
        top = file.relative_to(into).parts[0]
        counts[top] = counts.get(top, 0) + 1
    for top, count in counts.items():
        print(f"{Path(answers['into'], top).as_posix()}  {count} file{'s' if count > 1 else ''}")
    for title, commands in [] if quiet else template.next_steps(answers):
        print(f"\n{title or 'next'}:")
        for command in commands:
            print(f"  {command.replace(' ./', ' ')}")
