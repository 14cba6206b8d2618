"""``urdfkit lsp``: renaming names that macros and properties compose, and names in RViz and SRDF files."""

from __future__ import annotations

import pytest

from tests.lsp.test_lsp import ROBOT, WHEEL, applied, cart

__all__ = ["cart"]

ARM = """<robot name="arm" xmlns:xacro="http://ros.org/xacro">
  <xacro:property name="root" value="base_link"/>
  <xacro:macro name="segment" params="name parent">
    <link name="${name}_link"/>
    <joint name="${name}_joint" type="fixed">
      <parent link="${parent}"/>
      <child link="${name}_link"/>
    </joint>
  </xacro:macro>
  <xacro:macro name="arm" params="prefix on:=base_link">
    <xacro:segment name="${prefix}upper" parent="${on}"/>
    <xacro:segment name="${prefix}fore" parent="${prefix}upper_link"/>
  </xacro:macro>
  <link name="${root}"/>
  <xacro:arm prefix="left_"/>
  <xacro:arm prefix="right_" on="base_link"/>
  <xacro:macro name="tool" params="kind">
    <link name="${kind}">
      <visual><geometry><mesh filename="package://p/${kind}.stl"/></geometry></visual>
    </link>
    <joint name="tool_joint" type="fixed"><parent link="left_fore_link"/><child link="${kind}"/></joint>
    <xacro:if value="${kind == 'gripper'}"><link name="finger"/></xacro:if>
  </xacro:macro>
  TOOL
</robot>
"""
PLAIN = ARM.replace("TOOL", "")

RVIZ = """Visualization Manager:
  Displays:
    - Class: rviz_default_plugins/RobotModel
      Links:
        All Links Enabled: true
        base_link:
          Alpha: 1
        left_upper_link: {Alpha: 1}
      Name: base_link
    - Class: rviz_default_plugins/TF
      Frames:
        base_link:
          Value: true
      Tree:
        base_link:
          left_upper_link:
            {}
      Reference Frame: <Fixed Frame>
  Global Options:
    Fixed Frame: base_link
  Views:
    Current:
      Target Frame: "left_upper_link"
      Name: base_link
"""
SRDF = """<robot name="arm">
  <group name="base_link"><chain base_link="base_link" tip_link="left_fore_link"/></group>
  <disable_collisions link1="base_link" link2="left_upper_link" reason="Adjacent"/>
  <passive_joint name="left_upper_joint"/>
</robot>
"""


def renamed(client, text: str, mark: str, name: str, file: str = "arm.urdf.xacro") -> dict[str, str]:
    """Return the texts of arm.urdf.xacro, arm.rviz and arm.srdf after a rename."""
    client.close_all()
    for other in client.folder.glob("*.*"):
        other.unlink()
    files = {file: text, "arm.rviz": RVIZ, "arm.srdf": SRDF, "package.xml": "<package><name>p</name></package>"}
    for path, content in files.items():
        (client.folder / path).write_text(content)
    client.tell("workspace/didChangeWatchedFiles", {"changes": []})
    client.open(file)
    at = client.at(file, text, mark)
    prepared = client.ask("textDocument/prepareRename", at)
    changes = client.ask("textDocument/rename", {**at, "newName": name})["changes"]
    assert prepared is not None
    return {path: applied(content, changes.get(client.uri(path), [])) for path, content in files.items()}


@pytest.mark.parametrize(
    ("mark", "name", "replaced"),
    [
        ('side="le|ft"', "front", [('side="left"', 'side="front"'), (">left_joint<", ">front_joint<")]),
        ("<leftJoint>left|_joint<", "front_joint", [('side="left"', 'side="front"'), (">left_j", ">front_j")]),
        ("<rightJoint>right|_joint<", "right_axle", [("left_joint", "left_axle"), ("right_joint", "right_axle")]),
    ],
)
def test_a_literal_at_the_call_of_a_macro_is_renamed(cart, mark, name, replaced):
    at = cart.at("cart.urdf.xacro", ROBOT, mark)
    assert cart.ask("textDocument/prepareRename", at) is not None
    changes = cart.ask("textDocument/rename", {**at, "newName": name})["changes"]
    wanted = ROBOT
    for old, new in replaced:
        wanted = wanted.replace(old, new)
    assert applied(ROBOT, changes[cart.uri("cart.urdf.xacro")]) == wanted
    macro = WHEEL.replace("${side}_joint", "${side}_axle") if name == "right_axle" else WHEEL
    assert applied(WHEEL, changes.get(cart.uri("wheel.xacro"), [])) == macro


def test_a_parameter_is_renamed_with_its_arguments(cart):
    at = cart.at("wheel.xacro", WHEEL, 'name="${si|de}_wheel"')
    prepared = cart.ask("textDocument/prepareRename", at)
    assert prepared["placeholder"] == "side"
    changes = cart.ask("textDocument/rename", {**at, "newName": "where"})["changes"]
    assert applied(WHEEL, changes[cart.uri("wheel.xacro")]) == WHEEL.replace("side", "where")
    assert applied(ROBOT, changes[cart.uri("cart.urdf.xacro")]) == ROBOT.replace(" side=", " where=")


def test_a_parameter_is_not_renamed_to_a_property_that_its_macro_reads(client):
    text = """<robot name="arm" xmlns:xacro="http://ros.org/xacro">
  <xacro:property name="base" value="base_link"/>
  <xacro:macro name="tool" params="kind"><link name="${kind}_of_${base}"/></xacro:macro>
  <xacro:tool kind="gripper"/>
</robot>
"""
    assert 'params="type"' in renamed(client, text, 'params="ki|nd"', "type")["arm.urdf.xacro"]
    with pytest.raises(AssertionError) as caught:
        renamed(client, text, 'params="ki|nd"', "base")
    assert "renaming the parameter `kind` to `base` changes the robot: rename it manually" in str(caught.value)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mark", "name", "replaced"),
    [
        (
            'value="base|_link"',
            "trunk",
            [('value="base_link"', 'value="trunk"'), ("on:=base_link", "on:=trunk"), ('on="base_link"', 'on="trunk"')],
        ),
        (
            'on="base|_link"',
            "trunk",
            [('value="base_link"', 'value="trunk"'), ("on:=base_link", "on:=trunk"), ('on="base_link"', 'on="trunk"')],
        ),
    ],
)
def test_a_name_is_traced_through_properties_defaults_and_nested_calls(client, mark, name, replaced):
    found = renamed(client, PLAIN, mark, name)
    wanted = PLAIN
    for old, new in replaced:
        wanted = wanted.replace(old, new)
    assert found["arm.urdf.xacro"] == wanted
    assert found["arm.rviz"] == RVIZ.replace("base_link", name).replace(f"Name: {name}", "Name: base_link")
    assert found["arm.srdf"] == SRDF.replace('base_link="base_link"', f'base_link="{name}"').replace(
        'link1="base_link"', f'link1="{name}"'
    )


@pytest.mark.slow
def test_a_part_of_a_name_renames_all_names_with_that_part(client):
    found = renamed(client, PLAIN, 'prefix="le|ft_"', "port_")
    assert found["arm.urdf.xacro"] == PLAIN.replace('prefix="left_"', 'prefix="port_"')
    assert found["arm.rviz"] == RVIZ.replace("left_", "port_")
    assert found["arm.srdf"] == SRDF.replace("left_", "port_")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "message"),
    [
        ("pen", "`filename` of <mesh> at arm.urdf.xacro:19 depends on the name"),
        ("gripper", "depends on the name: rename it manually"),
    ],
)
def test_a_name_that_decides_more_than_names_is_refused(client, kind, message):
    with pytest.raises(AssertionError) as caught:
        renamed(client, ARM.replace("TOOL", f'<xacro:tool kind="{kind}"/>'), f'kind="{kind[0]}|{kind[1:]}"', "other")
    assert message in str(caught.value)
