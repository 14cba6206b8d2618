"""``urdfkit retime``: the fastest motion through waypoints within the limits of the joints."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfkit.cli.robot_arguments.robot_loading import add_robot_options, load_with_notes, named_robot, repairs_as_json
from urdfkit.cli.sim.option_values import positive
from urdfkit.errors import UsageError, did_you_mean

if TYPE_CHECKING:
    from urdfkit.kinematics.retiming import MotionLimits, TimedPath

_FILES = (".csv", ".npz", ".json")


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit retime``."""
    parser.usage = "urdfkit retime ROBOT [key:=value ...] PATH.csv [--acceleration LIMITS] [--jerk LIMITS] [-o FILE]"
    parser.epilog = (
        "PATH.csv has the names of the joints in its first line, then one waypoint per line [rad or m]\n"
        "limits are read from the first source that has them: --acceleration and --jerk, MoveIt's joint_limits.yaml, "
        "<limit> of the robot\n"
        "examples:\n"
        "  urdfkit retime seven_dof_arm waypoints.csv --acceleration 3 -o motion.csv\n"
        "  urdfkit retime arm.urdf waypoints.csv --acceleration 3,elbow=2 --jerk 30\n"
        "  urdfkit sim run seven_dof_arm --trajectory motion.csv --for 4"
    )
    parser.add_argument(
        "words",
        nargs="*",
        metavar="ROBOT PATH.csv",
        help="a .urdf or .xacro file, a package folder or a robot name, then key:=value xacro arguments, then the path",
    )
    limits = "VALUE|NAME=VALUE,…"
    parser.add_argument(
        "--acceleration",
        type=_limits,
        metavar=limits,
        help="acceleration limits [rad/s² or m/s²], for all joints or by name",
    )
    parser.add_argument(
        "--jerk", type=_limits, metavar=limits, help="jerk limits [rad/s³ or m/s³], for all joints or by name"
    )
    parser.add_argument(
        "--joint-limits",
        type=Path,
        metavar="FILE",
        help="MoveIt's joint_limits.yaml (default: the file of the package)",
    )
    parser.add_argument(
        "--scale",
        type=_scale,
        default=(1.0, 1.0),
        metavar="V,A",
        help="fractions of the velocity and acceleration limits to use",
    )
    parser.add_argument("--rate", type=positive, default=100.0, metavar="HZ", help="samples per second (default: 100)")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE",
        help="write the motion to a .csv, .npz or .json file (default: CSV to standard output)",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON value")
    add_robot_options(parser)


def run(arguments: argparse.Namespace) -> int:
    """Compute the motion, then print or write it."""
    model, file = _split(arguments.words)
    output = arguments.output
    if output is not None and output.suffix.lower() not in _FILES:
        hint = did_you_mean(output.suffix, _FILES)
        raise UsageError(f"retime: -o {output}: unsupported file type; use {', '.join(_FILES)}{hint}")
    from urdfkit.description.xml.cost_limit import loading_limit
    from urdfkit.kinematics.pinocchio_requirement import require_pinocchio

    require_pinocchio("retime")
    from urdfkit.kinematics.retiming import find_joint_limits, motion_limits, read_path, retime

    path = read_path(file)
    found = named_robot(model, arguments)
    with loading_limit():
        robot = load_with_notes(found, arguments)
    source = arguments.joint_limits or find_joint_limits(robot, path.joints)
    if source is not None and arguments.joint_limits is None and not arguments.quiet:
        print(f"urdfkit: limits from {source}", file=sys.stderr)
    limits = motion_limits(
        robot, path.joints, acceleration=arguments.acceleration, jerk=arguments.jerk, file=source
    ).scaled(*arguments.scale)
    motion = retime(path.positions, limits, rate=arguments.rate)
    if output is not None:
        _write(output, motion, limits)
    if arguments.json:
        print(json.dumps(_values(motion, limits) | repairs_as_json(robot)))
    elif output is None:
        print(_csv(motion), end="")
    if output is not None and not arguments.quiet:
        print(f"wrote {output}: {motion.duration:.3f} s, {len(motion.time)} samples", file=sys.stderr)
    return 0


def _split(words: list[str]) -> tuple[list[str], Path]:
    """Split the words into the model with its arguments and the file of the path."""
    plain = [word for word in words if ":=" not in word]
    if len(plain) != 2:
        raise UsageError(
            f"retime: expected ROBOT and PATH.csv, got {len(plain)} of them: {' '.join(plain) or 'nothing'}"
        )
    return [plain[0], *(word for word in words if ":=" in word)], Path(plain[1])


def _limits(text: str) -> dict[str, float]:
    """Return name → limit; the name is empty for the limit of all other joints."""
    limits: dict[str, float] = {}
    for part in filter(None, text.split(",")):
        name, separator, value = part.rpartition("=")
        if name in limits or (separator and not name):
            raise argparse.ArgumentTypeError(f"`{part}` must be VALUE or NAME=VALUE, each name once")
        limits[name] = positive(value)
    return limits


def _scale(text: str) -> tuple[float, float]:
    parts = text.split(",")
    if len(parts) != 2:
        raise argparse.ArgumentTypeError(f"`{text}` must be two numbers: V,A")
    velocity, acceleration = map(positive, parts)
    if max(velocity, acceleration) > 1.0:
        raise argparse.ArgumentTypeError(
            f"`{text}` has a fraction above 1; the fractions of the limits are from 0 to 1"
        )
    return velocity, acceleration


def _values(motion: TimedPath, limits: MotionLimits) -> dict[str, Any]:
    return {
        "joints": list(motion.joints),
        "duration": motion.duration,
        "limits": {
            "velocity": limits.velocity.tolist(),
            "acceleration": limits.acceleration.tolist(),
            "jerk": None if limits.jerk is None else limits.jerk.tolist(),
        },
        "waypoint_times": motion.waypoint_times.tolist(),
        "time": motion.time.tolist(),
        "positions": motion.position.tolist(),
        "velocities": motion.velocity.tolist(),
        "accelerations": motion.acceleration.tolist(),
    }


def _csv(motion: TimedPath) -> str:
    import numpy as np

    names = ["time", *motion.joints]
    names += [f"{joint}.{kind}" for kind in ("velocity", "acceleration") for joint in motion.joints]
    table = np.column_stack([motion.time, motion.position, motion.velocity, motion.acceleration])
    rows = (",".join(f"{value:.12g}" for value in row) for row in table.tolist())
    return "\n".join([",".join(names), *rows]) + "\n"


def _write(file: Path, motion: TimedPath, limits: MotionLimits) -> None:
    from urdfkit.atomic import write_bytes

    if file.suffix.lower() == ".npz":
        from io import BytesIO

        import numpy as np

        content = BytesIO()
        arrays: dict[str, Any] = {
            key: np.array(value) for key, value in _values(motion, limits).items() if key != "limits"
        }
        np.savez(content, **arrays)
        write_bytes(file, content.getvalue())
    else:
        text = _csv(motion) if file.suffix.lower() == ".csv" else json.dumps(_values(motion, limits)) + "\n"
        write_bytes(file, text.encode())
