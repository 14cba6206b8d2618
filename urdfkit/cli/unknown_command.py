"""The error for an unknown command, with the nearest command."""

from __future__ import annotations

from collections.abc import Iterable

from urdfkit.errors import UsageError, nearest

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import NoReturn

OTHER_NAMES = {
    **dict.fromkeys(("teleop", "drive"), "sim teleop"),
    **dict.fromkeys(("run", "play"), "sim run"),
    **dict.fromkeys(("simulate", "simulation", "simulator", "gazebo"), "sim"),
    "warmup": "sim warmup",
    **dict.fromkeys(("echo", "pub", "hz", "bw"), "topic"),
    **dict.fromkeys(("create", "init", "scaffold", "generate"), "new"),
    **dict.fromkeys(("check", "fix", "validate", "check_urdf"), "lint"),
    **dict.fromkeys(("show", "display", "visualize", "visualise", "rviz"), "view"),
    **dict.fromkeys(("xacro", "convert"), "expand"),
    **dict.fromkeys(("transform", "frames", "tf_echo", "view_frames"), "tf"),
    **dict.fromkeys(("rules", "explain"), "rule"),
}
"""Subcommand or command of another tool → command of urdfkit."""


def refuse(word: str, commands: Iterable[str]) -> NoReturn:
    """Raise for an unknown command.

    Args:
        word: the word typed.
        commands: names of all commands.

    Raises:
        UsageError: always.
    """
    near = nearest(word, [*commands, *OTHER_NAMES])
    if near is None:
        raise UsageError(f"unknown command `{word}`; `urdfkit --help` lists the commands")
    raise UsageError(f"unknown command `{word}`; did you mean `urdfkit {OTHER_NAMES.get(near, near)}`?")
