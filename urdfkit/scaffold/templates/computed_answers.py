"""Placeholders of the bundled templates that are computed in Python."""

from collections.abc import Mapping


def computed(template: str, answers: Mapping[str, str]) -> dict[str, str]:
    """Return the placeholders that a bundled template needs in addition to its answers.

    Args:
        template: name of the template.
        answers: answers to its questions.

    Raises:
        UsageError: the answers contradict each other.
    """
    if template == "world":
        from urdfkit.scaffold.world import contents

        return contents(answers)
    if template == "package":
        return _package(answers)
    return {}


def _package(answers: Mapping[str, str]) -> dict[str, str]:
    """Return the placeholders of the ``package`` template: related package names, CMake dependencies, description."""
    name, depends = answers["name"], answers["depends"].split()
    robot = name.removesuffix(f"_{answers['kind']}")
    about = {
        "plain": f"{name}: an empty package.",
        "description": f"The robot {robot}: its links, joints, shapes and masses.",
        "gazebo": f"Worlds for the robot {robot}, and the launch file that starts Gazebo with the robot.",
        "control": f"Controllers of the robot {robot}.",
        "bringup": f"Launch file that starts all nodes of the robot {robot}.",
    }
    lines = "".join(f"\n  {package}" for package in sorted(depends))  # catkin_lint requires this order
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
