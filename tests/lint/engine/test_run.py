"""The engine: recovery, merging by place, selection, targets, third-party rules."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from urdfkit.errors import ModelError, ResourceError, UsageError
from urdfkit.lint import RULES, lint
from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import find_entries
from urdfkit.lint.project.options import Options

WHEEL = """<link name="base"/>
<xacro:macro name="tensor" params="c"><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="${c}"/></xacro:macro>
<xacro:macro name="wheel" params="side c">
  <link name="${side}">
    <inertial>
      <mass value="1"/>
      <xacro:tensor c="${c}"/>
    </inertial>
  </link>
  <joint name="${side}_joint" type="fixed"><parent link="base"/><child link="${side}"/></joint>
</xacro:macro>
<xacro:wheel side="left" c="3"/>
<xacro:wheel side="right" c="4"/>
<xacro:wheel side="middle" c="1"/>"""


def codes(findings) -> list[str]:
    return [finding.code for finding in findings]


def test_several_expansions_are_one_finding_at_the_definition(write):
    (finding,) = lint(write("r.xacro", WHEEL))
    assert (finding.code, finding.file, finding.line, finding.link) == ("I503", "r.xacro", 3, "left")
    assert "1.00 + 1.00 < 3.00" in finding.message
    assert [[call.macro for call in chain] for chain in finding.chains] == [["tensor", "wheel"], ["tensor", "wheel"]]
    assert [chain[1].position.line for chain in finding.chains] == [13, 14]
    calls = [(call["macro"], call["line"]) for call in finding.to_json()["expansions"]]
    assert calls == [("tensor", 8), ("wheel", 13), ("wheel", 14)]


def test_one_run_reports_everything(write):
    write("broken.xacro", '<robot><link name="a"></robot>')
    path = write(
        "r.xacro",
        """<xacro:include filename="broken.xacro"/>
<xacro:include filename="missing.xacro"/>
<property name="a" value="1"/>
<link name="base">
  <inertial><mass value="${b}"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="3"/></inertial>
</link>
<link name="arm"/>
<joint name="j"><parent link="base"/><child link="arm"/></joint>
<xacro:nothing/>""",
    )
    found = lint(path)
    # What is not defined may be in the file that is not there.
    assert sorted(codes(found)) == ["E001", "I503", "J401", "X101", "X113"]
    assert next(f for f in found if f.code == "E001").file == "broken.xacro"
    for_urdfkit = [f for f in lint(path, target="urdfkit") if f.code in ("X103", "X104")]
    assert [f.severity for f in for_urdfkit] == ["note", "note"]
    assert "may be defined in missing.xacro" in str(for_urdfkit[0].help)


def test_an_argument_may_be_declared_in_a_file_that_is_not_there(write):
    link = '<link name="$(arg prefix)base"/>'
    (alone,) = lint(write("alone.xacro", link))
    assert (alone.code, alone.severity) == ("X106", "error")
    include = '<xacro:include filename="missing.xacro"/>\n'
    assert codes(lint(write("r.xacro", f"{include}{link}"))) == ["X113"]
    declared = '<xacro:arg name="prefixes" default=""/>'
    found = lint(write("near.xacro", f"{include}{declared}{link}"))
    assert sorted((f.code, f.severity) for f in found) == [("X106", "note"), ("X113", "error")]
    assert "may be defined in missing.xacro" in next(f.help for f in found if f.code == "X106")


def test_what_a_fault_makes_up_is_not_reported(write):
    # The wheel is missing because of X103 only: neither T203 for its hub nor Z802 for its joint.
    path = write(
        "r.xacro",
        """<link name="base"/>
<xacro:whel/>
<link name="hub"/>
<gazebo><plugin name="p" filename="libgazebo_ros_diff_drive.so"><leftJoint>j</leftJoint></plugin></gazebo>""",
    )
    assert codes(lint(path)) == ["X103"]
    tensor = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
    bad = write("v.xacro", f'<link name="base"><inertial><mass value="${{m}}"/>{tensor}</inertial></link>')
    assert codes(lint(bad)) == ["X104"]


def test_a_part_of_a_robot_may_name_what_its_users_bring(write):
    text = """<robot name="part"><gazebo reference="base"><material>Gazebo/Red</material></gazebo>
<gazebo><plugin name="p" filename="libgazebo_ros_planar_move.so">
<robotBaseFrame>base</robotBaseFrame></plugin></gazebo>
<transmission name="t"><type>transmission_interface/SimpleTransmission</type>
<joint name="j"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
</transmission></robot>"""
    assert codes(lint(write("part.xacro", text))) == []
    whole = '<link name="trunk"/><xacro:include filename="part.xacro"/>'
    assert sorted(codes(lint(write("r.xacro", whole)))) == ["C701", "Z801", "Z803"]


def test_unprefixed_macros_are_looked_into_and_their_loss_is_named(write):
    path = write(
        "r.xacro",
        """<link name="base"/>
<macro name="wheel" params="side">
  <link name="${side}"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="3"/></inertial></link>
  <joint name="${side}_joint" type="fixed"><parent link="base"/><child link="${side}"/></joint>
</macro>
<wheel side="left"/>
<gazebo><plugin name="p" filename="libgazebo_ros_joint_state_publisher.so">
  <jointName>left_joint</jointName></plugin></gazebo>""",
    )
    found = lint(path)
    assert sorted(codes(found)) == ["I503", "X101", "X102", "Z802"]
    z802 = next(f for f in found if f.code == "Z802")
    assert z802.help == "add the prefix `xacro:` to `<wheel>` (r.xacro:8), which defines the joint"


def test_the_same_file_twice_is_reported_once(write):
    path = write("r.xacro", '<link name="a"/><link name="b"/>')
    assert codes(lint([path, path])) == ["T203"]


def test_a_fragment_of_two_models_is_reported_once(write):
    write("p/package.xml", "<package><name>p</name></package>")
    write("p/arm.xacro", '<robot><joint name="j"><parent link="a"/><child link="b"/></joint></robot>')
    for name in ("one", "two"):
        write(f"p/{name}.urdf.xacro", '<link name="a"/>\n<link name="b"/>\n<xacro:include filename="arm.xacro"/>')
    found = lint("p")
    assert [(f.code, f.file) for f in found] == [("J401", "p/arm.xacro")]
    # A fragment by itself is linted through the models that include it.
    assert [(f.code, f.file) for f in lint("p/arm.xacro")] == [("J401", "p/arm.xacro")]


def test_xacro_arguments_and_package_path(write):
    write("elsewhere/q/package.xml", "<package><name>q</name></package>")
    write("elsewhere/q/x.xacro", '<robot><link name="x"/></robot>')
    path = write("r.xacro", '<xacro:include filename="$(find q)/x.xacro"/><material name="$(arg colour)"/>')
    assert codes(lint(path)) == ["X113"]
    assert lint(path, arguments={"colour": "red"}, package_path=["elsewhere"]) == []


def test_selection(write):
    joint = '<joint name="j"><parent link="a"/><child link="b"/></joint>'
    path = write("r.xacro", f'<link name="a"/><link name="b"/><link name="c"/>{joint}')
    assert codes(lint(path)) == ["T203", "J401"]
    assert codes(lint(path, select=["T"])) == ["T203"]
    assert codes(lint(path, select=["J4,t203"])) == ["T203", "J401"]
    assert codes(lint(path, ignore=["J401"])) == ["T203"]
    assert codes(lint(path, select=["J401"], ignore=["J"])) == ["J401"]
    assert codes(lint(path, select=["J"], ignore=["J401"])) == []


@pytest.mark.parametrize(
    ("target", "note"),
    [
        ("gz", "C702 is not checked for gz; Z833 is checked only with --target urdfkit"),
        ("urdfkit", ""),
        (None, "Z833 is checked only with --target urdfkit"),
    ],
)
def test_selected_rules_that_do_not_apply_to_the_target_are_named(write, target, note):
    path = write("r.xacro", '<link name="a"/>')
    options = Options(select=("Z833", "C702", "J"), target=target)
    assert "; ".join(run(find_entries([path]), options).notes) == note


@pytest.mark.parametrize(
    ("option", "hint"), [({"select": ["I5033"]}, "did you mean `I503`"), ({"ignore": ["Q"]}, "urdf")]
)
def test_unknown_codes_are_refused(write, option, hint):
    with pytest.raises(UsageError, match=hint):
        lint(write("r.xacro", '<link name="a"/>'), **option)


def test_targets(write):
    joint = '<joint name="j" type="revolute"><parent link="a"/><child link="b"/></joint>'
    path = write("r.xacro", f'<link name="a"/><link name="b"/>{joint}')
    assert codes(lint(path, target="ros2")) == ["J403"]
    assert codes(lint(path, target="mujoco")) == ["I511"], "MuJoCo needs no limits, but masses"
    with pytest.raises(UsageError, match="did you mean `mujoco`"):
        lint(path, target="mujco")


def test_paths_that_are_not_there(write):
    write("arm.urdf", '<link name="a"/>')
    with pytest.raises(ResourceError, match=r"arm\.urd.*did you mean `arm\.urdf`"):
        lint("arm.urd")
    write("empty/readme.txt", b"nothing")
    with pytest.raises(ResourceError, match="no robot description"):
        lint("empty")


def test_another_kind_of_file_is_refused(write):
    with pytest.raises(ModelError, match=r"w\.urdf:1:1: <sdf> is not a robot description"):
        lint(write("w.urdf", b"<sdf version='1.6'/>"))


def test_parameters_of_third_party_plugins_are_checked(write, monkeypatch):
    write(
        "site/conveyors.py",
        b"""
from urdfkit.description.plugins import Parameter, PluginSpec

class Conveyor:
    specs = (PluginSpec("belt", "ros1", ("belt_drive",), (), (Parameter("joint", "joint", names="joint"),), "us"),)
""",
    )
    entry = b"[urdfkit.drives]\nbelt = conveyors:Conveyor\nbroken = no_such_module:Drive\n"
    write("site/conveyors-1.dist-info/entry_points.txt", entry)
    plugin = '<gazebo><plugin name="b" filename="libbelt_drive.so"><joint>rol</joint></plugin></gazebo>'
    joint = '<link name="b"/><joint name="roll" type="fixed"><parent link="a"/><child link="b"/></joint>'
    path = write("r.urdf", f'<robot name="r"><link name="a"/>{joint}{plugin}</robot>'.encode())
    assert lint(path, select=["Z802"]) == []
    monkeypatch.setattr(sys, "path", ["site", *sys.path])
    (finding,) = lint(path, select=["Z802"])
    assert "undefined joint `rol`" in finding.message


def test_third_party_rules_come_from_entry_points(write, monkeypatch):
    write(
        "lib/my_rules.py",
        b'''
from urdfkit.lint.rule import RobotRule

class NameTooShort(RobotRule):
    """A robot has a name of one letter."""

    code = "Q001"
    name = "name-too-short"
    severity = "warning"

    def check(self, model):
        if len(model.robot.name or "") < 2:
            yield self.at(model, model.robot.element, "the name is too short", attribute="name")
''',
    )
    write(
        "lib/my_rules-1.dist-info/entry_points.txt",
        b"[console_scripts]\na = b:c\n\n[urdfkit.rules]\nq = my_rules:NameTooShort\n",
    )
    monkeypatch.setattr(sys, "path", ["lib", *sys.path])
    path = write("r.xacro", '<link name="a"/>')
    (finding,) = lint(path)
    assert (finding.code, finding.severity, finding.line, finding.column) == ("Q001", "warning", 1, 8)
    assert lint(path, ignore=["Q001"]) == []
    write("lib/my_rules-1.dist-info/entry_points.txt", b"[urdfkit.rules]\nq = my_rulez:NameTooShort\n")
    with pytest.raises(ResourceError, match=r"my_rules-1\.dist-info: entry point q = my_rulez:NameTooShort: No module"):
        lint(path)


def test_the_tuple_is_what_the_engine_runs():
    from urdfkit.lint import rules

    layers = (*rules.source_rules(), *rules.fault_rules(), *rules.robot_rules(), *rules.suppression_rules())
    assert set(layers) == set(RULES)
    assert len(layers) == len(RULES)


def test_a_misspelt_parameter_is_one_finding_and_its_default_is_called_one(write):
    sides = "".join(
        f'<link name="{side}"/><joint name="{side}_joint" type="continuous"><parent link="a"/><child link="{side}"/>'
        f'<origin xyz="0 {y} 0"/><axis xyz="0 1 0"/></joint>'
        for side, y in (("left", 0.15), ("right", -0.15))
    )
    plugin = (
        '<gazebo><plugin name="d" filename="libgazebo_ros_diff_drive.so"><leftJoint>left_joint</leftJoint>'
        "<rightJoint>right_joint</rightJoint>{}<wheelDiameter>0.15</wheelDiameter>"
        "</plugin></gazebo>"
    )

    def found(written):
        path = write("r.urdf", f'<link name="a"/>{sides}{plugin.format(written)}')
        return [(f.code, f.message) for f in lint(path, select=("S", "Z"))]

    (only,) = found("<wheelSeperation>0.3</wheelSeperation>")
    assert only[0] == "Z805"
    assert {code for code, _ in found("<wheel_separation>0.3</wheel_separation>")} == {"Z806"}
    (default,) = found("")
    assert default == (
        "S901",
        "<wheelSeparation> is 0.34 m by default, but `left_joint` and `right_joint` are 0.3 m apart",
    )


def test_a_link_to_nowhere_is_passed_over(tmp_path):
    (tmp_path / "bad.urdf").write_text('<robot name="r"><link name="a"/><link name="b"/></robot>')
    (tmp_path / ".#bad.urdf").symlink_to("somebody@somewhere.1234")
    assert [entry.path.name for entry in find_entries([tmp_path])] == ["bad.urdf"]


def test_a_robot_whose_first_line_is_gone_is_still_one(tmp_path):
    (tmp_path / "good.urdf").write_text('<robot name="g"><link name="a"/></robot>')
    (tmp_path / "part.xacro").write_text('<config><link name="a"/></config>')
    (tmp_path / "r.urdf.xacro").write_text('<?xml version="1.0"?>\n<link name="a"/>\n</robot>\n')
    assert [entry.path.name for entry in find_entries([tmp_path])] == ["good.urdf", "r.urdf.xacro"]
    assert "E001" in codes(lint(tmp_path))


XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


def test_each_of_two_malformed_files_is_reported(tmp_path):
    include = '<xacro:include filename="wheel.xacro"/>'
    (tmp_path / "r.urdf.xacro").write_text(f'<robot name="r" {XACRO}>\n<link name="a">\n{include}\n</robot>')
    wheel = tmp_path / "wheel.xacro"
    wheel.write_text(f"<robot {XACRO}><xacro:macro name='m'><lnk></xacro:macro></robot>")
    broken = [(Path(f.file).name, f.code) for f in lint(tmp_path)]
    assert sorted(broken) == [("r.urdf.xacro", "E001"), ("wheel.xacro", "E001")]
    wheel.write_text(f"<robot {XACRO}><xacro:macro name='m'><link name='${{b}}'/></xacro:macro></robot>")
    assert [(Path(f.file).name, f.code) for f in lint(tmp_path)] == [("r.urdf.xacro", "E001")]


def test_a_file_of_macros_is_part_of_its_robot_though_its_root_has_a_name(tmp_path):
    (tmp_path / "package.xml").write_text("<package><name>p</name></package>")
    include = '<xacro:include filename="wheel.xacro"/><xacro:wheel side="left"/>'
    (tmp_path / "r.urdf.xacro").write_text(f'<robot name="r" {XACRO}>{include}</robot>')
    wheel = tmp_path / "wheel.xacro"
    macro = '<xacro:macro name="wheel" params="side"><link name="${x}"/></xacro:macro>'
    wheel.write_text(f'<robot name="wheel" {XACRO}>{macro}</robot>')
    assert [entry.path.name for entry in find_entries([wheel])] == ["r.urdf.xacro"]
    assert [(Path(f.file).name, f.code) for f in lint(wheel)] == [("wheel.xacro", "X104")]
    wheel.write_text(f'<robot name="wheel" {XACRO}>{macro}<link name="a"/></robot>')
    assert [entry.path.name for entry in find_entries([wheel])] == ["wheel.xacro"]


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_progress_is_told_after_each_file(write, monkeypatch, jobs):
    monkeypatch.setattr("urdfkit.lint.engine.run._MIN_PARALLEL", 2)
    for number in range(3):
        write(f"{number}.urdf", f'<robot name="r{number}"><link name="a"/></robot>')
    told = []
    run(find_entries(["."]), Options(), jobs=jobs, progress=lambda *numbers: told.append(numbers))
    assert told == [(1, 3), (2, 3), (3, 3)]
