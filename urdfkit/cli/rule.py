"""``urdfkit rule``: print the page of a rule, or the list of all rules."""

from __future__ import annotations

from urdfkit.errors import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

    from urdfkit.lint.rule import Rule


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "code", nargs="?", metavar="CODE", help="code (I503) or name of a rule (default: list all rules)"
    )
    parser.add_argument("--search", metavar="WORD", nargs="+", help="list the rules whose pages contain all words")
    parser.epilog = "examples:\n  urdfkit rule\n  urdfkit rule I503\n  urdfkit rule --search mesh collision"


def run(arguments: argparse.Namespace) -> int:
    """Print the page of the rule, or a list.

    Raises:
        UsageError: unknown rule, or no page contains the words.
    """
    from urdfkit.errors import did_you_mean
    from urdfkit.lint.catalogue import page, rules

    if arguments.search:
        if arguments.code is not None:
            raise UsageError("pass either CODE or --search")
        print(_catalogue(_search(arguments.search)))
        return 0
    if arguments.code is None:
        print(_catalogue(rules()))
        return 0
    wanted = arguments.code
    for rule in rules():
        if wanted.upper() == rule.code or wanted.lower() == rule.name:
            print(_colored(page(rule)))
            return 0
    names = [word for rule in rules() for word in (rule.code, rule.name)]
    hint = did_you_mean(wanted, names) or f"; try `urdfkit rule --search {wanted}`"
    raise UsageError(f"unknown rule `{wanted}`{hint}")


def _colored(page: str) -> str:
    """Return a page with the lines of its example in color."""
    from urdfkit.cli.colors import colored_diff

    head, fence, rest = page.partition("```diff")
    example, end, tail = rest.partition("\n```")
    return f"{head}{fence}{colored_diff(example)}{end}{tail}"


def _search(words: list[str]) -> tuple[type[Rule], ...]:
    from urdfkit.lint.catalogue import page, rules

    found = tuple(rule for rule in rules() if all(word.lower() in page(rule).lower() for word in words))
    if not found:
        raise UsageError(f"no page of a rule contains {' and '.join(f'`{word}`' for word in words)}")
    return found


def _catalogue(rules: tuple[type[Rule], ...]) -> str:
    from urdfkit.lint.catalogue import title

    width = max(len(rule.name) for rule in rules)
    ways = {"safe": "[*]", "unsafe": "[?]", "none": "   "}
    lines = [f"{r.code}  {r.severity:7s}  {ways[r.fix]}  {r.name:{width}s}  {title(r)}" for r in rules]
    return "\n".join([*lines, "", "[*] fixed by --fix   [?] fixed by --fix --unsafe-fixes"])
