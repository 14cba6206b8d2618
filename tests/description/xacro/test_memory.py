"""Elements that an edit does not change are the same objects in the next expansion."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tests.robot_content import content
from urdfkit.description.urdf.parser import parse
from urdfkit.description.xacro.expand import expand_leniently
from urdfkit.description.xacro.memory import Memory
from urdfkit.description.xml.element import Element

TWO = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="size" value="0.1"/>
  <xacro:macro name="part" params="n *block">
    <link name="${n}">
      <inertial><mass value="1.0"/></inertial>
      <visual><origin xyz="0 0 0"/><geometry><box size="${size} ${size/2} 1"/></geometry></visual>
      <xacro:insert_block name="block"/><xacro:insert_block name="block"/>
    </link>
    <link name="${n}_b">
      <inertial><mass value="2.0"/></inertial>
      <visual><geometry><box size="${size} ${size/2} 1"/></geometry></visual>
    </link>
    <joint name="${n}_joint" type="fixed"><parent link="${n}"/><child link="${n}_b"/></joint>
  </xacro:macro>
  <xacro:part n="a"><collision><geometry><box size="${size} 1 1"/></geometry></collision></xacro:part>
  <xacro:part n="c"><collision><geometry><box size="${size} 1 1"/></geometry></collision></xacro:part>
</robot>
"""


def expanded(path: Path, text: str, memory: Memory | None = None) -> Element:
    root = expand_leniently(path, texts={str(path): text}, memory=memory).root
    assert root is not None
    return root


def shown(root: Element) -> list[Any]:
    return [(one.tag, one.attributes, one.text, one.origin) for one in root.walk()]


def test_an_edit_in_a_macro_keeps_the_elements_that_it_does_not_change(tmp_path: Path) -> None:
    path = tmp_path / "r.xacro"
    path.write_text(TWO)
    memory = Memory()
    before = expanded(path, TWO, memory)
    for mass in ("2.5", "2.6"):
        text = TWO.replace('mass value="2.0"', f'mass value="{mass}"')
        after = expanded(path, text, memory)
        assert shown(after) == shown(expanded(path, text))
        is_same = [a is b for a, b in zip(before.children, after.children, strict=True)]
        assert is_same == [True, False, True, True, False, True]
        visuals = [(root.children[1].find("visual"), root.children[4].find("visual")) for root in (before, after)]
        assert visuals[0][0] is visuals[1][0]
        assert visuals[0][1] is visuals[1][1]
        assert visuals[0][0] is not visuals[0][1]
        before = after


def test_equal_parts_of_a_robot_are_not_read_again(tmp_path: Path) -> None:
    path = tmp_path / "r.xacro"
    path.write_text(TWO)
    memory = Memory()
    robots = []
    for mass in ("2.1", "2.2", "2.3"):
        text = TWO.replace('mass value="2.0"', f'mass value="{mass}"')
        root = expanded(path, text, memory)
        robots.append(parse(root, cached_parts=memory.parts))
        assert content(robots[-1]) == content(parse(expanded(path, text)))
    one, other = robots[1], robots[2]
    assert [a is b for a, b in zip(one.links, other.links, strict=True)] == [True, False, True, False]
    assert one.joints[0] is other.joints[0]
    assert one.links[1].visuals[0] is other.links[1].visuals[0]


def test_problems_of_parts_have_the_current_name_of_the_link(tmp_path: Path) -> None:
    path = tmp_path / "r.xacro"
    bad = TWO.replace("1.0", "heavy")
    path.write_text(bad)
    memory = Memory()
    for name in ("a", "k", "kk"):
        text = bad.replace('n="a"', f'n="{name}"')
        found = [one.message for one in parse(expanded(path, text, memory), cached_parts=memory.parts).problems]
        assert found == [one.message for one in parse(expanded(path, text)).problems]
        assert f"link `{name}`: value of <mass>: `heavy` is not a number" in found


def test_a_block_that_is_inserted_twice_makes_two_elements(tmp_path: Path) -> None:
    path = tmp_path / "r.xacro"
    twice = TWO.replace('n="a">', 'n="a"><!-- x -->').replace(
        '<xacro:insert_block name="block"/><xacro:insert_block name="block"/>',
        '<xacro:property name="b"><k><v w="${n}"/></k></xacro:property>'
        '<xacro:insert_block name="b"/><xacro:insert_block name="b"/><xacro:insert_block name="block"/>',
    )
    path.write_text(twice)
    memory = Memory()
    for _ in range(3):
        root = expanded(path, twice, memory)
        assert shown(root) == shown(expanded(path, twice))
        made = [one for one in root.walk() if one.tag == "v"]
        assert len({id(one) for one in made}) == len(made) == 4


def test_values_of_different_types_make_different_texts(tmp_path: Path) -> None:
    calls = ("1", "1.0", "true", "-0.0", "0.0", "${1}", "${True}", "'1'", "")
    body = '<xacro:macro name="m" params="v"><link name="a${v}"><visual k="${v}"/></link></xacro:macro>'
    made = "".join(f'\n<xacro:m v="{value}"/>' for value in calls)
    path = tmp_path / "r.xacro"
    path.write_text(f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">{body}{made}</robot>')
    names = [link.get("name") for link in expanded(path, path.read_text()).children]
    assert names == ["a1", "a1.0", "aTrue", "a-0.0", "a0.0", "a1", "aTrue", "a1", "a"]
