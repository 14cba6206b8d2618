"""Parameters with their places, launch files, and where the controllers of a ROS 1 robot are found."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description import load
from urdfkit.description.control import Settings, find_configuration, node_settings, read_settings
from urdfkit.description.control.parameter_yaml import parse_settings
from urdfkit.description.control.ros1_launch import read_launch
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xml.source import Position, Source
from urdfkit.errors import DescriptionError


def settings(text: str, separator: str = "/") -> Settings:
    return parse_settings(Source("a.yaml", text), separator=separator)


def test_values_and_their_places() -> None:
    read = settings("robot:\n  a: {p: 1e-3, on: yes, names: [x, y], none: }\n  b/c: text\n")
    robot = read.group("robot")
    assert robot.number("a/p") == 0.001
    assert robot.flag("a/on", False) is True
    assert [(entry.value, str(entry.position)) for entry in robot.texts("a/names")] == [
        ("x", "a.yaml:2:33"),
        ("y", "a.yaml:2:36"),
    ]
    assert robot.text("b/c") == "text"
    assert robot.text("a/none", "default") == "default"
    assert robot.number("a/q", 2.0) == 2.0
    assert str(robot.group("a").place) == "a.yaml:2:3"


@pytest.mark.parametrize(
    ("text", "ask", "message"),
    [
        ("a: x", lambda s: s.number("a"), "a.yaml:1:4: `a` is `x`; it must be a finite number"),
        ("a: .inf", lambda s: s.number("a"), "must be a finite number"),
        ("a: [1]", lambda s: s.number("a"), "a.yaml:1:4: `a` must be a single value"),
        ("a: maybe", lambda s: s.flag("a", True), "a.yaml:1:4: `a` is `maybe`; it must be true or false"),
        ("n:\n  publish_rat: 5", lambda s: s.group("n").number("publish_rate"),
         "a.yaml:1:1: `n` has no `publish_rate`; did you mean `publish_rat`?"),
        ("a: 1", lambda s: s.numbers("a", ()), "`a` must be a list of numbers"),
        ("a: [[1]]", lambda s: s.texts("a"), "`a` must be a name or a list of names"),
    ],
)  # fmt: skip
def test_wrong_values(text: str, ask: object, message: str) -> None:
    with pytest.raises(DescriptionError) as caught:
        ask(settings(text))  # type: ignore[operator]
    assert message in str(caught.value)


@pytest.mark.parametrize("text", ["a: {b", "- 1\n- 2", "just text", "? [a]\n: b", "a: *b"])
def test_what_is_no_parameter_file_is_refused_in_one_line(text: str) -> None:
    with pytest.raises(DescriptionError) as caught:
        settings(text)
    assert str(caught.value).startswith("a.yaml:")
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_aliases_do_not_grow_without_end() -> None:
    lines = ["a0: &a0 [x, x]"] + [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 9)]
    with pytest.raises(DescriptionError, match="too many aliases"):
        settings("\n".join(lines))


def test_merge_keys_and_later_files() -> None:
    read = settings("base: &base {p: 1, d: 2}\nx: {<<: *base, d: 3}\n")
    assert (read.number("x/p"), read.number("x/d")) == (1, 3)
    both = read.merged(settings("x: {p: 5}\nz: 1"))
    assert (both.number("x/p"), both.number("x/d"), both.number("z")) == (5, 3, 1)


def test_parameters_of_a_ros_2_node() -> None:
    text = (
        "/**:\n  ros__parameters: {a: 1, b: 1, c: 1}\n"
        "node:\n  ros__parameters: {b: 2, linear.x.max_velocity: 4.0}\n"
        "/left/node:\n  ros__parameters: {c: 3}\n"
        "right:\n  node:\n    ros__parameters: {c: 4}\n"
    )
    read = settings(text, ".")
    left, right, other = (node_settings(read, namespace, "node") for namespace in ("/left", "/right", ""))
    assert [left.number(name) for name in "abc"] == [1, 2, 3]
    assert [right.number(name) for name in "abc"] == [1, 2, 4]
    assert [other.number(name) for name in "abc"] == [1, 2, 1]
    assert left.number("linear/x/max_velocity") == 4.0
    assert node_settings(read, "", "stranger").number("a") == 1


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def package(folder: Path, name: str) -> Path:
    write(folder / name / "package.xml", f"<package format='2'><name>{name}</name></package>")
    return folder / name


EFFORT = "{type: effort_controllers/JointEffortController, joint: j}"


def test_a_launch_file(tmp_path: Path) -> None:
    where = package(tmp_path, "bot_control")
    write(where / "config" / "a.yaml", f"one: {EFFORT}")
    path = write(
        where / "launch" / "a.launch",
        """<launch>
          <arg name="ns" default="bot"/><arg name="unknown"/>
          <group ns="$(arg ns)">
            <rosparam file="$(find bot_control)/config/a.yaml" command="load"/>
            <rosparam ns="two">type: pkg/Type</rosparam>
            <rosparam file="$(arg unknown)/b.yaml"/>
            <rosparam command="delete" param="x"/>
            <node pkg="controller_manager" type="spawner" name="s" args="one --timeout=5 $(arg ns)x"/>
          </group>
          <node pkg="controller_manager" type="spawner" name="t" args="--namespace=/other three"/>
          <node pkg="rviz" type="rviz" name="r" args="four"/>
        </launch>""",
    )
    launch = read_launch(path, Packages(near=where))
    assert launch is not None
    assert launch.settings is not None
    assert launch.files == (where / "config" / "a.yaml",)
    assert launch.settings.text("bot/one/joint") == "j"
    assert launch.settings.text("bot/two/type") == "pkg/Type"
    assert launch.spawned == ("/bot/one", "/bot/botx", "/other/three")
    assert read_launch(write(where / "launch" / "b.launch", "<launch>"), Packages(near=where)) is None


def robot(folder: Path, name: str = "bot") -> object:
    urdf = write(
        package(folder, f"{name}_description") / "urdf" / "r.urdf", f"<robot name='{name}'><link name='l'/></robot>"
    )
    return load(urdf)


LOAD = '<launch><rosparam command="load" file="$(find {package})/config/{file}"/>{more}</launch>'
SPAWN = '<node pkg="controller_manager" type="spawner" name="s" ns="bot" args="b"/>'


def test_a_launch_file_that_starts_controllers_comes_before_one_that_loads_them(tmp_path: Path) -> None:
    found = robot(tmp_path)
    where = package(tmp_path, "bot_control")
    for name in "abz":
        write(where / "config" / f"{name}.yaml", f"bot:\n  {name}: {EFFORT}")
        more = SPAWN if name == "b" else ""
        write(where / "launch" / f"{name}.launch", LOAD.format(package="bot_control", file=f"{name}.yaml", more=more))
    configuration = find_configuration(found, "/bot")
    assert configuration is not None
    assert list(configuration.settings.children) == ["b"]
    assert configuration.started == ("b",)
    assert configuration.source.endswith("b.launch)")


def test_another_robots_namespace_and_broken_files_do_not_matter(tmp_path: Path) -> None:
    found = robot(tmp_path)
    other = package(tmp_path, "zeppelin_control")
    write(other / "config" / "a.yaml", "bot: {")
    write(other / "launch" / "a.launch", LOAD.format(package="zeppelin_control", file="a.yaml", more=""))
    where = package(tmp_path, "bot_control")
    write(where / "config" / "a.yaml", f"other:\n  a: {EFFORT}")
    write(where / "launch" / "a.launch", LOAD.format(package="bot_control", file="a.yaml", more=""))
    assert find_configuration(found, "/bot") is None
    assert find_configuration(found, "/other") is not None


@pytest.mark.parametrize("text", ["bot: {", f"bot: {'[' * 50_000}{']' * 50_000}"])
def test_a_broken_file_of_the_robots_own_is_an_error(text: str, tmp_path: Path) -> None:
    found = robot(tmp_path)
    where = package(tmp_path, "bot_control")
    path = write(where / "config" / "a.yaml", text)
    write(where / "launch" / "a.launch", LOAD.format(package="bot_control", file="a.yaml", more=""))
    with pytest.raises(DescriptionError, match=r"a\.yaml:\d+:\d+: invalid YAML"):
        find_configuration(found, "/bot")
    path.write_text("")
    assert read_settings(path).children == {}


def test_a_later_file_overrides_values_and_adds_to_groups() -> None:
    place = Position("a.yaml", 1, 1)
    one, two = Settings("p", place, "1"), Settings("p", place, "2")
    group = Settings("g", place, children={"p": one, "q": one})
    other = Settings("g", place, children={"p": two, "r": two})
    assert group.merged(other).children == {"p": two, "q": one, "r": two}
    assert group.merged(two) == two
    assert one.merged(group) == group
