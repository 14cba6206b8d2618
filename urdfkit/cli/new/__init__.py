"""``urdfkit new``: write packages from a template, or add a sensor, an arm or controllers to a description.

Arguments and answers go in; `urdfkit.scaffold` writes the files, and the next commands are printed.
"""

import argparse
import shlex
import sys
from collections.abc import Callable, Mapping
from datetime import datetime, timezone
from functools import partial
from importlib import import_module
from pathlib import Path

from urdfkit.app.termination import ended_by_signals
from urdfkit.cli.new import update
from urdfkit.cli.new.git_identity import identity
from urdfkit.cli.new.template_options import KindParser, add_update, chosen
from urdfkit.cli.new.update import add_picture, findings
from urdfkit.cli.new.written_packages import misplaced, report_written
from urdfkit.cli.parser import Parser
from urdfkit.defect_message import Suggestion
from urdfkit.errors import UrdfkitError, UsageError, did_you_mean, nearest
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

ADDITIONS = ("arm", "controllers", "sensor")
"""Additions to an existing description: ``urdfkit new KIND`` is the module ``urdfkit.cli.new.KIND``."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add one subcommand per template, with an option per question, and one per kind of addition.

    Args:
        parser: of this command.
    """
    parser.epilog = "examples:\n  urdfkit new robot scout\n  urdfkit new robot scout --ros noetic --into src --yes"
    parser.add_argument(
        "--update",
        action="store_true",
        help="recreate in place the packages that `new` created here; files you edited stay unchanged",
    )
    add_update(parser)
    kinds = parser.add_subparsers(dest="new_kind", metavar="KIND", parser_class=KindParser)
    for name in template_names():
        kinds.add_parser(name, help=named_template(name).summary).set_defaults(new_kind=name)
    for name in ADDITIONS:
        module = import_module(f"urdfkit.cli.new.{name}")
        module.configure(kinds.add_parser(name, help=module.SUMMARY))
    if isinstance(parser, Parser):
        parser.elsewhere = partial(_suggestion, parser)


def _suggestion(parser: Parser, option: str) -> str:
    """Return the subcommand that has an unknown option, or a similar one, as the end of a message."""
    kind_by_option = {question.option: name for name in template_names() for question in named_template(name).questions}
    kind_by_option |= {question.option: "robot" for question in named_template("robot").questions}
    if option in kind_by_option:
        return f"; did you mean `urdfkit new {kind_by_option[option]} NAME {option}`?"
    if own := did_you_mean(option, parser._option_string_actions):
        return own
    near = nearest(option, kind_by_option)
    return Suggestion(near and f"urdfkit new {kind_by_option[near]} NAME {near}")


def run(arguments: argparse.Namespace) -> int:
    """Prompt for answers, render the packages, check them, move them into place.

    Args:
        arguments: from the command line.

    Raises:
        UrdfkitError: the packages could not be created; nothing was written.
    """
    with ended_by_signals():
        code, model = _written(arguments)
    if model is None:
        return code
    from urdfkit.cli import main

    return main(["sim", "teleop", str(model)])


def _written(arguments: argparse.Namespace) -> tuple[int, Path | None]:
    """Return the exit code, and the model to drive next."""
    if arguments.new_kind in ADDITIONS:
        return int(import_module(f"urdfkit.cli.new.{arguments.new_kind}").run(arguments)), None
    if arguments.new_kind is None:
        if not arguments.update:
            raise UsageError(f"new: pass a kind: {', '.join([*template_names(), *ADDITIONS])}")
        return update.run(None, {}, Path(arguments.above_into), arguments, own_template=arguments.above_template), None
    template = chosen(arguments.new_kind, arguments.template)
    preset = {
        question.name: _joined(question, value) if isinstance(value, list) else value
        for question in template.questions
        if (value := getattr(arguments, question.name)) is not None
    }
    into = Path(arguments.into)
    for name, answer in preset.items():
        template.question(name).accept(answer)
    if arguments.update:
        return update.run(template, preset, into, arguments), None
    if arguments.diff:
        raise UsageError("--diff requires --update")
    template = update.with_relative_source(template, into)
    if arguments.recipe is not None:
        preset = read_recipe(template, Path(arguments.recipe), preset)
    preset = {**identity(template), **preset}
    if not arguments.yes and sys.stdin.isatty() and sys.stderr.isatty():
        preset |= _with_preview(template, preset, preview=not arguments.no_preview)
    answers = template.answers(preset, fresh=is_fresh(into))
    answers |= computed(template.name, answers)
    answers |= {"year": str(datetime.now(timezone.utc).year), "into": into.as_posix()}
    finish = add_picture if answers.get("picture") == "yes" else None
    files = create(template, answers, into, check=findings, finish=finish)
    teleop = template.teleop and arguments.teleop
    with report_written(into):
        _report(template, answers, files, into.resolve(), quiet=arguments.quiet or bool(teleop))
    if not arguments.quiet and (why := misplaced(into, files, robot=template.name == "robot")):
        print(f"urdfkit: {why}", file=sys.stderr)
    return 0, into / fill(template.teleop, answers, where="teleop") if teleop else None


def _joined(question: Question, preset: list[str]) -> str:
    """Return all values of a repeatable option as one answer."""
    return " ".join(question.accept(value) if question.kind == "packages" else value for value in preset)


def _with_preview(template: Template, preset: dict[str, str], *, preview: bool) -> dict[str, str]:
    """Prompt for the unanswered questions, with a preview in the browser where possible."""
    from urdfkit.app.viewer.preview import Preview, can_preview

    if not preview or not can_preview(template):
        return _prompt_all(template, preset)
    with Preview(template) as shown:
        shown.follow(preset)
        return _prompt_all(template, preset, follow=shown.follow)


def _prompt_all(
    template: Template, preset: dict[str, str], *, follow: Callable[[Mapping[str, str]], None] = lambda _: None
) -> dict[str, str]:
    """Prompt for the unanswered questions on the terminal; Enter accepts the default."""
    answers = dict(preset)
    for question in template.questions:
        default = question.default_after(answers)
        is_open = question.interactive and len(question.choices) != 1 and applies(question.when, answers)
        if question.name in preset or not is_open:
            answers.setdefault(question.name, default or "")
            continue
        while question.name not in answers:
            answer = _answered(question, default)
            if answer == "?":
                print(f"  {question.explanation}", file=sys.stderr)
                continue
            try:
                accepted = {**answers, question.name: question.accept(answer or default or "")}
            except UsageError as error:
                leave = "; press Ctrl-C to exit without writing" if answer.lower() in ("q", "quit", "exit") else ""
                print(f"  {error}{leave}", file=sys.stderr)
                continue
            wrong, instead = template.contradiction(accepted, question.name)
            if wrong and not instead:
                with_default = {**answers, question.name: default or ""}
                contradicts = template.contradiction(with_default, question.name)[0]
                if default is None or accepted == with_default or contradicts:
                    # Only a different answer to an earlier question resolves the contradiction.
                    raise UsageError(f"{wrong}; nothing was written")
            if wrong:
                print(f"  {wrong} ({instead})" if instead else f"  {wrong}", file=sys.stderr)
                continue
            answers = accepted
            follow(answers)
    return {q.name: answers[q.name] for q in template.questions if q.interactive and applies(q.when, answers)}


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
        raise UrdfkitError("end of input before the last answer; nothing was written") from None
    except (KeyboardInterrupt, SystemExit):  # end the line before the shell prints its prompt
        print(file=sys.stderr)
        raise


def _line(prompt: str) -> str:
    """Prompt for a line and return it; on a terminal with line editing and history.

    Raises:
        EOFError: the input has ended.
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


def _report(template: Template, answers: dict[str, str], files: list[Path], into: Path, *, quiet: bool) -> None:
    """Print the written packages and, unless `quiet`, the next steps."""
    counts: dict[str, int] = {}
    for file in files:
        top = file.relative_to(into).parts[0]
        counts[top] = counts.get(top, 0) + 1
    spare = template.spare(answers)
    for top, count in counts.items():
        if top not in spare:
            print(f"{Path(answers['into'], top).as_posix()}  {count} file{'s' if count > 1 else ''}")
    if extra := [top for top in counts if top in spare]:
        print(f"{Path(answers['into']).as_posix()}  {', '.join(extra)}")
    typed = {**answers, "into": shlex.quote(Path(answers["into"]).as_posix())}
    for title, commands in [] if quiet else template.next_steps(typed):
        print(f"\n{title or 'next'}:")
        for command in commands:
            print(f"  {command.replace(' ./', ' ')}")
