"""``urdfkit rule``: the page of a rule, or the catalogue."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

    from urdfkit.lint.rule import Rule


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("code", nargs="?", metavar="CODE", help="a code (I503) or name; the catalogue when left out")
    parser.epilog = "examples:\n  urdfkit rule\n  urdfkit rule I503"


def run(arguments: argparse.Namespace) -> int:
    """Print it.

    Raises:
        UsageError: there is no such rule.
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

    known = [word for rule in rules() for word in (rule.code, rule.name)]
    raise UsageError(f"there is no rule `{wanted}`{did_you_mean(wanted, known) or '; urdfkit rule lists them'}")


def _catalogue(rules: tuple[type[Rule], ...]) -> str:
    from urdfkit.lint.catalogue import title

    width = max(len(rule.name) for rule in rules)
    ways = {"safe": "[*]", "unsafe": "[?]", "none": "   "}
    lines = [f"{r.code}  {r.severity:7s}  {ways[r.fix]}  {r.name:{width}s}  {title(r)}" for r in rules]
    return "\n".join([*lines, "", "[*] mended by --fix   [?] by --fix --unsafe-fixes"])
