"""The schemas in docs/schemas describe what the commands print with ``--json``."""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.served_simulation import driven
from urdfkit.cli import COMMANDS, main, parser_of

jsonschema = pytest.importorskip("jsonschema")
pytest.importorskip("numba")

DOCS = Path(__file__).parents[2] / "docs"
SCHEMAS = DOCS / "schemas"
ARM = ("seven_dof_arm", "grasping_frame")

NO_MESH = """<robot name="part">
  <link name="base">
    <visual><geometry><mesh filename="package://lost/part.stl"/></geometry></visual>
    <collision><geometry><box size="1 1 1"/></geometry></collision>
  </link>
  <joint name="slide" type="floating"><parent link="base"/><child link="stone"/></joint>
  <link name="stone">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
  </link>
  <xacro:macro xmlns:xacro="http://www.ros.org/wiki/xacro" name="wheel"/>
</robot>
"""

TWO_ROOTS = """<robot name="roots">
  <link name="base"/>
  <link name="tip"/>
  <link name="lost"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/></joint>
</robot>
"""

COMMANDS_OF: dict[str, list[tuple[str, ...]]] = {
    "info": [("info", "gem_e2"), ("info", "part.urdf")],
    "inertia": [("inertia", "simpleton"), ("inertia", "part.urdf", "base", "--mass", "2")],
    "tf": [("tf", "simpleton"), ("tf", "simpleton", "base_footprint", "camera"), ("tf", "part.urdf", "--tree")],
    "ik": [(*("ik", *ARM, "--xyz", "0.4,0.2,0.4"), *more) for more in ((), ("--collision-free", "--all"))]
    + [("ik", *ARM, "--xyz", "9,0,0"), ("ik", "roots.urdf", "tip", "--xyz", "0,0,0", "--position-only")],
    "jacobian": [("jacobian", *ARM), ("jacobian", "roots.urdf", "tip")],
    "reach": [("reach", *ARM, "--resolution", "0.3", "--orientations", "4", "--base-for", "poses.csv")],
    "retime": [("retime", "seven_dof_arm", "path.csv", "--acceleration", "3")],
    "srdf": [("srdf", "seven_dof_arm", "--samples", "500"), ("srdf", "roots.urdf", "--samples", "500")],
    "sim-run": [
        ("sim", "run", "simpleton", "--world", "cylinders", "--for", "0.1"),
        ("sim", "run", "part.urdf", "--for", "0.1"),
    ],
    "sim-sweep": [("sim", "sweep", "simpleton", "--vary", "cmd.vx=0.2,0.5", "--metric", "x", "--for", "0.1")],
    "lint": [("lint", "part.urdf", "--format"), ("lint", str(DOCS.parent / "tests/lint/rules"), "--format")],
    "lint-statistics": [("lint", "part.urdf", "--statistics", "--format")],
    "bag-info": [("bag", "info", "run.mcap")],
    "licenses": [("licenses",)],
    "topic-list": [("topic", "list")],
    "topic-info": [("topic", "info", "/simpleton/odom")],
    "topic-hz": [("topic", "hz", "/simpleton/odom", "--once"), ("topic", "hz", "/clock", "--once", "--wall-time")],
    "topic-bw": [("topic", "bw", "/simpleton/odom", "--once")],
    "service-list": [("service", "list"), ("service", "list", "--types")],
    "action-list": [("action", "list")],
}

PLAIN = {
    "topic find",
    "topic type",
    "topic echo",
    "service find",
    "service type",
    "service call",
    "action send",
}
"""Commands that print a name, a list of names, or messages."""


def schema(name: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((SCHEMAS / f"{name}.schema.json").read_text("utf-8"))
    return found


def strict(part: Any) -> Any:
    """Return a schema that accepts no keys besides those that it names."""
    if isinstance(part, list):
        return [strict(each) for each in part]
    if not isinstance(part, dict):
        return part
    closed = {"additionalProperties": False} if isinstance(part.get("properties"), dict) and "type" in part else {}
    return closed | {key: strict(value) for key, value in part.items()}


def with_json(parser: argparse.ArgumentParser, name: str) -> Iterator[str]:
    """Yield the commands that have the option ``--json``."""
    subcommands = [a for a in parser._actions if isinstance(a, argparse._SubParsersAction)]
    if any("--json" in action.option_strings for action in parser._actions):
        yield name
    for action in subcommands:
        for word, subparser in action.choices.items():
            yield from with_json(subparser, f"{name} {word}")


def test_every_command_with_json_has_a_schema() -> None:
    found: set[str] = set()
    for name in COMMANDS:
        choices = next(a for a in parser_of(name)._actions if isinstance(a, argparse._SubParsersAction)).choices
        found |= set(with_json(choices[name], name))
    assert {name.replace(" ", "-") for name in found - PLAIN} | {"lint", "lint-statistics"} == set(COMMANDS_OF)


def test_every_schema_is_valid_and_listed() -> None:
    files = {file.name.removesuffix(".schema.json") for file in SCHEMAS.iterdir()}
    assert files == set(COMMANDS_OF)
    assert set(re.findall(r"\(schemas/([a-z-]+)\.schema\.json\)", (DOCS / "json.md").read_text("utf-8"))) == files
    for name in files:
        jsonschema.Draft202012Validator.check_schema(schema(name))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A folder with the files that the commands read, beside a running simulation."""
    from urdfkit.sim import Simulator

    path = tmp_path_factory.mktemp("json")
    (path / "part.urdf").write_text(NO_MESH)
    (path / "roots.urdf").write_text(TWO_ROOTS)
    (path / "poses.csv").write_text("x,y,z,qx,qy,qz,qw\n2,1,0.5,0,0,0,1\n")
    (path / "path.csv").write_text("shoulder_pan_joint,elbow_pitch_joint\n0,0\n0.8,-0.5\n")
    assert main(["sim", "run", "simpleton", "--for", "0.1", "--quiet", "--record", str(path / "run.mcap")]) == 0
    with driven(Simulator("simpleton", note=lambda _: None), tmp_path_factory.mktemp("runtime")):
        yield path


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(COMMANDS_OF))
def test_output_follows_the_schema(name: str, folder: Path, capsys: Any, monkeypatch: Any) -> None:
    monkeypatch.chdir(folder)
    for words in COMMANDS_OF[name]:
        capsys.readouterr()
        assert main([*words, "json" if words[0] == "lint" else "--json"]) in (0, 1)
        value = json.loads(capsys.readouterr().out)
        jsonschema.validate(value, strict(schema(name)))
        if "roots.urdf" in words:
            assert [(repair["code"], repair["line"]) for repair in value["repairs"]] == [("T203", 4)]
