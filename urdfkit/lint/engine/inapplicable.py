"""Selected rules that do not apply to the target, which would otherwise pass without a word."""

from collections.abc import Iterable


def inapplicable(select: Iterable[str], target: str | None) -> str:
    """Return one line on selected rules that do not apply to a target; empty if all do.

    Args:
        select: the codes and prefixes of ``--select``; prefixes are accepted and not checked.
        target: the family of the target; None for rules that hold for every target.
    """
    from urdfkit.lint.rules import RULES

    wanted = {word.strip().upper() for words in select for word in words.split(",")}
    lines = []
    for rule in RULES:
        if rule.code not in wanted:
            continue
        if rule.only_for and target not in rule.only_for:
            lines.append(f"{rule.code} is checked only with --target {' or '.join(rule.only_for)}")
        elif target in rule.not_for:
            lines.append(f"{rule.code} is not checked for {target}")
    return "; ".join(lines)
