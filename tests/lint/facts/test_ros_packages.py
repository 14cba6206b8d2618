"""Packages that others bring along."""

import pytest

from urdfkit.lint.facts.ros_packages import is_in_metapackage


@pytest.mark.parametrize(
    ("metapackage", "name"),
    [
        ("moveit_planners", "moveit_planners_ompl"),
        ("moveit_planners", "pilz_industrial_motion_planner"),
        ("moveit", "pilz_industrial_motion_planner"),
        ("moveit_plugins", "moveit_simple_controller_manager"),
        ("navigation2", "nav2_navfn_planner"),
    ],
)
def test_a_metapackage_brings_its_packages(metapackage: str, name: str) -> None:
    assert is_in_metapackage(name, [metapackage])
    assert not is_in_metapackage(name, ["moveit_kinematics", "nav2_util"])
