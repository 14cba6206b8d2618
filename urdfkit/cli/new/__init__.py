"""``urdfkit new``: write packages from a template, or add a sensor, an arm or controllers to a description.

Arguments and answers go in; `urdfkit.scaffold` writes the files, and the next commands are printed.
"""

from __future__ import annotations

import argparse
import re
import shlex
import sys
from collections.abc import Callable, Mapping
from datetime import datetime, timezone
from functools import partial
from importlib import import_module
from pathlib import Path

from urdfkit.app.termination import ended_by_signals
from urdfkit.cli.git_identity import identity
from urdfkit.cli.new import update
from urdfkit.cli.new.template_options import Kind, add_update, chosen
from urdfkit.cli.new.update import drawn, findings
from urdfkit.cli.new.written_packages import misplaced, told_of_what_is_written
from urdfkit.cli.parser import Parser
from urdfkit.errors import UrdfkitError, UsageError, did_you_mean
from urdfkit.scaffold import (
    Question,
    Template,
    applies,
    computed,
    create,
    fill,
    is_fresh,
    named_template,
    read_recipe,
    template_names,
)

ADDED = ("arm", "controllers", "sensor")
"""What is added to a description that is there: ``urdfkit new KIND`` is the module ``urdfkit.cli.new_KIND``."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add one subcommand per template, with an option per question, and one per kind that is added.

    Args:
        parser: of this command.
    """
    parser.epilog = "examples:\n  urdfkit new robot scout\n  urdfkit new robot scout --ros noetic --into src --yes"
    parser.add_argument(
        "--update",
        action="store_true",
        help="make again in place what `new` has made here, leaving alone what was edited",
    )
    add_update(parser)
    kinds = parser.add_subparsers(dest="thing", metavar="KIND", parser_class=Kind)
    for name in template_names():
        kinds.add_parser(name, help=named_template(name).summary).set_defaults(thing=name)
    for name in ADDED:
        module = import_module(f"urdfkit.cli.new.{name}")
        module.configure(kinds.add_parser(name, help=module.SUMMARY))
    if isinstance(parser, Parser):
        parser.elsewhere = partial(_elsewhere, parser)


def _elsewhere(parser: Parser, option: str) -> str:
    """Return what to say of an option that stands where a kind should: whose it is, or whose is like it."""
    theirs = {question.option: name for name in template_names() for question in named_template(name).questions}
    theirs |= {question.option: "robot" for question in named_template("robot").questions}
    if option in theirs:
        return f"; did you mean `urdfkit new {theirs[option]} NAME {option}`?"
    own = did_you_mean(option, parser._option_string_actions)
    near = re.search("`(.*)`", did_you_mean(option, theirs)) if not own else None
    return f"; did you mean `urdfkit new {theirs[near[1]]} NAME {near[1]}`?" if near else own


def run(arguments: argparse.Namespace) -> int:
    """Ask, render, check, move into place.

    Args:
        arguments: from the command line.

    Raises:
        UrdfkitError: it could not be done; nothing was written then.
    """
    with ended_by_signals():
        code, model = _written(arguments)
    if model is None:
        return code
    from urdfkit.cli import main

    return main(["sim", "teleop", str(model)])


def _written(arguments: argparse.Namespace) -> tuple[int, Path | None]:
    """Return the exit code, and the model that is to be driven now."""
    if arguments.thing in ADDED:
        return int(import_module(f"urdfkit.cli.new.{arguments.thing}").run(arguments)), None
    if arguments.thing is None:
        if not arguments.update:
            raise UsageError(
                f"new: the following arguments are required: KIND ({', '.join([*template_names(), *ADDED])})"
            )
        return update.run(None, {}, Path(arguments.above_into), arguments, own=arguments.above_template), None
    template = chosen(arguments.thing, arguments.template)
    for option in template.asks_later:
        if getattr(arguments, f"later_{option}") is not None:
            there = ", ".join(
                question.option for question in template.questions if question.kind not in ("package", "world")
            )
            raise UsageError(f"--{option} is not available yet; there is: {there}")
    given = {
        question.name: _joined(question, value) if isinstance(value, list) else value
        for question in template.questions
        if (value := getattr(arguments, question.name)) is not None
    }
    into = Path(arguments.into)
    for name, answer in given.items():
        template.question(name).accept(answer)
    if arguments.update:
        return update.run(template, given, into, arguments), None
    if arguments.diff:
        raise UsageError("--diff goes with --update: there is nothing yet to compare with")
    template = update.placed(template, into)
    if arguments.recipe is not None:
        given = read_recipe(template, Path(arguments.recipe), given)
    given = {**identity(template), **given}
    if not arguments.yes and sys.stdin.isatty() and sys.stderr.isatty():
        given |= _asked(template, given, preview=not arguments.no_preview)
    answers = template.answers(given, fresh=is_fresh(into))
    answers |= computed(template.name, answers)
    answers |= {"year": str(datetime.now(timezone.utc).year), "into": into.as_posix()}
    files = create(template, answers, into, check=findings, finish=drawn if answers.get("picture") == "yes" else None)
    teleop = template.teleop and arguments.teleop
    with told_of_what_is_written(into):
        _tell(template, answers, files, into.resolve(), quiet=arguments.quiet or bool(teleop))
    if not arguments.quiet and (why := misplaced(into, files, robot=template.name == "robot")):
        print(f"urdfkit: {why}", file=sys.stderr)
    return 0, into / fill(template.teleop, answers, where="teleop") if teleop else None


def _joined(question: Question, given: list[str]) -> str:
    """Return what an option was given each time as one answer."""
    return " ".join(question.accept(value) if question.kind == "packages" else value for value in given)


def _asked(template: Template, given: dict[str, str], *, preview: bool) -> dict[str, str]:
    """Ask for what is left out, with what comes of it in the browser, if that can be."""
    from urdfkit.app.viewer.preview import Preview, can_preview

    if not preview or not can_preview(template):
        return _ask(template, given)
    with Preview(template) as shown:
        shown.follow(given)
        return _ask(template, given, follow=shown.follow)


def _ask(
    template: Template, given: dict[str, str], *, follow: Callable[[Mapping[str, str]], None] = lambda _: None
) -> dict[str, str]:
    """Ask on the terminal for what is left out; Enter takes the default."""
    found = dict(given)
    for question in template.questions:
        default = question.default_given(found)
        asked = question.ask and len(question.choices) != 1 and applies(question.when, found)
        if question.name in given or not asked:
            found.setdefault(question.name, default or "")
            continue
        while question.name not in found:
            answer = _answered(question, default)
            if answer == "?":
                print(f"  {question.explanation}", file=sys.stderr)
                continue
            try:
                accepted = {**found, question.name: question.accept(answer or default or "")}
            except UsageError as error:
                leave = "; Ctrl-C ends, and writes nothing" if answer.lower() in ("q", "quit", "exit") else ""
                print(f"  {error}{leave}", file=sys.stderr)
                continue
            wrong, instead = template.contradiction(accepted, question.name)
            if wrong and not instead:
                as_usual = {**found, question.name: default or ""}
                if default is None or accepted == as_usual or template.contradiction(as_usual, question.name)[0]:
                    # It is an earlier answer that would have to change.
                    raise UsageError(f"{wrong}; nothing was written")
            if wrong:
                print(f"  {wrong} ({instead})" if instead else f"  {wrong}", file=sys.stderr)
                continue
            found = accepted
            follow(found)
    return {q.name: found[q.name] for q in template.questions if q.ask and applies(q.when, found)}


def _answered(question: Question, default: str | None) -> str:
    unit = f" [{question.unit}]" if question.unit else ""
    among = ("yes", "no") if question.kind == "flag" else question.choices
    choices = f" ({', '.join(among)})" if len(among) > 1 else ""
    offered = f" = {default}" if default else ", several with commas, Enter for none" if question.several else ""
    prompt = f"{question.prompt}{choices}{unit}{offered}: "
    try:
        return _line(prompt).strip()
    except EOFError:
        print(file=sys.stderr)
        raise UrdfkitError("no more answers: nothing was written") from None
    except (KeyboardInterrupt, SystemExit):  # the shell's prompt comes next, on a line of its own
        print(file=sys.stderr)
        raise


def _line(prompt: str) -> str:
    """Ask, and return what is typed; on a terminal it can be edited, and earlier answers are above it.

    Raises:
        EOFError: there is no more.
    """
    if sys.stdout.isatty():
        try:
            import readline
        except ImportError:  # Python was built without it
            pass
        else:
            if "libedit" not in (readline.__doc__ or ""):
                readline.parse_and_bind("set enable-bracketed-paste off")
        return input(prompt)
    print(prompt, end="", file=sys.stderr, flush=True)
    line = sys.stdin.readline()
    if not line:
        raise EOFError
    return line


def _tell(template: Template, answers: dict[str, str], files: list[Path], into: Path, *, quiet: bool) -> None:
    """Print what was written and, unless `quiet`, what to do with it."""
    counts: dict[str, int] = {}
    for file in files:
        top = file.relative_to(into).parts[0]
        counts[top] = counts.get(top, 0) + 1
    spare = template.spare(answers)
    for top, count in counts.items():
        if top not in spare:
            print(f"{Path(answers['into'], top).as_posix()}  {count} file{'s' if count > 1 else ''}")
    if beside := [top for top in counts if top in spare]:
        print(f"{Path(answers['into']).as_posix()}  {', '.join(beside)}")
    typed = {**answers, "into": shlex.quote(Path(answers["into"]).as_posix())}
    for title, commands in [] if quiet else template.next_steps(typed):
        print(f"\n{title or 'next'}:")
        for command in commands:
            print(f"  {command.replace(' ./', ' ')}")
