"""Mistakes in the parameters of move_base, its costmaps and planners: each has one finding, at its line."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="2"><name>cart</name><version>1.0.0</version><description>A cart.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend><exec_depend>global_planner</exec_depend>
  <exec_depend>teb_local_planner</exec_depend><exec_depend>move_base</exec_depend>
  <exec_depend>costmap_2d</exec_depend><exec_depend>rotate_recovery</exec_depend></package>"""
MOVE_BASE = """base_global_planner: global_planner/GlobalPlanner
base_local_planner: teb_local_planner/TebLocalPlannerROS
recovery_behaviors:
  - {name: turn, type: rotate_recovery/RotateRecovery}
"""
COSTMAP = """local_costmap:
  global_frame: odom
  robot_base_frame: base_link
  update_frequency: 5.0
  rolling_window: true
  footprint: [[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]
  width: 3.0
  resolution: 0.05
  inflation: {inflation_radius: 0.4}
  obstacles:
    observation_sources: laser depth
    laser: {topic: front, data_type: LaserScan}
    depth: {topic: rear, data_type: PointCloud2}
"""
BAND = """TebLocalPlannerROS:
  max_vel_x: 0.5
  footprint_model:
    type: polygon
    vertices: [[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]
  min_obstacle_dist: 0.1
  inflation_dist: 0.4
"""
FILES = {"package.xml": MANIFEST, "cart.urdf": '<robot name="cart"><link name="base_link"/></robot>'}
FILES |= {"move_base.yaml": MOVE_BASE, "costmap.yaml": COSTMAP, "teb.yaml": BAND}
MISTAKES = [
    ("move_base.yaml", "base_global", "global", 1, "no parameter `global_planner`; did you mean `base_global_planner`"),
    ("move_base.yaml", "global_planner/G", "global_planner::G", 1, "did you mean `global_planner/GlobalPlanner`?"),
    ("move_base.yaml", "RotateRecovery", "TurnRecovery", 4, "`rotate_recovery` has no plugin `TurnRecovery`"),
    ("costmap.yaml", "  inflation:", "  robot_radius: 0.4\n  inflation:", 9, "no effect next to `footprint`"),
    ("costmap.yaml", "frequency: 5.0", "frequency: 0.5", 4, "the robot drives 1 m between two updates"),
    ("costmap.yaml", "resolution: 0.05", "resolution: 0.3", 8, "more than the inscribed radius of the robot, 0.2 m"),
    ("costmap.yaml", "[-0.3, 0.2]]", "[0.3, 0.2]]", 6, "`footprint` has the corner [0.3, 0.2] twice; check the signs"),
    ("costmap.yaml", "[0.3, -0.2]", "[0.3, 0.2]", 6, "`footprint` has the corner [0.3, 0.2] twice; check the signs"),
    ("costmap.yaml", "width: 3.0", "width: 0.3", 7, "but the robot extends 0.361 m"),
    (
        "teb.yaml",
        "PlannerROS:",
        "Planner:",
        1,
        "reads the section `TebLocalPlanner`; did you mean `TebLocalPlannerROS`",
    ),
    ("teb.yaml", "polygon", "circular", 4, "parameters of a footprint of the type `polygon`"),
    ("teb.yaml", "dist: 0.1", "dist: 0.5", 6, "so `inflation_dist`, 0.4 m, has no effect"),
]


def findings(folder, name="", old="", new=""):
    for file, text in FILES.items():
        assert file != name or old in text, old
        (folder / file).write_text(text.replace(old, new, 1) if file == name else text)
    return [one for one in lint(folder) if one.file.endswith(".yaml")]


def test_correct_parameters_are_silent(tmp_path):
    assert findings(tmp_path) == []
    assert findings(tmp_path, "teb.yaml", BAND[BAND.index("polygon") : BAND.index("  min")], "point\n") == []


@pytest.mark.parametrize(("name", "old", "new", "line", "message"), MISTAKES)
def test_each_mistake_has_one_finding(tmp_path, name, old, new, line, message):
    [found] = findings(tmp_path, name, old, new)
    assert (found.code, found.line) == ("K982", line)
    assert message in found.message


def test_names_that_commas_separate(tmp_path):
    [found] = findings(tmp_path, "costmap.yaml", "laser depth", "laser, depth")
    assert (found.code, found.line) == ("K971", 11)
    assert "contains commas" in found.message
