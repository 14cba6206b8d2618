"""Answers that no template can hold: what is computed from the others."""

from __future__ import annotations

from collections.abc import Mapping


def computed(template: str, answers: Mapping[str, str]) -> dict[str, str]:
    """Return further placeholders of a template that we ship.

    Args:
        template: its name.
        answers: to its questions.

    Raises:
        UsageError: the answers do not go together.
    """
    if template == "world":
        from urdfkit.scaffold.world import contents

        return contents(answers)
    if template == "package":
        return _package(answers)
    return {}


def _package(answers: Mapping[str, str]) -> dict[str, str]:
    """Return the names of the packages that go with this one, and what CMake wants to be told of those it needs."""
    name, depends = answers["name"], answers["depends"].split()
    robot = name.removesuffix(f"_{answers['kind']}")
    about = {
        "plain": f"{name}: to put code into.",
        "description": f"The robot {robot}: its links, joints, shapes and masses.",
        "gazebo": f"Worlds for the robot {robot}, and the launch file that puts it into them.",
        "control": f"The controllers of the robot {robot}.",
        "bringup": f"One launch file that starts all of the robot {robot}.",
    }
    lines = "".join(f"\n  {package}" for package in sorted(depends))  # as catkin_lint wants it
    return {
        "robot": robot,
        "namespace": robot,
        "description": f"{robot}_description",
        "gazebo": f"{robot}_gazebo",
        "about": answers["about"] or about[answers["kind"]],
        "model": f"{robot}.urdf.xacro",
        "root": "base_footprint",
        "folders": "",
        "controllers": "",
        "managed": "",
        "spawned": "",
        "ament_tests": "",
        "catkin_tests": "",
        "test_depends": "",
        "components": f" COMPONENTS{lines}\n" if depends else "",
        "catkin_depends": f"\n  CATKIN_DEPENDS{lines}\n" if depends else "",
    }
