"""Which descriptions include which, by the paths that they write; computed parts of a path match anything."""

import re
from pathlib import Path

# Compiled on first use.
INCLUDE = r"<(?:xacro:)?include\b[^<>]*?filename\s*=\s*(?:\"([^\"]*)\"|'([^']*)')"
_VARIABLE = r"\$\([^()]*\)|\$\{[^{}]*\}"


def includers(path: Path, robots: dict[Path, str]) -> list[Path]:
    """Return the top-level files that include `path` directly or indirectly."""
    included = included_files(robots)
    return sorted(other for other in above(path, robots) - {path} if other not in included)


def above(path: Path, robots: dict[Path, str]) -> set[Path]:
    """Return a file and all files that include it directly or indirectly."""
    reached = {path}
    while True:
        more = {other for other, text in robots.items() if any(matches(text, file) for file in reached)}
        if more <= reached:
            return reached
        reached |= more


def included_files(robots: dict[Path, str]) -> set[Path]:
    """Return the files that another of the files includes.

    Args:
        robots: file → text without comments.
    """
    patterns: dict[str, list[tuple[Path, re.Pattern[str]]]] = {}
    for other, text in robots.items():
        for name, pattern in _patterns(text):
            patterns.setdefault(name, []).append((other, pattern))
    return {
        path
        for path in robots
        if any(
            other != path and pattern.search(path.as_posix())
            for other, pattern in (*patterns.get(path.name, ()), *patterns.get("", ()))
        )
    }


def matches(text: str, path: Path) -> bool:
    """Return whether a text includes a file."""
    return any(pattern.search(path.as_posix()) for _, pattern in _patterns(text))


def _patterns(text: str) -> list[tuple[str, re.Pattern[str]]]:
    """Return name and pattern of the path of each included file: the part after the last ``$(…)`` or ``..``.

    The name is empty if it is computed.
    """
    found = []
    for double, single in re.findall(INCLUDE, text):
        written = (double or single).replace("\\", "/").rpartition("../")[2].removeprefix("./")
        written = re.sub(r"^\$\(find[^()]*\)/", "", written)
        parts = [re.escape(part) for part in re.split(_VARIABLE, written)]
        if any(parts):
            name = written.rpartition("/")[2]
            found.append(("" if re.search(_VARIABLE, name) else name, re.compile(f"(^|/){'.*'.join(parts)}$")))
    return found
