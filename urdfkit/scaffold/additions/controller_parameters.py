"""Controller parameters as YAML for ROS 1 and ROS 2."""

import re
from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path

from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import ResourceError
from urdfkit.scaffold.additions.controller_gains import gains
from urdfkit.scaffold.additions.joint_controllers import ChosenController


def parameters(robot: Robot, controllers: list[ChosenController], *, generation: str, base: str) -> dict[str, str]:
    """Return the placeholders ``controllers``, ``managed`` and ``spawned`` of the template of controller packages.

    Args:
        robot: the robot that is controlled.
        controllers: the controllers.
        generation: a key of `FLAVOURS`, or ``classic``.
        base: base frame of odometry.
    """
    if generation == "classic":
        text = "".join(
            f"\n\n  {each.name}:\n" + "\n".join(f"    {line}" for line in _yaml1(robot, each, base))
            for each in controllers
        )
        spawned = "".join(f" {each.name}" for each in controllers)
        return {"controllers": text, "managed": "", "spawned": spawned}
    types = {
        "trajectory": "joint_trajectory_controller/JointTrajectoryController",
        "diff_drive": "diff_drive_controller/DiffDriveController",
    }
    text = "".join(
        f"\n{each.name}:\n  ros__parameters:\n" + "".join(f"    {line}\n" for line in _yaml2(robot, each, base))
        for each in controllers
    )
    managed = "".join(f"\n    {each.name}: {{type: {types[each.kind]}}}" for each in controllers)
    spawned = "".join(f'", "{each.name}' for each in controllers)  # within a string: the template is valid Python
    return {"controllers": text.rstrip("\n"), "managed": managed, "spawned": spawned}


def with_controllers(text: str, more: dict[str, str], names: list[str], *, path: Path) -> str:
    """Return a ROS 2 parameter file with more controllers; all other text is unchanged.

    Args:
        text: text of the file.
        more: placeholders from `parameters`.
        names: names of the controllers.
        path: path of the file, for error messages.

    Raises:
        ResourceError: the file has no controller manager, or already has a controller of one of the names.
    """
    for name in names:
        if re.search(rf"(?m)^\s*/?{name}\s*:", text):
            raise ResourceError(f"{path} already has a `{name}`; nothing was changed")
    place = re.search(
        r"(?m)^/?controller_manager\s*:[^\n]*\n(?:[ \t]*(?:#[^\n]*)?\n)*([ \t]+)ros__parameters\s*:[ \t]*\n", text
    )
    if place is None:
        raise ResourceError(f"{path} has no `controller_manager:` with `ros__parameters:` under it")
    below = re.match(r"(?:[ \t]*(?:#[^\n]*)?\n)*([ \t]+)", text[place.end() :])
    indent = below[1] if below is not None and len(below[1]) > len(place[1]) else place[1] * 2
    managed = "".join(f"{indent}{line.strip()}\n" for line in more["managed"].splitlines() if line.strip())
    end = "" if text.endswith("\n") else "\n"
    return f"{text[: place.end()]}{managed}{text[place.end() :]}{end}{more['controllers']}\n"


def move_to_root_namespace(package: Path, name: str) -> None:
    """Move the controllers of a ROS 1 package out of a namespace, for a plugin whose namespace is ``/``.

    Args:
        package: folder of the package.
        name: the namespace.
    """
    settings = package / "config/controllers.yaml"
    lines = settings.read_text(encoding="utf-8").splitlines()
    kept = [line.removeprefix("  ") for line in lines if line != f"{name}:"]
    settings.write_text("\n".join(kept) + "\n", encoding="utf-8")
    for launch in (package / "launch").iterdir():
        launch.write_text(launch.read_text(encoding="utf-8").replace(f' ns="{name}"', ""), encoding="utf-8")


def _yaml1(robot: Robot, each: ChosenController, base: str) -> Iterator[str]:
    if each.wheels is not None:
        yield "type: diff_drive_controller/DiffDriveController"
        yield f"left_wheel: [{', '.join(each.wheels.left)}]"
        yield f"right_wheel: [{', '.join(each.wheels.right)}]"
        yield f"wheel_separation: {each.wheels.separation:.6g}"
        yield f"wheel_radius: {each.wheels.radius:.6g}"
        yield f"base_frame_id: {base}"
        yield "publish_rate: 50"
        yield "pose_covariance_diagonal: [0.001, 0.001, 1000000.0, 1000000.0, 1000000.0, 0.03]"
        yield "twist_covariance_diagonal: [0.001, 0.001, 1000000.0, 1000000.0, 1000000.0, 0.03]"
        return
    interface = each.interface or "velocity"
    yield f"type: {interface}_controllers/JointTrajectoryController"
    yield f"joints: [{', '.join(each.joints)}]"
    if interface != "position":
        yield "gains:"
        yield from (f"  {joint}: {{{_pid(robot, joint, interface)}}}" for joint in each.joints)
    if interface == "velocity":
        yield "velocity_ff:"
        yield from (f"  {joint}: 1.0" for joint in each.joints)
    yield from _trajectory_options()


def _yaml2(robot: Robot, each: ChosenController, base: str) -> Iterator[str]:
    if each.wheels is not None:
        yield f"left_wheel_names: [{', '.join(each.wheels.left)}]"
        yield f"right_wheel_names: [{', '.join(each.wheels.right)}]"
        yield f"wheel_separation: {each.wheels.separation:.6g}"
        yield f"wheel_radius: {each.wheels.radius:.6g}"
        yield f"base_frame_id: {base}"
        yield "publish_rate: 50.0"
        return
    interface = each.interface or "position"
    yield f"joints: [{', '.join(each.joints)}]"
    yield f"command_interfaces: [{interface}]"
    yield "state_interfaces: [position, velocity]"
    if interface != "position":
        scale = ", ff_velocity_scale: 1.0" if interface == "velocity" else ""
        yield "gains:"
        yield from (f"  {joint}: {{{_pid(robot, joint, interface)}{scale}}}" for joint in each.joints)
    yield from _trajectory_options()


def _trajectory_options() -> Iterator[str]:
    yield "allow_partial_joints_goal: true"
    yield "constraints:"
    yield "  stopped_velocity_tolerance: 0.05"
    yield "  goal_time: 1.0"


def _pid(robot: Robot, joint: str, interface: str) -> str:
    """Return the gains of a joint: those of the robot template for velocities, computed ones for efforts."""
    if interface == "velocity":
        return "p: 20.0, i: 0.0, d: 0.0"
    pid = gains(robot, robot.joint_by_name[joint])
    values = {"p": pid.p, "i": pid.i, "d": pid.d, "i_clamp": pid.clamp}
    return ", ".join(f"{name}: {_real(value)}" for name, value in values.items())


def _real(value: float) -> str:
    """Return a number with three digits that YAML reads as a floating-point number."""
    text = format(Decimal(f"{value:.3g}"), "f")
    return text if "." in text else f"{text}.0"
