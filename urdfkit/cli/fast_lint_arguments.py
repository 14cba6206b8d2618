"""A command line of ``urdfkit lint`` with nothing but paths and switches, read without argparse.

Most runs are such, and argparse takes as long to load and to make as a small robot to lint.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

_SWITCHES = ("fix", "unsafe_fixes", "diff", "statistics", "watch", "no_config", "no_cache", "quiet", "verbose")
_NAMES = {"-q": "quiet", "-v": "verbose", **{f"--{name.replace('_', '-')}": name for name in _SWITCHES}}


class Plain:
    """What the parser of the command would return.

    Args:
        paths: what is no switch.
        given: the switches that are there.
    """

    def __init__(self, paths: list[str], given: set[str]) -> None:
        self.command = "lint"
        self.paths = paths
        self.select: list[str] = []
        self.ignore: list[str] = []
        self.package_path: list[str] = []
        self.target = self.baseline = self.write_baseline = self.config = self.jobs = None
        self.format, self.color = "text", "auto"
        for name in _SWITCHES:
            setattr(self, name, name in given)


def plain(words: Sequence[str]) -> argparse.Namespace | None:
    """Return what the parser would, None where it is needed: for options with values, and for what is no option."""
    paths: list[str] = []
    given: set[str] = set()
    for word in words:
        if not word.startswith("-"):
            paths.append(word)
        elif word in _NAMES:
            given.add(_NAMES[word])
        else:
            return None
    return Plain(paths, given)  # type: ignore[return-value]
