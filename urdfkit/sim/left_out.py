"""What to say of shapes whose mesh is missing or broken."""

from __future__ import annotations

from collections.abc import Callable

from urdfkit.scene import Scene


def remark_left_out(scene: Scene, note: Callable[[str], None]) -> None:
    """Note every shape of a robot that is left out, by name.

    Raises:
        ResourceError: that of the first collision, where no other is left: such a robot would fall through the floor.
    """
    touched = [each for each in scene.problems if each.role == "collision"]
    if touched and not scene.with_role("collision"):
        raise touched[0].error
    for each in scene.problems:
        what = "nothing touches it there" if each.role == "collision" else "what it would look like is not seen"
        note(f"{each.error}; shape `{each.name}` is left out: {what}")
