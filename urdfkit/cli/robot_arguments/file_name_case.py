"""Warnings for files of a robot that exist only under a name with other capital letters."""

from __future__ import annotations

import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.urdf.robot import Robot


def warn_of_file_names(robot: Robot, *, quiet: bool = False) -> None:
    """Print the notes of a robot's packages on standard error.

    Args:
        robot: a robot whose meshes are loaded.
        quiet: print nothing.
    """
    if robot.packages is not None and not quiet:
        for note in robot.packages.notes.values():
            print(f"urdfkit: warning: {note}", file=sys.stderr)
