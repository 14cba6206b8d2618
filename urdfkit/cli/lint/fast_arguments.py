"""Parse a command line of ``urdfkit lint`` that has only paths and switches, without argparse.

Most runs are such, and loading and configuring argparse takes as long as linting a small robot.
"""

from __future__ import annotations

from urdfkit.lint.project.options import TIME_LIMIT

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

_SWITCHES = (
    *("fix", "unsafe_fixes", "fix_generated", "diff", "statistics", "watch", "no_config", "no_cache", "confined"),
    *("no_launch_arguments", "quiet", "verbose"),
)
_NAMES = {"-q": "quiet", "-v": "verbose", **{f"--{name.replace('_', '-')}": name for name in _SWITCHES}}


class SimpleArguments:
    """Arguments as the parser of the command returns them.

    Args:
        paths: the positional arguments.
        switches: names of the switches that are set.
    """

    def __init__(self, paths: list[str], switches: set[str]) -> None:
        self.command = "lint"
        self.paths = paths
        self.select: list[str] = []
        self.ignore: list[str] = []
        self.package_path: list[str] = []
        self.target = self.baseline = self.write_baseline = self.config = self.jobs = self.macro = None
        self.format, self.color, self.time_limit = "text", "auto", TIME_LIMIT
        for name in _SWITCHES:
            setattr(self, name, name in switches)


def parse_simple(words: Sequence[str]) -> argparse.Namespace | None:
    """Return the parsed arguments; None for options with values and unknown options, which need the full parser."""
    paths: list[str] = []
    switches: set[str] = set()
    for word in words:
        if not word.startswith("-"):
            paths.append(word)
        elif word in _NAMES:
            switches.add(_NAMES[word])
        else:
            return None
    return SimpleArguments(paths, switches)  # type: ignore[return-value]
