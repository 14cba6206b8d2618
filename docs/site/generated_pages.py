"""Hook of mkdocs: pages generated from the program, and pages of the repository's top level.

Commands come from their argument parsers, rules from their docstrings, and the Python interface from the public names.
"""

from __future__ import annotations

import argparse
import inspect
import logging
import re
import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page
from notebook_pages import notebook_pages

import urdfkit
from urdfkit.cli import COMMANDS, parser_of
from urdfkit.lint import catalogue

ROOT = Path(__file__).parents[2]
TOP_LEVEL = {
    "README.md": "index.md",
    **{f"{n.upper()}.md": f"{n}.md" for n in ("changelog", "contributing", "security")},
}
"""Page of the repository's top level → page of the site."""

MODULES = ("urdfkit.sim", "urdfkit.sim.batch", "urdfkit.kinematics", "urdfkit.scene", "urdfkit.messages")
"""Modules below the package whose names extensions and scripts use."""

ALLOWED_WORDS = ("ue",)
"""Correct words that the list of misspellings of codespell contains."""

LOG = logging.getLogger("mkdocs.plugins.generated_pages")
_PROSE: dict[str, str] = {}


def on_files(files: Files, *, config: MkDocsConfig) -> Files:
    """Add the generated pages, and the script of the copy buttons."""
    for name, text in pages().items():
        files.append(File.generated(config, name, content=text))
    script = (Path(__file__).parent / "copy_commands.js").read_text("utf-8")
    files.append(File.generated(config, "javascripts/copy_commands.js", content=script))
    return files


def on_page_markdown(markdown: str, *, page: Page, **_: Any) -> str:
    """Keep the prose for the check of the spelling, and adapt links to files that have no page on the site."""
    _PROSE[page.file.src_uri] = re.sub(r"^```.*?^```|(`+).*?\1", " ", markdown, flags=re.MULTILINE | re.DOTALL)
    markdown = re.sub(r"(\]\(\.\./notebooks/\w+)\.ipynb\)", r"\1.md)", markdown)
    markdown = markdown.replace("](decisions/)", "](decisions/index.md)")
    for old, new in TOP_LEVEL.items():  # whose pages of the site are one folder deeper
        markdown = re.sub(rf"\]\(\.\./((?:\.\./)*){old}", rf"](\1{new}", markdown)
    return re.sub(r"\[([^\]]+)\]\((?:\.\./)+tests/[^)]*\)", r"\1", markdown)


def on_post_build(**_: Any) -> None:
    """Report misspelt words as warnings, which fail a strict build."""
    lines = [f"{name}: {line}" for name, text in _PROSE.items() for line in text.splitlines()]
    command = [sys.executable, "-m", "codespell_lib", "--ignore-words-list", ",".join(ALLOWED_WORDS), "-"]
    done = subprocess.run(command, input="\n".join(lines), capture_output=True, text=True, check=False)
    for line in filter(None, map(str.strip, (done.stdout + done.stderr).splitlines())):
        LOG.warning("spelling: %s", line)


def pages() -> dict[str, str | bytes]:
    """Return path → Markdown of all generated pages, and their pictures."""
    return {
        **{new: _top_level(ROOT / old) for old, new in TOP_LEVEL.items()},
        **_commands(),
        **_rules(),
        **_interface(),
        **notebook_pages(ROOT / "docs/notebooks"),
        "decisions/index.md": _decisions(),
    }


def _top_level(file: Path) -> str:
    text = re.sub(r"\]\(docs/", "](", file.read_text("utf-8"))
    for old, new in TOP_LEVEL.items():
        text = text.replace(f"]({old}", f"]({new}")
    return re.sub(r"\[([^\]]+)\]\(tests/[^)]*\)", r"\1", text)


def _commands() -> dict[str, str]:
    table = (
        "# Commands\n\n`urdfkit COMMAND --help` prints the options of a command.\n\n| command | result |\n|---|---|\n"
    )
    found = {}
    for name, summary in COMMANDS.items():
        table += f"| [`urdfkit {name}`]({name}.md) | {summary} |\n"
        found[f"reference/commands/{name}.md"] = "\n".join(
            _command(_parser(parser_of(name), name), f"urdfkit {name}", 1)
        )
    table += "\nEach command exits with status 0 (success), 1 (success, with findings to report) or 2 (failure).\n"
    return {"reference/commands/index.md": table, **found}


def _parser(parser: argparse.ArgumentParser, name: str) -> argparse.ArgumentParser:
    return next(a for a in parser._actions if isinstance(a, argparse._SubParsersAction)).choices[name]


def _command(parser: argparse.ArgumentParser, name: str, level: int, summary: str = "") -> Iterator[str]:
    yield f"{'#' * level} {name}\n"
    if text := parser.description or summary:
        yield f"{text[0].upper()}{text[1:].rstrip('.')}.\n"
    yield f"```text\n{parser.format_usage().removeprefix('usage: ').rstrip()}\n```\n"
    subcommands = [a for a in parser._actions if isinstance(a, argparse._SubParsersAction)]
    rows = [row for action in parser._actions if action not in subcommands for row in _row(parser, action)]
    if rows:
        yield "| argument | meaning |\n|---|---|"
        yield from rows
        yield ""
    if parser.epilog:
        heading, _, lines = parser.epilog.partition("\n")
        examples = "\n".join(line.strip() for line in lines.splitlines())
        yield f"{heading.capitalize()}\n\n```text\n{examples}\n```\n"
    for action in subcommands:
        summaries = {choice.dest: choice.help or "" for choice in action._choices_actions}
        for word, subparser in action.choices.items():
            yield from _command(subparser, f"{name} {word}", level + 1, summaries.get(word, ""))


def _row(parser: argparse.ArgumentParser, action: argparse.Action) -> Iterator[str]:
    if action.help == argparse.SUPPRESS or action.dest == "help":
        return
    formatter = parser._get_formatter()
    names = ", ".join(f"`{option}`" for option in action.option_strings)
    value = (
        "" if action.nargs == 0 else formatter._format_args(action, formatter._get_default_metavar_for_optional(action))
    )
    names = f"{names} `{value}`" if names and value else names or f"`{value}`"
    yield f"| {_cell(names)} | {_cell(formatter._expand_help(action) if action.help else '')} |"


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ").replace("<", "&lt;")


def _rules() -> dict[str, str]:
    table = "# Rules\n\n`urdfkit rule CODE` prints the page of a rule.\n\n"
    table += "| code | severity | fix | rule |\n|---|---|---|---|\n"
    found = {}
    for rule in catalogue.rules():
        found[f"reference/rules/{rule.code}.md"] = catalogue.page(rule)
        summary = _cell(catalogue.title(rule))
        table += f"| [{rule.code}]({rule.code}.md) | {rule.severity} | {rule.fix} | `{rule.name}`: {summary} |\n"
    return {"reference/rules/index.md": table, **found}


def _interface() -> dict[str, str]:
    table = "# Python interface\n\n| name | summary |\n|---|---|\n"
    found = {}
    for name, value in _documented(urdfkit):
        table += f"| [`urdfkit.{name}`]({name}.md) | {_cell(_summary(value))} |\n"
        found[f"reference/api/{name}.md"] = f"# urdfkit.{name}\n\n::: {_path(value)}\n"
    table += "\nNames of these modules are for plugins, batches and kinematics:\n\n| module | summary |\n|---|---|\n"
    for name in MODULES:
        module = import_module(name)
        values = [value for each, value in _documented(module) if each not in urdfkit.__all__]
        table += f"| [`{name}`]({name}.md) | {_cell(_summary(module))} |\n"
        text = "\n".join(f"::: {_path(value)}\n" for value in values)
        found[f"reference/api/{name}.md"] = f"# {name}\n\n{module.__doc__}\n\n{text}"
    return {"reference/api/index.md": table, **found}


def _documented(module: Any) -> Iterator[tuple[str, Any]]:
    """Yield the public classes and functions of a module."""
    for name in module.__all__:
        value = getattr(module, name)
        if inspect.isclass(value) or inspect.isfunction(value):
            yield name, value


def _path(value: Any) -> str:
    return f"{value.__module__}.{value.__qualname__}"


def _summary(value: Any) -> str:
    return (value.__doc__ or "").strip().partition("\n")[0]


def _decisions() -> str:
    lines = []
    for file in sorted((ROOT / "docs/decisions").glob("*.md")):
        heading = file.read_text("utf-8").partition("\n")[0].removeprefix("# ")
        lines.append(f"- [{heading}]({file.name})")
    return "\n".join(
        ["# Decisions", "", "Each page states one decision, its reasons, and the alternatives.", "", *lines, ""]
    )
