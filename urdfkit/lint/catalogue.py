"""Rule catalogue: all rules, and the documentation page generated from each rule's docstring."""

from urdfkit.lint.rule import SECTIONS as SECTIONS
from urdfkit.lint.rule import Rule
from urdfkit.lint.rules import RULES

_FIXES = {
    "safe": "fixed by `urdfkit lint --fix`",
    "unsafe": "fixed by `urdfkit lint --fix --unsafe-fixes`",
    "none": "no automatic fix",
}


def rules() -> tuple[type[Rule], ...]:
    """Return all built-in and third-party rules, sorted by code.

    Raises:
        ResourceError: a third-party rule cannot be imported.
    """
    from urdfkit.entry_points import load

    return tuple(sorted((*RULES, *load("urdfkit.rules")), key=lambda rule: rule.code))


def page(rule: type[Rule]) -> str:
    """Return the page of a rule as Markdown."""
    summary, body = _parts(rule)
    head = f"# {rule.name} ({rule.code})\n\n{summary}\n\nSeverity: {rule.severity}; {_FIXES[rule.fix]}."
    return f"{head}\n\n{body}" if body else head


def title(rule: type[Rule]) -> str:
    """Return the first line of a rule's page."""
    return _parts(rule)[0].replace("``", "`")


def address(code: str) -> str:
    """Return the URL of a rule's page on the published site; empty if the package names no documentation.

    The URL of the site is ``Documentation`` in ``[project.urls]`` of pyproject.toml.
    """
    from importlib.metadata import PackageNotFoundError, metadata

    try:
        urls = metadata("urdfkit").get_all("Project-URL") or ()
    except PackageNotFoundError:
        return ""
    site = dict(url.split(", ", 1) for url in urls).get("Documentation", "")
    return f"{site.rstrip('/')}/reference/rules/{code}.html" if site else ""


def sections(rule: type[Rule]) -> dict[str, str]:
    """Return the sections of a rule's page by heading."""
    found: dict[str, list[str]] = {}
    heading = ""
    for line in _parts(rule)[1].splitlines():
        if line.startswith("## "):
            heading = line.removeprefix("## ")
        found.setdefault(heading, []).append(line)
    return {name: "\n".join(lines[1:]).strip() for name, lines in found.items()}


def _parts(rule: type[Rule]) -> tuple[str, str]:
    lines = (rule.__doc__ or "").strip().splitlines()
    indents = [len(line) - len(line.lstrip()) for line in lines[1:] if line.strip()]
    cut = min(indents, default=0)
    body = "\n".join(line[cut:] for line in lines[1:]).strip()
    return lines[0] if lines else "", body
