"""``urdfkit tf``: print one transform, all transforms, or the frame tree."""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.cli.robot_arguments.joint_positions import joint_positions, warn_of_limits
from urdfkit.cli.robot_arguments.robot_loading import add_robot_options, load_with_notes, named_robot, repairs_as_json
from urdfkit.errors import MissingDependencyError, ResourceError, UsageError, did_you_mean, shortened

if TYPE_CHECKING:
    from urdfkit.kinematics.tf import Transform, TransformTree

_DRAWINGS = (".svg", ".dot", ".pdf")


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit tf``."""
    parser.usage = (
        "urdfkit tf ROBOT [key:=value ...] [PARENT CHILD] [--joint name=value ...] [--json]\n"
        "       urdfkit tf ROBOT [key:=value ...] --tree [-o frames.svg|.pdf|.dot]"
    )
    parser.epilog = (
        "examples:\n"
        "  urdfkit tf simpleton base_footprint left_wheel --joint left_wheel_joint=1.57\n"
        "  urdfkit tf simpleton --tree -o frames.svg"
    )
    parser.add_argument(
        "words",
        nargs="*",
        metavar="ROBOT [PARENT CHILD]",
        help="a .urdf or .xacro file, a package folder or a robot name, then key:=value xacro arguments, then the "
        "parent and child frame of the transform (default: all frames relative to the root frame)",
    )
    parser.add_argument(
        "--joint",
        nargs="+",
        action="extend",
        default=[],
        metavar="name=value",
        help="joint positions in rad or m; the default is zero (planar and floating joints take one value "
        "per variable: name/x, name/y, name/theta, ...)",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON value")
    parser.add_argument("--tree", action="store_true", help="print or draw the frame tree")
    parser.add_argument(
        "-o", "--output", type=Path, metavar="FILE", help="with --tree: write a drawing to a .svg, .dot or .pdf file"
    )
    add_robot_options(parser)


def run(arguments: argparse.Namespace) -> int:
    """Print the requested transforms or the frame tree."""
    model, frames = _split(arguments.words)
    if len(frames) == 1:
        raise UsageError(f"tf: a transform needs PARENT and CHILD; add the CHILD frame after `{frames[0]}`")
    if len(frames) > 2:
        raise UsageError(f"tf: expected one PARENT and one CHILD, got {len(frames)} frames: {' '.join(frames)}")
    if arguments.output is not None:
        if not arguments.tree:
            raise UsageError("tf: -o requires --tree")
        if arguments.output.suffix.lower() not in _DRAWINGS:
            hint = did_you_mean(arguments.output.suffix, _DRAWINGS)
            raise UsageError(f"tf: -o {arguments.output}: unsupported file type; use {', '.join(_DRAWINGS)}{hint}")
    positions = joint_positions(arguments.joint, "tf: --joint")

    from urdfkit.description.xml.cost_limit import loading_limit
    from urdfkit.kinematics.pinocchio_requirement import require_pinocchio

    require_pinocchio("tf")
    from urdfkit.kinematics.tf import TransformTree

    found = named_robot(model, arguments)
    with loading_limit():
        robot = load_with_notes(found, arguments)
        tree = TransformTree(robot)
    tree.kinematics.followed(positions)  # refuses unknown names
    warn_of_limits(robot, positions)
    if arguments.tree:
        if frames:
            raise UsageError("tf: PARENT and CHILD cannot be combined with --tree")
        _show_tree(tree, output=arguments.output, as_json=arguments.json)
        if arguments.output is not None and not arguments.quiet:
            print(f"wrote {arguments.output}", file=sys.stderr)
    elif frames:
        transform = tree.transform(frames[0], frames[1], positions)
        values = asdict(transform) | repairs_as_json(tree.kinematics.robot)
        _write(json.dumps(values) + "\n" if arguments.json else _echo(transform))
    else:
        transforms = tree.transforms(tree.kinematics.configuration(positions))
        as_json = json.dumps([asdict(transform) for transform in transforms])
        _write(as_json + "\n" if arguments.json else _table(tree.root, transforms))
    return 0


def _split(words: list[str]) -> tuple[list[str], list[str]]:
    """Split the words into the model with its arguments and the frames."""
    plain = [word for word in words if ":=" not in word]
    return [*plain[:1], *(word for word in words if ":=" in word)], plain[1:]


def _echo(transform: Transform) -> str:
    """Return a transform as ``tf2_echo`` prints it."""
    degrees = [number * 57.29577951308232 for number in transform.rpy]
    lines = [
        f"{shortened(transform.parent)} → {shortened(transform.child)}",
        f"- Translation: {_row(transform.translation)} m",
        f"- Rotation: in Quaternion (xyzw) {_row(transform.quaternion)}",
        f"- Rotation: in RPY (radian) {_row(transform.rpy)}",
        f"- Rotation: in RPY (degree) {_row(degrees, 3)}",
        "- Matrix:",
        *("  " + " ".join(f"{_number(number):>10}" for number in row) for row in transform.matrix),
    ]
    return "\n".join(lines) + "\n"


def _table(root: str, transforms: list[Transform]) -> str:
    """Return the transforms as a table with one row per frame."""
    names = [shortened(transform.child) for transform in transforms]
    widest = max(map(len, names))
    heads = ("x [m]", "y [m]", "z [m]", "roll [rad]", "pitch [rad]", "yaw [rad]")
    lines = [f"frames in `{shortened(root)}`", " ".join([" " * widest, *(f"{head:>11}" for head in heads)])]
    for name, transform in zip(names, transforms, strict=True):
        numbers = (f"{_number(number):>11}" for number in [*transform.translation, *transform.rpy])
        lines.append(" ".join([f"{name:<{widest}}", *numbers]))
    return "\n".join(lines) + "\n"


def _row(numbers: list[float], digits: int = 6) -> str:
    return f"[{', '.join(_number(number, digits) for number in numbers)}]"


def _number(number: float, digits: int = 6) -> str:
    return f"{round(number, digits) + 0.0:.{digits}f}"


def _show_tree(tree: TransformTree, *, output: Path | None, as_json: bool) -> None:
    from urdfkit.atomic import write_bytes, write_text
    from urdfkit.kinematics.frame_tree_drawing import as_dot, as_svg, as_text

    if output is None and not as_json:
        try:
            "└├│".encode(sys.stdout.encoding or "utf-8")
            _write(as_text(tree))
        except UnicodeEncodeError:
            _write(as_text(tree, ascii_only=True))
    if as_json:
        edges = [asdict(edge) for edge in tree.edges]
        values = {"root": tree.root, "frames": list(tree.frames), "edges": edges}
        _write(json.dumps(values | repairs_as_json(tree.kinematics.robot)) + "\n")
    if output is not None:
        match output.suffix.lower():
            case ".svg":
                write_text(output, as_svg(tree))
            case ".dot":
                write_text(output, as_dot(tree))
            case _:
                write_bytes(output, _pdf(as_dot(tree)))


def _pdf(dot: str) -> bytes:
    """Return a drawing by Graphviz.

    Raises:
        MissingDependencyError: Graphviz is not installed.
        ResourceError: Graphviz failed.
    """
    program = shutil.which("dot")
    if program is None:
        raise MissingDependencyError(
            "tf: a .pdf is drawn by Graphviz, which is not installed (apt install graphviz); use -o frames.svg "
            "or frames.dot instead"
        )
    drawn = subprocess.run([program, "-Tpdf"], input=dot.encode(), capture_output=True, check=False)
    if drawn.returncode != 0:
        reason = drawn.stderr.decode(errors="replace").strip().splitlines() or ["no reason given"]
        raise ResourceError(f"tf: Graphviz could not draw the frame tree: {reason[0]}")
    return drawn.stdout


def _write(text: str) -> None:
    """Write to standard output; replace characters that its encoding does not support."""
    encoding = sys.stdout.encoding or "utf-8"
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        text = text.replace("→", "->").encode(encoding, errors="replace").decode(encoding)
    sys.stdout.write(text)
