"""Joints whose parent links the SRDF contradicts, and missing passive joints: one finding, at the mistake."""

from itertools import pairwise

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3"><name>loader</name><version>1.0.0</version><description>A loader.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license></package>"""
LINK = '<link name="{}"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>\n'
JOINT = """<joint name="{0}_joint" type="continuous"><parent link="{1}"/><child link="{0}"/><axis xyz="0 1 0"/>
  <origin xyz="{2} {3} 0"/></joint>
"""
WHEELS = (
    ("front_left", "base", 1, 1),
    ("front_right", "base", 1, -1),
    ("rear_left", "trailer", -1, 1),
    ("rear_right", "trailer", -1, -1),
)
ROBOT = f"""<robot name="loader">
{"".join(map(LINK.format, ("base", "trailer", *(wheel for wheel, *_ in WHEELS))))}
<joint name="hinge" type="continuous"><parent link="base"/><child link="trailer"/><origin xyz="-2 0 0"/>
  <axis xyz="0 0 1"/></joint>
{"".join(JOINT.format(*wheel) for wheel in WHEELS)}</robot>"""
PAIR = '<disable_collisions link1="{}" link2="{}" reason="Adjacent"/>\n'
PASSIVE = "".join(f'<passive_joint name="{wheel}_joint"/>\n' for wheel, *_ in WHEELS)
PAIRS = PAIR.format("base", "trailer") + "".join(PAIR.format(parent, wheel) for wheel, parent, *_ in WHEELS)
SRDF = f"""<robot name="loader">
<group name="hinge"><joint name="hinge"/></group>
{PASSIVE}{PAIRS}</robot>"""


@pytest.fixture
def found(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "config").mkdir()
    (tmp_path / "package.xml").write_text(MANIFEST)

    def findings(robot, srdf):
        (tmp_path / "loader.urdf").write_text(robot)
        (tmp_path / "config" / "loader.srdf").write_text(srdf)
        return [
            (each.code, each.file, each.line) for each in lint(".", select=("M102", "M104", "M105", "M107", "M110"))
        ]

    return findings


def test_a_wrong_parent_is_reported_at_the_joint_if_the_other_side_and_the_srdf_agree(found):
    assert not found(ROBOT, SRDF)
    wheel = 'parent link="trailer"/><child link="rear_left"'
    line = ROBOT[: ROBOT.index(wheel)].count("\n") + 1
    assert found(ROBOT.replace(wheel, wheel.replace("trailer", "base")), SRDF) == [("M110", "loader.urdf", line)]


def test_a_wrong_pair_is_reported_in_the_srdf(found):
    pair = PAIR.format("trailer", "rear_left")
    line = SRDF[: SRDF.index(pair)].count("\n") + 1
    wrong = SRDF.replace(pair, pair.replace("trailer", "base"))
    assert found(ROBOT, wrong) == [("M110", "config/loader.srdf", line)]


ARM = f"""<robot name="loader">
{"".join(map(LINK.format, ("base", "shoulder", "upper", "fore", "hand", "tip")))}
{JOINT.format("shoulder", "base", 0, 0)}{JOINT.format("upper", "shoulder", 1, 0)}{JOINT.format("fore", "upper", 1, 0)}
{JOINT.format("hand", "fore", 1, 0)}{JOINT.format("tip", "hand", 1, 0)}</robot>"""
CHAIN = ("base", "shoulder", "upper", "fore", "hand", "tip")
VALUES = "".join(f'<joint name="{link}_joint" value="0"/>' for link in CHAIN[1:])
SRDF_OF_ARM = f"""<robot name="loader">
<group name="arm"><chain base_link="base" tip_link="tip"/></group>
<group_state name="home" group="arm">{VALUES}</group_state>
{"".join(PAIR.format(*pair) for pair in pairwise(CHAIN))}</robot>"""


@pytest.mark.parametrize(("ear", "place"), [("", "loader.urdf"), ("ear", "config/loader.srdf")])
def test_a_parent_that_leaves_a_link_of_the_arm_without_children_is_reported_at_the_joint(ear, place, found):
    robot = (
        ARM.replace("</robot>", f'<link name="{ear}"/>' + JOINT.format(ear, "upper", 0, 1) + "</robot>") if ear else ARM
    )
    assert not found(robot, SRDF_OF_ARM)
    wrong = robot.replace('parent link="upper"/><child link="fore"', 'parent link="shoulder"/><child link="fore"')
    assert {file for _, file, _ in found(wrong, SRDF_OF_ARM)} == {place}
    assert len(found(wrong, SRDF_OF_ARM)) == 1


MESSAGE = "joint `{}_joint` has the parent link `{}`, but the SRDF disables the "
PAIR_OF_SRDF = "collisions of `{}` and `{}` as adjacent links, and "


def test_the_reasons_why_a_parent_is_wrong(found):
    wheel, part = 'parent link="trailer"/><child link="rear_left"', 'parent link="upper"/><child link="fore"'
    found(ROBOT.replace(wheel, wheel.replace("trailer", "base")), SRDF)
    [one] = lint(".", select=("M110",))
    pair = PAIR_OF_SRDF.format("trailer", "rear_left")
    reason = "joint `rear_right_joint` has the parent link `trailer` too"
    assert one.message == MESSAGE.format("rear_left", "base") + pair + reason
    found(ARM.replace(part, part.replace("upper", "shoulder")), SRDF_OF_ARM)
    [one] = lint(".", select=("M110",))
    pair = PAIR_OF_SRDF.format("upper", "fore")
    assert one.message == MESSAGE.format("fore", "shoulder") + pair + "`upper` carries no link"


def test_an_unknown_passive_joint_is_the_missing_counterpart(found):
    line = SRDF[: SRDF.index("rear_right_joint")].count("\n") + 1
    wrong = SRDF.replace("rear_right_joint", "rear_wheel_of_the_right_joint")
    assert found(ROBOT, wrong) == [("M104", "config/loader.srdf", line)]
    missing = SRDF.replace('<passive_joint name="rear_right_joint"/>\n', "")
    assert [code for code, *_ in found(ROBOT, missing)] == ["M105"]
