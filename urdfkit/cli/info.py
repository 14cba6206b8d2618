"""``urdfkit info``: print the links, joints, mass, sensors and drives of a robot."""

import argparse
import json
import sys
from collections import Counter
from typing import Any

from urdfkit.cli.parser import add_model
from urdfkit.cli.robot_arguments.robot_loading import (
    add_macro,
    add_strict,
    load_with_notes,
    named_robot,
    repairs_as_json,
)
from urdfkit.description.urdf.robot import Robot
from urdfkit.description.urdf.version import RATES
from urdfkit.errors import MissingDependencyError, UrdfkitError, shortened

_SHOWN = 3
"""Largest number of links in a line."""

_FREEDOMS = {"revolute": 1, "continuous": 1, "prismatic": 1, "planar": 3, "floating": 6}


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit info``."""
    parser.epilog = "examples:\n  urdfkit info simpleton\n  urdfkit info urdf/arm.urdf.xacro --json"
    add_model(parser)
    add_macro(parser)
    add_strict(parser)
    parser.add_argument("--json", action="store_true", help="print one JSON value")


def run(arguments: argparse.Namespace) -> int:
    """Print the properties of the robot."""
    from urdfkit.description.xml.cost_limit import loading_limit

    model = named_robot(arguments.model, arguments)
    with loading_limit():
        robot = load_with_notes(model, arguments)
        facts = facts_of(robot)
    if facts["note"] and not arguments.quiet:
        print(f"urdfkit: note: {facts['note']}", file=sys.stderr)
    print(json.dumps(facts) if arguments.json else _table(facts, robot))
    return 0


def facts_of(robot: Robot) -> dict[str, Any]:
    """Return the object that ``urdfkit info --json`` prints.

    Lengths are in metres, masses in kilograms; centre of mass and bounding box (of visuals and collisions) are in the
    root frame with all joints at zero, null where they cannot be computed: ``note`` contains the reason.
    ``estimated_masses`` are the bodies without mass or inertia, which a simulation estimates: a link of each, the joint
    that moves it (null for the base), and the position of the link.
    """
    from urdfkit.description.urdf.queries import mass

    facts: dict[str, Any] = {
        "robot": robot.name,
        "file": str(robot.files[0]) if robot.files else None,
        "files": [str(file) for file in robot.files],
        "root": next((link.name for link in robot.roots()), None),
        "links": [link.name for link in robot.links],
        "joints": [_joint(joint) for joint in robot.joints],
        "degrees_of_freedom": sum(_FREEDOMS.get(j.type or "", 0) for j in robot.joints if j.mimic is None),
        "mass": sum(mass(robot, link.name) for link in robot.links),
        "estimated_masses": _estimated_masses(robot),
        "center_of_mass": None,
        "bounding_box": None,
        "drives": _drives(robot),
        "sensors": _sensors(robot),
        **repairs_as_json(robot),
        "note": None,
    }
    try:
        facts |= _extent(robot, facts["mass"])
    except MissingDependencyError as error:
        facts["note"] = f"no centre of mass and bounding box: {error.message}"
    except UrdfkitError as error:
        facts["note"] = str(error)
    return facts


def _joint(joint: Any) -> dict[str, Any]:
    limit = joint.limit
    return {
        "name": joint.name,
        "type": joint.type,
        "parent": joint.parent,
        "child": joint.child,
        "mimic": joint.mimic.joint if joint.mimic is not None else None,
        "lower": limit.lower if limit is not None else None,
        "upper": limit.upper if limit is not None else None,
        "effort": limit.effort if limit is not None else None,
        "velocity": limit.velocity if limit is not None else None,
        **{rate: getattr(limit, rate, None) for rate in RATES},
    }


def _estimated_masses(robot: Robot) -> list[dict[str, Any]]:
    from urdfkit.description.urdf.massless_links import is_free, massless

    found: list[dict[str, Any]] = []
    if any(link.inertial is not None and (link.inertial.mass or 0.0) < 0.0 for link in robot.links):
        return found  # `sim` refuses the robot
    for link, joint in massless(robot, floating=is_free(robot)):
        place = link.element.origin.position
        found.append(
            {
                "link": link.name,
                "joint": joint and joint.name,
                "file": place and place.file,
                "line": place and place.line,
                "column": place and place.column,
            }
        )
    return found


def _drives(robot: Robot) -> list[dict[str, Any]]:
    from urdfkit.description.plugins import match, read_all
    from urdfkit.description.plugins.drives.table import DRIVES

    found = []
    for plugin in (plugin for block in robot.gazebo for plugin in block.plugins):
        spec = match(plugin)
        if spec is None or spec not in DRIVES:
            continue
        values = read_all(plugin, spec)
        joints = [name for p in spec.parameters if p.names == "joint" for name in values[p.meaning]]
        found.append({"kind": spec.kind, "generation": spec.generation, "plugin": plugin.name, "joints": joints})
    return found


def _sensors(robot: Robot) -> list[dict[str, Any]]:
    from urdfkit.description.xml.numbers import number

    found = []
    for block in robot.gazebo:
        for sensor in block.sensors:
            rate = sensor.element.find("update_rate")
            found.append(
                {
                    "name": sensor.name,
                    "type": sensor.type,
                    "on": block.reference,
                    "update_rate": number(rate.text) if rate is not None else None,
                }
            )
    return found


def _extent(robot: Robot, mass: float) -> dict[str, Any]:
    """Return centre of mass and bounding box with all joints at zero.

    Raises:
        MissingDependencyError: Pinocchio is not installed.
    """
    from urdfkit.kinematics.pinocchio_requirement import require_pinocchio

    require_pinocchio("info")
    from urdfkit.kinematics import Kinematics
    from urdfkit.scene.extent import bounds
    from urdfkit.scene.pose_matrices import pose_matrices
    from urdfkit.scene.scene_table import scene_of

    kinematics = Kinematics(robot)
    poses = kinematics.link_poses(kinematics.neutral())
    pose_of = dict(zip(kinematics.link_names, poses, strict=True))
    placements = dict(zip(kinematics.link_names, pose_matrices(poses), strict=True))
    moments = [0.0, 0.0, 0.0]
    for link in robot.links:
        if link.inertial is not None and link.inertial.mass:
            center = placements[link.name] @ [*link.inertial.origin.xyz, 1.0]
            moments = [moment + link.inertial.mass * float(x) for moment, x in zip(moments, center, strict=False)]
    scene = scene_of(robot, strict=False)
    box = bounds(scene, [pose_of[body] for body in scene.bodies])
    return {
        "center_of_mass": [moment / mass for moment in moments] if mass > 0.0 else None,
        "bounding_box": {"min": box[0].tolist(), "max": box[1].tolist()} if box is not None else None,
        "note": f"the bounding box excludes {len(scene.problems)} meshes: {scene.problems[0].error}"
        if scene.problems
        else None,
    }


def _negative_masses(robot: Robot) -> str:
    """Return words about links with negative masses, or an empty text."""
    found = [
        f"{link.inertial.mass:g} kg of `{link.name}`"
        for link in robot.links
        if link.inertial is not None and (link.inertial.mass or 0.0) < 0.0
    ]
    return f" with {', '.join(found)}, which `sim` rejects" if found else ""


def _table(facts: dict[str, Any], robot: Robot) -> str:
    kinds = Counter(joint["type"] for joint in facts["joints"])
    rows = [
        ("robot", f"{facts['robot']}  ({facts['file']})"),
        ("links", f"{len(facts['links'])}, root {facts['root']}"),
        ("joints", ", ".join(f"{count} {kind}" for kind, count in kinds.items()) or "none"),
        ("degrees of freedom", str(facts["degrees_of_freedom"])),
        ("mass", f"{facts['mass']:.6g} kg{_negative_masses(robot)}"),
    ]
    if estimated := facts["estimated_masses"]:
        places = [f"`{one['link']}` ({one['file']}:{one['line']}:{one['column']})" for one in estimated[:_SHOWN]]
        more = f" and {len(estimated) - _SHOWN} more" if len(estimated) > _SHOWN else ""
        bodies = "1 body" if len(estimated) == 1 else f"{len(estimated)} bodies"
        rows.append(("estimated masses", f"{bodies}, in `sim` only: {', '.join(places)}{more}"))
    if (center := facts["center_of_mass"]) is not None:
        rows.append(("centre of mass", f"{_triple(center)} m in {facts['root']}"))
    if (box := facts["bounding_box"]) is not None:
        rows.append(("bounding box", f"{_triple(box['min'])} to {_triple(box['max'])} m"))
    rows += [("drive", f"{d['kind']} ({d['generation']}): {', '.join(d['joints'])}") for d in facts["drives"]]
    for sensor in facts["sensors"]:
        rate = f", {sensor['update_rate']:g} Hz" if sensor["update_rate"] else ""
        link = sensor["on"]
        is_part = link in robot.link_by_name or link in robot.joint_by_name
        on = f"on {link}" if is_part else f"on `{link}`, which does not exist" if link else "on no link"
        rows.append(("sensor", f"{sensor['name'] or 'without a name'} ({sensor['type'] or 'no type'}) {on}{rate}"))
    width = max(len(name) for name, _ in rows) + 2
    return "\n".join(f"{name:<{width}}{shortened(text)}" for name, text in rows)


def _triple(values: list[float]) -> str:
    return " ".join(f"{value + 0.0:.4g}" for value in values)
