"""Parameters of the nodes of a workspace, with another type than their code declares."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3"><name>cart</name><version>1.0.0</version>
<buildtool_depend>ament_cmake</buildtool_depend></package>"""
ROBOT = '<robot name="cart"><link name="base"/></robot>'
YAML = """{}:
  ros__parameters:
    rate: 10.0
    count: 3
    frame: base
    active: true
    gains: [1.0, 2.0]
"""
PYTHON = """import rclpy
class Driver(rclpy.node.Node):
    def __init__(self):
        super().__init__("driver")
        self.declare_parameter("rate", 5.0)
        self.declare_parameters("", [("count", 1), ("frame", "odom"), ("gains", [0.0, -1.0])])
        self.declare_parameter("active", False)
"""
CPP = """#include <rclcpp/rclcpp.hpp>
class Driver : public rclcpp::Node {
  Driver() : Node("driver") {
    declare_parameter<double>("rate", 5);
    declare_parameter("count", 1);
    this->declare_parameter<std::string>("frame", "odom");
    this->declare_parameter("active", false);
  }
};
"""
OPEN = PYTHON + "        # dynamic_typing=True\n"
LAUNCH = '<launch><node pkg="cart" exec="driver" name="motor"/></launch>'
INTEGER = "`rate` is `10`, but node `driver` declares a number with a decimal point; write 10.0"
LIST = "`gains` is a list of integers, but node `driver` declares a list of numbers with decimal points"
CASES = [
    ("driver.py", PYTHON, "10.0", "10", INTEGER),
    ("driver.cpp", CPP, "10.0", "10", INTEGER),
    ("driver.py", PYTHON, "count: 3", "count: 3.5", "`count` is `3.5`, but node `driver` declares an integer"),
    ("driver.cpp", CPP, "true", '"true"', "`active` is `true`, but node `driver` declares true or false"),
    ("driver.py", PYTHON, "base", "7", "`frame` is `7`, but node `driver` declares a string"),
    ("driver.py", PYTHON, "[1.0, 2.0]", "[1, 2]", LIST),
    ("driver.py", OPEN, "10.0", "10", ""),
    ("driver.py", PYTHON.replace("5.0", "self.rate"), "10.0", "10", ""),
    ("driver.py", PYTHON.replace('"driver"', '"other"'), "10.0", "10", ""),
    ("driver.py", PYTHON, "10.0", "20.0", ""),
    ("driver.cpp", CPP, "10.0", "20.0", ""),
]


def found(folder: Path, files: dict[str, str]) -> list[str]:
    for name, text in ({"package.xml": MANIFEST, "cart.urdf": ROBOT} | files).items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)
    return [each.message for each in lint(folder) if each.code == "K974"]


@pytest.mark.parametrize(("file", "code", "old", "new", "message"), CASES)
def test_values_of_another_type_than_the_default_are_found(tmp_path, file, code, old, new, message):
    yaml = YAML.format("driver")
    assert old in yaml
    findings = found(tmp_path, {f"src/{file}": code, "config/driver.yaml": yaml.replace(old, new)})
    assert findings == ([message] if message else [])


def test_a_launch_file_can_name_the_node(tmp_path):
    files = {"src/driver.py": PYTHON, "config/a.yaml": YAML.format("motor").replace("10.0", "10")}
    assert found(tmp_path, files) == []
    files["launch/cart.launch.xml"] = LAUNCH
    assert found(tmp_path, files) == [INTEGER.replace("driver", "motor")]


@pytest.mark.parametrize(
    ("kept", "place"), [("double rate_;", "driver.cpp:4"), ("int rate_;", "driver.yaml:3"), ("", "driver.yaml:3")]
)
def test_a_declaration_that_contradicts_its_variable_is_wrong(tmp_path, monkeypatch, kept, place):
    monkeypatch.chdir(tmp_path)
    declaration = 'rate_ = declare_parameter<int>("rate", 5);'
    code = CPP.replace('declare_parameter<double>("rate", 5);', declaration).replace("  }\n};", f"  }}\n  {kept}\n}};")
    files = {"package.xml": MANIFEST, "cart.urdf": ROBOT, "driver.cpp": code, "driver.yaml": YAML.format("driver")}
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    assert [f"{one.file}:{one.line}" for one in lint(tmp_path) if one.code == "K974"] == [place]
