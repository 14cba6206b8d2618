# ruff: noqa: E501 - one case a line
from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description import load
from urdfkit.description.loading import load_repaired
from urdfkit.errors import ModelError, ResourceError, UrdfkitError, XacroError, XmlError

Write = Callable[[str, str], Path]


def model(*parts: str) -> str:
    return "<robot name='r'>\n" + "\n".join(parts) + "\n</robot>"


def links(*names: str) -> str:
    return "".join(f'<link name="{name}"/>' for name in names)


def joint(name: str, parent: str, child: str, kind: str = "fixed", inside: str = "") -> str:
    return f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>'


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        (model(), "1:1", "the robot has no link"),
        (model(links("a", "b", "c"), joint("j", "a", "b")), "2:33", "2 root links: `c` has no parent joint; a joint to the tree of `a` (m.urdf:2:1) is missing"),
        (model(links("a", "b", "c", "d")), "2:17", "4 root links: `b`, `c`, `d` have no parent joint"),
        (model(links("a", "b"), joint("j", "a", "b"), joint("k", "b", "a")), "4:1", "the joints form a loop: b → a → b"),
        (model(links("r", "a", "b"), joint("j", "a", "b"), joint("k", "b", "a")), "4:1", "loop"),
        (model(links("a"), joint("j", "a", "a")), "3:30", "joint `j` connects link `a` with itself"),
        (model(links("a", "b", "c"), joint("j", "a", "c"), joint("k", "b", "c")), "4:48", "link `c` is the child of two joints, `j` (m.urdf:3:1) and `k`"),
        (model(links("a", "a")), "2:17", "two links are named `a`; the first is at m.urdf:2:1"),
        (model(links("a", "b", "c"), joint("j", "a", "b"), joint("j", "a", "c")), "4:1", "two joints are named `j`"),
        (model(links("base_link", "b"), joint("j", "base_lnk", "b")), "3:30", "its parent link `base_lnk` does not exist; did you mean `base_link`?"),
        (model(links("a", "arm"), joint("j", "a", "amr")), "3:48", "its child link `amr` does not exist; did you mean `arm`?"),
        (model(links("a", "b"), joint("j", "a", "b").replace('type="fixed"', "")), "3:1", "joint `j`: missing attribute `type`"),
        (model(links("a", "b"), joint("j", "a", "b", "Revolute")), "3:1", "joint `j`: unknown type `Revolute`; did you mean `revolute`?"),
        (model(links("a", "b"), joint("j", "a", "b", "revolute")), "3:1", "revolute joint `j` lacks <limit"),
        (model(links("a", "b"), joint("j", "a", "b", "prismatic")), "3:1", "prismatic joint `j` lacks <limit"),
        (model(links("a", "b"), joint("j", "a", "b", "revolute", '<limit lower="0" upper="1"/>')), "3:68", "joint `j`: <limit> has no attribute `effort`"),
        (model(links("a", "b"), joint("j", "a", "b", "continuous", '<axis xyz="0 0 0"/>')), "3:70", "the axis of joint `j` is zero"),
        (model(links("a", "b"), joint("j", "a", "b", "continuous", '<mimic joint="k"/>')), "3:70", "mimics the unknown joint `k`"),
        (model(links("a"), '<link name="b"><inertial><mass value="1,5"/></inertial></link>'), "3:26", "link `b`: value of <mass>: `1,5` is not a number (write a decimal point instead of the comma)"),
        (model("<link/>"), "2:1", "a <link> has no name"),
        (model('<xacro:wheel side="left"/>'), "1:1", "rename it to .urdf.xacro"),
        ("<sdf version='1.6'/>", "1:1", "this is an SDF file"),
        ("<mujoco/>", "1:1", "this is an MJCF file"),
        ("<Robot/>", "1:1", "the root element is <Robot>, not <robot>; did you mean `robot`?"),
    ],
)  # fmt: skip
def test_one_error_with_its_place(write: Write, text: str, place: str, message: str) -> None:
    path = write("m.urdf", text)
    with pytest.raises(ModelError) as caught:
        load(path)
    line = str(caught.value)
    assert line.startswith(f"m.urdf:{place}: ")
    assert message in line
    assert "\n" not in line


def test_the_most_important_error_comes_first(write: Write) -> None:
    path = write(
        "m.urdf",
        model(
            links("a", "a", "z"),
            joint("j", "nope", "a", "hinge"),
            '<link name="b"><inertial><mass value="?"/></inertial></link>',
        ),
    )
    with pytest.raises(ModelError, match="unknown type `hinge`"):
        load(path)
    path.write_text(path.read_text().replace("hinge", "fixed"))
    with pytest.raises(ModelError, match=re.escape("`?` is not a number")):
        load(path)
    path.write_text(path.read_text().replace('"?"', '"1"').replace("<inertial>", "<!--").replace("</inertial>", "-->"))
    with pytest.raises(ModelError, match="two links are named `a`"):
        load(path)


def test_an_error_in_a_macro_names_the_call(write: Write) -> None:
    path = write(
        "m.xacro",
        'HEAD<link name="a"/><xacro:macro name="arm" params="n">\n<link name="l"/></xacro:macro>\n'
        '<xacro:arm n="1"/>\n<xacro:arm n="2"/></robot>',
    )
    with pytest.raises(ModelError) as caught:
        load(path)
    assert str(caught.value) == (
        "m.xacro:2:1: two links are named `l`; the first is at m.xacro:2:1 (in `arm` called at m.xacro:4:1)"
    )


@pytest.mark.parametrize(
    ("name", "text", "kind", "message"),
    [
        ("none.urdf", None, ResourceError, "no such file or folder: none.urdf; did you mean `one.urdf`?"),
        ("none/x.xacro", None, ResourceError, "no such file or folder: none/x.xacro"),
        ("empty", None, ResourceError, "no robot, file or folder `empty`"),
        ("m.urdf", "", XmlError, "m.urdf:1:1: the file is empty"),
        ("m.urdf", "not xml", XmlError, "m.urdf:1:1: this is not XML"),
        ("m.xacro", 'HEAD<xacro:foo/></robot>', XacroError, "macro `foo` is not defined"),
    ],
)  # fmt: skip
def test_what_cannot_be_read(write: Write, name: str, text: str | None, kind: type[UrdfkitError], message: str) -> None:
    write("one.urdf", model(links("a")))
    with pytest.raises(kind) as caught:
        load(write(name, text) if text is not None else name)
    assert message in str(caught.value)


def test_a_loaded_robot_knows_its_files_and_packages(write: Write, tmp_path: Path) -> None:
    write("p/package.xml", "<package><name>p</name></package>")
    write("p/meshes/a.stl", "")
    write("p/urdf/part.xacro", 'HEAD<link name="a"/></robot>')
    robot = load(write("p/urdf/m.xacro", 'HEAD<xacro:include filename="part.xacro"/></robot>'))
    assert robot.files == (tmp_path / "p/urdf/m.xacro", tmp_path / "p/urdf/part.xacro")
    assert robot.packages is not None
    assert robot.packages.resolve("package://p/meshes/a.stl", robot.files[0]) == tmp_path / "p/meshes/a.stl"


def test_arguments_and_package_path(write: Write) -> None:
    write("lib/q/package.xml", "<package><name>q</name></package>")
    write("lib/q/part.xacro", 'HEAD<link name="$(arg name)"/></robot>')
    path = write("m.xacro", 'HEAD<xacro:include filename="$(find q)/part.xacro"/></robot>')
    assert load(path, arguments={"name": "x"}, package_path=["lib"]).links[0].name == "x"
    with pytest.raises(XacroError, match="argument `name` has no value"):
        load(path, package_path=["lib"])


def test_harmless_problems_do_not_stop_loading(write: Write) -> None:
    robot = load(write("m.urdf", model('<link name="a"><visual/><inertial/></link>')))
    assert {problem.kind for problem in robot.problems} == {"missing"}


def test_a_reduction_nobody_reads_may_be_no_number(tmp_path: Path) -> None:
    model = tmp_path / "arm.urdf"
    model.write_text(
        '<robot name="arm"><link name="base"/><transmission name="t"><type>SimpleTransmission</type>'
        '<actuator name="motor"><mechanicalReduction>one</mechanicalReduction></actuator></transmission></robot>'
    )
    assert len(load(model).problems) == 1


@pytest.mark.parametrize("before", ["\n\n", "<!-- made by hand -->\n", " "])
@pytest.mark.parametrize("name", ["m.urdf", "m.urdf.xacro"])
def test_a_declaration_after_blank_text_or_comments_is_left_out(write: Write, before: str, name: str) -> None:
    path = write(name, f"{before}<?xml version='1.0'?>\n{model(links('a'))}")
    with pytest.raises(XmlError, match="very start"):
        load(path)
    robot = load_repaired(path)
    repair, *others = robot.repairs
    assert (repair.code, str(repair.position)) == (
        "E001",
        f"{name}:{before.count(chr(10)) + 1}:{len(before.rpartition(chr(10))[2]) + 1}",
    )
    assert [link.name for link in robot.links] == ["a"]
    assert others == []
    assert robot.links[0].element.origin.position.line == before.count("\n") + 3


def test_a_declaration_after_an_element_stays_an_error(write: Write) -> None:
    with pytest.raises(XmlError, match="very start"):
        load_repaired(write("m.urdf", "<robot name='r'><?xml version='1.0'?><link name='a'/></robot>"))
