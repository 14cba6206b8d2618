"""Comments in a file that suppress findings, and findings on those comments."""

from urdfkit.lint.engine.rule_runner import RuleRunner, every_code
from urdfkit.lint.facts.suppressions import Suppression
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options


def without_suppressed(
    findings: list[Finding], model: Model, entry: Entry, options: Options, runner: RuleRunner
) -> tuple[list[Finding], tuple[tuple[str, str], ...], tuple[tuple[str, tuple[str, ...]], ...]]:
    """Return the findings that no comment suppresses, and `used` and `unused` of the `EntryResult`."""
    from urdfkit.lint.facts.suppressions import suppressed, suppressions
    from urdfkit.lint.rules import RULES
    from urdfkit.lint.rules.document.unknown_suppression import UnknownSuppression
    from urdfkit.lint.rules.document.unused_suppression import UnusedSuppression

    comments: dict[str, list[Suppression]] = {}
    for file, source in model.expanded.sources.items():
        if "urdfkit:" in source.text:
            comments[file] = suppressions(model.document(file))
            if runner.applies(UnknownSuppression, model.target):
                findings += UnknownSuppression().check(comments[file], every_code(), model)
    left, used = suppressed(findings, comments)
    judged = {rule.code for rule in RULES if runner.applies(rule, model.target)}
    if entry.is_library or model.is_incomplete:
        judged.clear()
    every = bool(judged) and not options.select and not options.ignore
    codes: dict[int, set[str]] = {}
    for item, code in used:
        codes.setdefault(id(item), set()).add(code)
    without: list[tuple[Suppression, tuple[str, ...]]] = []
    for items in comments.values():
        unused = []
        for item in items:
            met = codes.get(id(item), set())
            lost = tuple(code for code in item.codes if code in judged and code not in met)
            if lost or (every and not item.codes and not met):
                unused.append((item, lost))
        without += unused
        if runner.applies(UnusedSuppression, model.target):
            valid = [one for one in unused if one[0].verb in ("ignore", "ignore-file")]
            left += UnusedSuppression().check(valid, model)
    places = tuple(sorted({(str(item.position), code) for item, code in used}))
    return left, places, tuple((str(item.position), codes) for item, codes in without)
