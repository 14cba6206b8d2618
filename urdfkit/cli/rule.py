"""``urdfkit rule``: print the page of a rule, or the list of all rules."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

    from urdfkit.lint.rule import Rule


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "code", nargs="?", metavar="CODE", help="code (I503) or name of a rule (default: list all rules)"
    )
    parser.epilog = "examples:\n  urdfkit rule\n  urdfkit rule I503"


def run(arguments: argparse.Namespace) -> int:
    """Print the page of the rule, or the list.

    Raises:
        UsageError: unknown rule.
    """
    from urdfkit.lint.catalogue import page, rules

    if arguments.code is None:
        print(_catalogue(rules()))
        return 0
    wanted = arguments.code
    for rule in rules():
        if wanted.upper() == rule.code or wanted.lower() == rule.name:
            print(page(rule))
            return 0
    from urdfkit.errors import UsageError, did_you_mean

    names = [word for rule in rules() for word in (rule.code, rule.name)]
    raise UsageError(f"unknown rule `{wanted}`{did_you_mean(wanted, names) or '; `urdfkit rule` lists the rules'}")


def _catalogue(rules: tuple[type[Rule], ...]) -> str:
    from urdfkit.lint.catalogue import title

    width = max(len(rule.name) for rule in rules)
    ways = {"safe": "[*]", "unsafe": "[?]", "none": "   "}
    lines = [f"{r.code}  {r.severity:7s}  {ways[r.fix]}  {r.name:{width}s}  {title(r)}" for r in rules]
    return "\n".join([*lines, "", "[*] fixed by --fix   [?] fixed by --fix --unsafe-fixes"])
