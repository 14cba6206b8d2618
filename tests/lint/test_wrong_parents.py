"""Wrong parent links, and what else an SRDF and the shapes of the links then contradict: one finding."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3"><name>lift</name><version>1.0.0</version><description>A lift.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license></package>"""
BOX = '<link name="{0}"><collision><origin xyz="{1}"/><geometry><box size="{2}"/></geometry></collision></link>\n'
FIXED = '<joint name="{0}_joint" type="fixed"><parent link="{1}"/><child link="{0}"/><origin xyz="{2}"/></joint>\n'
SLIDE = """<joint name="{0}_joint" type="prismatic"><parent link="{1}"/><child link="{0}"/><origin xyz="{2}"/>
  <axis xyz="{3}"/><limit lower="0" upper="{4}" effort="9" velocity="1"/></joint>
"""
PAIR = '  <disable_collisions link1="{}" link2="{}" reason="{}"/>\n'

LIFT = f"""<robot name="lift">
{BOX.format("base", "0 0 0", "0.8 0.6 0.2")}{BOX.format("mast", "0 0 0.5", "0.1 0.1 1")}
{FIXED.format("mast", "base", "0 0 0.1")}{BOX.format("carriage", "0 0 0", "0.12 0.14 0.16")}
{SLIDE.format("carriage", "mast", "0 0 0.08", "0 0 1", "0.9")}
{BOX.format("beam", "0.2 0 0", "0.4 0.06 0.08")}{SLIDE.format("beam", "carriage", "0.05 0 0", "1 0 0", "0.6")}
</robot>"""
STATES = """  <group name="lift"><chain base_link="mast" tip_link="beam"/></group>
  <group_state name="low" group="lift"><joint name="carriage_joint" value="0"/><joint name="beam_joint" value="0"/>
  </group_state>
  <group_state name="high" group="lift"><joint name="carriage_joint" value="0.8"/><joint name="beam_joint" value="0"/>
  </group_state>
"""
PAIRS_OF_LIFT = (
    ("base", "mast", "Adjacent"),
    ("mast", "carriage", "Adjacent"),
    ("carriage", "beam", "Adjacent"),
    ("mast", "beam", "Never"),
    ("base", "carriage", "Default"),
)

SIDE = (
    BOX.format("{0}_arm", "0 0 0.1", "0.05 0.05 0.2")
    + FIXED.format("{0}_arm", "base", "0 {1} 0.2")
    + BOX.format("{0}_palm", "0 0 0", "0.1 0.1 0.04")
    + FIXED.format("{0}_palm", "{0}_arm", "0 0 0.22")
    + BOX.format("{0}_finger", "0 0 0", "0.06 0.06 0.06")
    + SLIDE.format("{0}_finger", "{0}_palm", "0 0.01 0.05", "0 1 0", "0.03")
)
HANDS = f"""<robot name="lift">
{BOX.format("base", "0 0 0", "0.4 0.8 0.4")}{SIDE.format("left", "0.3")}{SIDE.format("right", "-0.3")}
</robot>"""
FINGERS = '  <group name="fingers"><joint name="left_finger_joint"/><joint name="right_finger_joint"/></group>\n'
PAIRS_OF_HANDS = [("left_arm", "right_arm", "Never")]
for side in ("left", "right"):
    PAIRS_OF_HANDS += [("base", f"{side}_arm", "Adjacent"), (f"{side}_arm", f"{side}_palm", "Adjacent")]
    PAIRS_OF_HANDS += [(f"{side}_palm", f"{side}_finger", "Adjacent"), (f"{side}_arm", f"{side}_finger", "Never")]


@pytest.mark.parametrize(
    ("robot", "states", "pairs", "old", "new", "code"),
    [
        (LIFT, STATES, PAIRS_OF_LIFT, 'parent link="carriage"', 'parent link="mast"', "J424"),
        (HANDS, FINGERS, PAIRS_OF_HANDS, 'parent link="right_arm"', 'parent link="left_arm"', "S909"),
    ],
    ids=["lift", "hands"],
)
def test_a_wrong_parent_is_one_finding_there(robot, states, pairs, old, new, code, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert robot.count(old) == 1
    (tmp_path / "config").mkdir()
    (tmp_path / "package.xml").write_text(MANIFEST)
    srdf = f'<robot name="lift">\n{states}{"".join(PAIR.format(*pair) for pair in pairs)}</robot>'
    (tmp_path / "config" / "lift.srdf").write_text(srdf)
    (tmp_path / "lift.urdf").write_text(robot)
    assert lint(".", select=("J42", "M", "S")) == []
    (tmp_path / "lift.urdf").write_text(robot.replace(old, new))
    (found,) = lint(".", select=("J42", "M", "S"))
    assert (found.code, found.file) == (code, "lift.urdf")
    assert robot.splitlines()[found.line - 1].count(old) == 1
