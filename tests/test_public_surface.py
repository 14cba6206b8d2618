"""The public names of urdfkit: the documented ones, imported on first use, typed, and accepting the same robots."""

from __future__ import annotations

import inspect
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import urdfkit
from urdfkit.description.urdf.parser import parse
from urdfkit.resources import robots_dir

NAMES = {"load", "expand", "lint", "Simulator", "Kinematics", "Robot", "World", "Finding"}
NAMES |= {"UrdfkitError", "__version__", "sweep", "teleop", "view"}
PACKAGE = robots_dir() / "simpleton" / "simpleton_description"
FILE = PACKAGE / "urdf" / "simpleton.urdf.xacro"


def in_new_process(code: str) -> str:
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return done.stdout.strip()


def test_the_public_names_are_these() -> None:
    assert set(urdfkit.__all__) == NAMES
    assert dir(urdfkit) == sorted(NAMES)
    for name in NAMES:
        assert getattr(urdfkit, name) is not None


def test_each_public_name_is_imported_for_type_checkers() -> None:
    source = Path(urdfkit.__file__).read_text("utf-8")
    assert set(re.findall(r"import (\w+) as \1\b", source)) == NAMES - {"__version__"}
    assert (Path(urdfkit.__file__).parent / "py.typed").is_file()


@pytest.mark.parametrize(("name", "extra"), [("Simulator", "sim"), ("Kinematics", "view"), ("sweep", "sweep")])
def test_a_name_without_its_dependencies_says_what_to_install(name: str, extra: str) -> None:
    code = """import sys
sys.modules["numpy"] = None
import urdfkit
try:
    urdfkit.NAME
except urdfkit.UrdfkitError as error:
    print(error)
"""
    assert in_new_process(code.replace("NAME", name)) == f"urdfkit.{name} needs numpy: pip install 'urdfkit[{extra}]'"


def test_a_misspelt_name_gets_the_nearest() -> None:
    with pytest.raises(AttributeError, match="no attribute 'Simulater'; did you mean `Simulator`"):
        _ = urdfkit.Simulater


@pytest.mark.slow
def test_functions_stay_functions_when_the_module_of_that_name_is_imported() -> None:
    call = f"print(urdfkit.lint({str(FILE)!r}))"
    assert in_new_process(f"import urdfkit; {call}; {call}") == "[]\n[]"
    assert in_new_process(f"import urdfkit.lint.engine.run; {call}; print(urdfkit.lint.engine.__name__)") == (
        "[]\nurdfkit.lint.engine"
    )
    assert in_new_process("from urdfkit.lint import rule; print(rule.__name__)") == "urdfkit.lint.rule"
    shown = "import inspect; print(inspect.isfunction(lint), inspect.isfunction(urdfkit.lint))"
    assert in_new_process(f"import urdfkit; from urdfkit import lint; from urdfkit.lint import RULES; {shown}") == (
        "True True"
    )
    assert in_new_process("import urdfkit.lint.rule as rule; print(rule.__name__)") == "urdfkit.lint.rule"
    assert in_new_process(
        "import urdfkit.view.server, urdfkit.teleop; from urdfkit.teleop import Teleop; "
        "print(callable(urdfkit.view), callable(urdfkit.teleop))"
    ) == ("True True")


@pytest.mark.parametrize("name", ["lint", "view", "teleop"])
def test_editors_see_the_parameters_of_functions_with_the_name_of_a_module(name: str) -> None:
    assert inspect.isfunction(getattr(urdfkit, name))
    assert next(iter(inspect.signature(getattr(urdfkit, name)).parameters)) in ("robot", "robots")


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["simpleton", FILE, str(FILE), PACKAGE, urdfkit.load("simpleton")], ids=repr)
def test_every_entry_point_accepts_a_name_a_file_a_folder_and_a_robot(robot: Any) -> None:
    pytest.importorskip("pinocchio")
    assert urdfkit.load(robot).name == "simpleton"
    assert '<robot name="simpleton">' in urdfkit.expand(robot)
    assert urdfkit.lint(robot) == []
    assert urdfkit.Kinematics(robot).root == "base_footprint"


@pytest.mark.slow
def test_the_simulator_accepts_a_package_folder_and_a_robot() -> None:
    pytest.importorskip("numba")
    for robot in (PACKAGE, urdfkit.load("simpleton")):
        assert urdfkit.Simulator(robot, note=lambda _: None).name == "simpleton"


@pytest.mark.parametrize("function", ["load", "expand", "lint", "Kinematics", "Simulator"])
def test_an_unknown_robot_is_an_error_with_the_nearest_name(function: str) -> None:
    with pytest.raises(urdfkit.UrdfkitError, match="`simpelton`; did you mean `simpleton`"):
        getattr(urdfkit, function)("simpelton")


@pytest.mark.parametrize("function", ["load", "expand", "lint", "Kinematics", "Simulator"])
@pytest.mark.parametrize("wrong", [3, None, object()], ids=["number", "None", "object"])
def test_what_is_no_robot_is_an_error(function: str, wrong: Any) -> None:
    with pytest.raises(urdfkit.UrdfkitError, match=r"is not a robot: pass a file, a package folder"):
        getattr(urdfkit, function)(wrong)


def test_the_repr_of_kinematics_names_the_robot_and_its_size() -> None:
    assert repr(urdfkit.Kinematics("simpleton")) == "<Kinematics of simpleton: 7 links, nq = 4, nv = 2>"


ARM = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="mass" default="1"/>
  <link name="base"><inertial><mass value="$(arg mass)"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
</robot>
"""


def test_a_loaded_robot_keeps_its_xacro_arguments(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf.xacro"
    file.write_text(ARM)
    robot = urdfkit.load(file, arguments={"mass": "-1"})
    assert '<mass value="-1"/>' in urdfkit.expand(robot)
    assert '<mass value="2"/>' in urdfkit.expand(robot, arguments={"mass": "2"})
    wrong, right = urdfkit.lint(robot), urdfkit.lint(file)
    assert "-1 kg" in " ".join(finding.message for finding in wrong)
    assert "-1 kg" not in " ".join(finding.message for finding in right)
    both = urdfkit.lint([robot, file])
    assert {finding.code for finding in both} == {finding.code for finding in wrong + right}
    assert urdfkit.load(robot) is robot


@pytest.mark.parametrize("function", ["load", "expand", "view", "teleop"])
def test_an_argument_that_no_file_uses_is_an_error_with_the_nearest_name(function: str, tmp_path: Path) -> None:
    pytest.importorskip("tornado")
    file = tmp_path / "arm.urdf.xacro"
    file.write_text(ARM)
    with pytest.raises(urdfkit.UrdfkitError, match="no file uses the argument `mas`; did you mean `mass`"):
        getattr(urdfkit, function)(file, arguments={"mas": "2"})


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"select": ["ZZ9"]}, "^select ZZ9: unknown rule; `urdfkit rule` lists the rules"),
        ({"ignore": "I5O3"}, "^ignore I5O3: unknown rule; did you mean `I5"),
        ({"target": "ros2-jazy"}, "^target ros2-jazy: unknown target; did you mean `ros2-jazzy`"),
    ],
)
def test_errors_of_lint_name_its_parameters(options: dict[str, Any], message: str) -> None:
    with pytest.raises(urdfkit.UrdfkitError, match=message):
        urdfkit.lint("simpleton", **options)


def test_a_robot_without_a_file_cannot_be_linted() -> None:
    robot = parse(urdfkit.load("simpleton").element)
    with pytest.raises(urdfkit.UrdfkitError, match="robot `simpleton` was not read from a file"):
        urdfkit.lint(robot)
