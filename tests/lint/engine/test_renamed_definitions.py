"""Names that differ between a definition and its uses: one finding, at the side whose name no other place has."""

import pytest

from urdfkit.lint import lint

ROBOT = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="wheel_radius" value="0.1"/>
  <xacro:macro name="tyre" params="name side">
    <link name="${name}_wheel">
      <inertial><mass value="1"/><inertia ixx="1e-2" iyy="1e-2" izz="1e-2" ixy="0" ixz="0" iyz="0"/></inertial>
      <collision><geometry><sphere radius="${wheel_radius}"/></geometry></collision>
    </link>
    <joint name="${name}_wheel_joint" type="continuous">
      <parent link="base"/><child link="${name}_wheel"/><origin xyz="0 ${side * 0.2} 0"/><axis xyz="0 1 0"/>
    </joint>
  </xacro:macro>
  <link name="base">
    <inertial><mass value="1"/><inertia ixx="1e-2" iyy="1e-2" izz="1e-2" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision>
  </link>
  <xacro:tyre name="left" side="1"/>
  <xacro:tyre name="right" side="-1"/>
  <link name="mast"/>
  <joint name="mast_joint" type="fixed"><parent link="base"/><child link="mast"/><origin xyz="0 0 0.3"/></joint>
  <link name="camera"/>
  <joint name="camera_joint" type="fixed">
    <parent link="mast"/>
    <child link="camera"/><origin xyz="${wheel_radius} 0 0.1"/></joint>
  <ros2_control name="cart" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <joint name="left_wheel_joint"><command_interface name="velocity"/></joint>
    <joint name="right_wheel_joint"><command_interface name="velocity"/></joint>
  </ros2_control>
</robot>
"""


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ('<link name="mast"', '<link name="mats"', 18),
        ('child link="mast"', 'child link="mats"', 19),
        ('parent link="mast"', 'parent link="mats"', 22),
        ('<link name="camera"', '<link name="camrea"', 20),
        ('child link="camera"', 'child link="camrea"', 23),
        ('<joint name="${name}_wheel_joint"', '<joint name="${name}_wheel_jiont"', 8),
        ('<joint name="right_wheel_joint"', '<joint name="right_wheel_jiont"', 27),
        ('property name="wheel_radius"', 'property name="weel_radius"', 2),
        ("${wheel_radius} 0 0.1", "${weel_radius} 0 0.1", 23),
        ('macro name="tyre"', 'macro name="tire"', 3),
        ('<xacro:tyre name="right"', '<xacro:tire name="right"', 17),
        ('params="name side"', 'params="name sied"', 3),
        ('side="-1"', 'sied="-1"', 17),
        ("${side * 0.2}", "${sied * 0.2}", 9),
    ],
)
def test_a_renamed_definition_is_one_finding_there_and_a_misspelt_use_at_the_use(old, new, line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert ROBOT.count(old) == 1
    (tmp_path / "cart.urdf.xacro").write_text(ROBOT)
    assert lint("cart.urdf.xacro", ignore=("G", "I510")) == []
    (tmp_path / "cart.urdf.xacro").write_text(ROBOT.replace(old, new))
    assert [each.line for each in lint("cart.urdf.xacro", ignore=("G", "I510"))] == [line]


PREFIXED = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="tool" value="grip"/>
  <xacro:macro name="joint" params="prefix">
    <link name="${prefix}elbow"/>
    <joint name="${prefix}elbow_joint" type="fixed">
      <parent link="base"/><child link="${prefix}elbow"/><origin xyz="0 0 ${0.3 if prefix else 0.1}"/>
    </joint>
    <link name="${prefix}${tool}_finger"/>
    <joint name="${prefix}${tool}_joint" type="fixed">
      <parent link="${prefix}elbow"/><child link="${prefix}${tool}_finger"/><origin xyz="0.1 0 0"/>
    </joint>
  </xacro:macro>
  <xacro:macro name="arm" params="side"><xacro:joint prefix="${side}"/></xacro:macro>
  <link name="base"/>
  <xacro:arm side="left_"/>
  <xacro:joint prefix="right_"/>
  <link name="left_tip"/><link name="right_tip"/>
  <joint name="left_tip_joint" type="fixed">
    <parent link="left_grip_finger"/><child link="left_tip"/><origin xyz="0.1 0 0"/></joint>
  <joint name="right_tip_joint" type="fixed">
    <parent link="right_grip_finger"/><child link="right_tip"/><origin xyz="0.1 0 0"/></joint>
  <gazebo reference="left_elbow"><mu1>1</mu1></gazebo>
  <gazebo reference="right_elbow"><mu1>1</mu1></gazebo>
</robot>
"""


@pytest.mark.parametrize(
    ("old", "new", "lines"),
    [
        ('prefix="right_"', 'prefix="right"', [16]),
        ('prefix="right_"', 'prefix="rigth_"', [16]),
        ('prefix="right_"', 'prefix=""', [16]),
        ('side="left_"', 'side="left"', [15]),  # which a macro hands on
        ('reference="right_elbow"', 'reference="rightelbow"', [23]),
    ],
)
def test_a_wrong_prefix_is_one_finding_at_the_macro_call(old, new, lines, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf.xacro").write_text(PREFIXED)
    assert lint("arm.urdf.xacro", select=("T20", "Z80")) == []
    (tmp_path / "arm.urdf.xacro").write_text(PREFIXED.replace(old, new))
    assert [each.line for each in lint("arm.urdf.xacro", select=("T20", "Z80"))] == lines


@pytest.mark.parametrize("is_in_two_files", [False, True])
def test_a_property_that_two_files_use_under_another_name_is_renamed(is_in_two_files, tmp_path, monkeypatch):
    """The word that only the definition has occurs in other names, too, as after a slip in each use."""
    monkeypatch.chdir(tmp_path)
    head = '<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    link = '<link name="{}"><visual><geometry><sphere radius="${{max_steer}}"/></geometry></visual></link>\n'
    joint = '<joint name="steering" type="fixed"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/></joint>'
    (tmp_path / "part.xacro").write_text(f"{head}\n{link.format('b')}</robot>\n")
    other = '<xacro:include filename="part.xacro"/>' if is_in_two_files else link.format("b").strip()
    text = f'{head}\n<xacro:property name="max_steering" value="0.6"/>\n{link.format("a")}{other}\n{joint}\n</robot>\n'
    (tmp_path / "cart.urdf.xacro").write_text(text)
    found = lint("cart.urdf.xacro", select=["X104"])
    assert [each.line for each in found] == ([2] if is_in_two_files else [3])


def test_a_wrong_property_in_names_is_one_finding_there(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf.xacro").write_text(PREFIXED.replace('value="grip"', 'value="gripp"'))
    (found,) = lint("arm.urdf.xacro", select=("T20", "Z80"))
    assert (found.line, len(found.related)) == (2, 2)
    assert found.message == (
        'no other place uses names with value="gripp"; did you mean "grip", '
        "as in `left_grip_finger`, which is used but undefined?"
    )


def test_a_prefix_that_a_place_uses_is_right(tmp_path, monkeypatch):
    """Two of three places have another name, so they are wrong."""
    monkeypatch.chdir(tmp_path)
    text = PREFIXED.replace('prefix="right_"', 'prefix="r_"')
    text = text.replace("</robot>", '<gazebo reference="r_elbow"><mu2>1</mu2></gazebo></robot>')
    (tmp_path / "arm.urdf.xacro").write_text(text)
    assert 16 not in [each.line for each in lint("arm.urdf.xacro", select=("T20", "Z80"))]


def test_the_same_slip_in_two_uses_is_reported_there(tmp_path, monkeypatch):
    """Other names have the word of the defined name, and none that of its uses."""
    monkeypatch.chdir(tmp_path)
    text = """<robot name="cart"><link name="base"/>
<link name="left_wheel"/><link name="right_wheel"/>
<joint name="a" type="fixed"><parent link="base"/><child link="left_weel"/></joint>
<joint name="b" type="fixed"><parent link="base"/><child link="right_wheel"/></joint>
<gazebo reference="left_weel"><mu1>1</mu1></gazebo></robot>"""
    (tmp_path / "cart.urdf").write_text(text)
    found = [(each.code, each.line) for each in lint("cart.urdf", select=("T", "Z80"))]
    assert ("T202", 3) in found
    assert [each for each in found if each == ("T202", 2)] == []
