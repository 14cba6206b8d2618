"""The error for an unknown command, with the nearest command."""

from __future__ import annotations

from collections.abc import Sequence

from urdfkit.defect_message import Suggestion
from urdfkit.errors import UsageError, nearest

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import NoReturn

OTHER_NAMES = {
    **dict.fromkeys(("help", "commands", "list", "usage"), "--help"),
    "version": "--version",
    **dict.fromkeys(("teleop", "drive", "start"), "sim teleop"),
    **dict.fromkeys(("run", "play"), "sim run"),
    **dict.fromkeys(("simulate", "simulation", "simulator", "gazebo"), "sim"),
    "warmup": "sim warmup",
    **dict.fromkeys(("echo", "pub", "hz", "bw"), "topic"),
    **dict.fromkeys(("create", "add", "init", "scaffold", "generate", "update"), "new"),
    **dict.fromkeys(("check", "fix", "validate", "check_urdf"), "lint"),
    **dict.fromkeys(("fmt", "tidy", "prettify"), "format"),
    **dict.fromkeys(("show", "display", "visualize", "visualise", "rviz", "open"), "view"),
    **dict.fromkeys(("xacro", "convert"), "expand"),
    **dict.fromkeys(("transform", "frames", "tree", "tf_echo", "view_frames"), "tf"),
    **dict.fromkeys(("rules", "explain"), "rule"),
}
"""Subcommand or command of another tool → command of urdfkit."""


def refuse(word: str, commands: Sequence[str], following: Sequence[str] = ()) -> NoReturn:
    """Raise for an unknown command.

    Args:
        word: the word typed.
        commands: names of all commands.
        following: the words after it.

    Raises:
        UsageError: always.
    """
    near = word if word in OTHER_NAMES else nearest(word, [*commands, *OTHER_NAMES.keys() - {"list"}])
    meant = OTHER_NAMES.get(near or "", near)
    if word == "help" and following and following[0] in commands:
        meant = f"{following[0]} --help"
    elif word not in OTHER_NAMES and _is_robot(word):
        meant = f"view {word}"
    hint = Suggestion(f"urdfkit {meant}") if meant else "; `urdfkit --help` lists the commands"
    raise UsageError(f"unknown command `{word}`{hint}")


def _is_robot(word: str) -> bool:
    from urdfkit.resources import robot_names
    from urdfkit.robot_files import MODEL_SUFFIXES

    return word.endswith(MODEL_SUFFIXES) or word in robot_names()
