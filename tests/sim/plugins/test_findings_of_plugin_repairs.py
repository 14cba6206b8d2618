"""Every plugin that a simulation leaves out has a finding of the same code at the same place, for each parameter."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from urdfkit import Simulator
from urdfkit.description.plugins import PluginSpec
from urdfkit.description.plugins.controller_plugins import CONTROL
from urdfkit.description.plugins.drives.table import DRIVES
from urdfkit.lint import lint

SPECS = (*DRIVES, *CONTROL)
INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
WHEEL = (
    '<link name="{0}">' + INERTIAL + '<collision><geometry><sphere radius="0.1"/></geometry></collision></link>\n'
    '<joint name="joint_{0}" type="continuous"><parent link="base"/><child link="{0}"/><origin xyz="{1} 0"/>'
    '<axis xyz="0 {2}"/><limit effort="10" velocity="10"/></joint>\n'
)
WHEELS = "".join(
    WHEEL.format(*wheel)
    for wheel in (
        ("front_left", "0.3 0.3", "1 0"),
        ("front_right", "0.3 -0.3", "1 0"),
        ("rear_left", "-0.3 0.3", "1 0"),
        ("rear_right", "-0.3 -0.3", "1 0"),
        ("steering_left", "0.4 0.3", "0 1"),
        ("steering_right", "0.4 -0.3", "0 1"),
    )
)


def robot(spec: PluginSpec, replaced: dict[str, str | None]) -> str:
    """Return a robot with a plugin whose joints and links exist; None removes a parameter."""
    lines = []
    for parameter in spec.parameters:
        tag = parameter.tag.lower()
        text: str | None = None
        if parameter.names == "joint":
            side = "right" if "right" in tag else "left"
            place = "rear" if "rear" in tag or "back" in tag else "steering" if "steering" in tag else "front"
            text = f"joint_{place}_{side}"
        elif parameter.names in ("link", "frame"):
            text = "base"
        text = replaced.get(parameter.tag, text)
        lines += [] if text is None else [f"<{parameter.tag}>{text}</{parameter.tag}>\n"]
    name = spec.class_names[0] if spec.class_names else "plugin"
    return (
        f'<robot name="r">\n<link name="base">{INERTIAL}</link>\n{WHEELS}<gazebo>\n'
        f'<plugin filename="lib{spec.filenames[0]}.so" name="{name}">\n{"".join(lines)}</plugin></gazebo></robot>'
    )


def unreported(path: Path, text: str) -> tuple[int, list[str]]:
    """Return the number of repairs, and the repairs without a finding of their code at their place."""
    path.write_text(text)
    repairs = Simulator(path, note=lambda _: None).repairs
    places = {(each.code, each.span.line, each.span.column) for each in lint(path)} if repairs else set()
    missing = [
        f"{repair.code} {repair}"
        for repair in repairs
        if repair.position is None or (repair.code, repair.position.line, repair.position.column) not in places
    ]
    return len(repairs), missing


def cases(spec: PluginSpec) -> Iterator[dict[str, str | None]]:
    for parameter in spec.parameters:
        for value in ("0 word", "-1", "no*topic"):
            yield {parameter.tag: value}
        if parameter.names == "joint":
            yield {parameter.tag: None}
    if spec.by_meaning("min_command"):
        yield {"cmd_min": "2000"}
        yield {"cmd_min": "1", "cmd_max": "0"}


@pytest.mark.slow
@pytest.mark.parametrize("spec", SPECS, ids=lambda spec: f"{spec.kind}-{spec.generation}")
def test_every_invalid_parameter_has_a_finding_at_its_place(tmp_path: Path, spec: PluginSpec) -> None:
    path = tmp_path / "r.urdf"
    assert unreported(path, robot(spec, {})) == (0, [])
    total, missing = 0, []
    for replaced in cases(spec):
        found, without = unreported(path, robot(spec, replaced))
        total += found
        missing += [f"{replaced}: {each}" for each in without]
    assert total > 0
    assert missing == []
