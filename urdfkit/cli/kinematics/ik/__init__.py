"""``urdfkit ik``: joint positions that place a link at poses. See docs/kinematics.md.

One pose is solved without numpy, whose import takes longer than the rest; files of poses are solved by `Chain`.
"""

from __future__ import annotations

import argparse
import re
from pathlib import Path

from urdfkit.app.page import require_packages
from urdfkit.cli.robot_arguments.joint_positions import joint_positions
from urdfkit.cli.robot_arguments.tip_link import add_tip, robot_and_tip
from urdfkit.errors import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.kinematics.serial.serial_solver import SolverOptions

TOLERANCE = (1e-3, 1.745e-3)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit ik``."""
    # argparse parses `-1,0,0` as an option unless this pattern matches it.
    parser._negative_number_matcher = re.compile(r"^-\.?\d|^-(inf|nan)", re.IGNORECASE)
    parser.usage = (
        "urdfkit ik ROBOT [key:=value ...] TIP [--base LINK] --xyz X,Y,Z [--quat X,Y,Z,W | --rpy R,P,Y] [option ...]\n"
        "       urdfkit ik ROBOT [key:=value ...] TIP [--base LINK] --targets FILE [-o FILE.npz] [option ...]"
    )
    parser.epilog = (
        "exit status: 0 if all poses are reached, 1 if some are not, 2 on failure\n"
        "examples:\n"
        "  urdfkit ik seven_dof_arm wrist_roll_link --xyz 0.3,0.2,0.9 --rpy 0,1.57,0\n"
        "  urdfkit ik seven_dof_arm wrist_roll_link --xyz 0.3,0.2,0.9 --position-only\n"
        "  urdfkit ik panda.urdf panda_hand --targets poses.npy -o solutions.npz"
    )
    add = parser.add_argument
    add_tip(parser)
    add("--xyz", metavar="X,Y,Z", help="position of TIP in the base link [m]")
    add(
        "--quat", metavar="X,Y,Z,W", help="orientation of TIP as a quaternion (default: no rotation from the base link)"
    )
    add("--rpy", metavar="R,P,Y", help="orientation of TIP as fixed-axis roll, pitch, yaw [rad]")
    add(
        "--targets",
        type=Path,
        metavar="FILE",
        help="a .npy, .npz (array `targets`) or .csv file of poses: x y z [m] and a quaternion x y z w per row, or "
        "x y z with --position-only",
    )
    add(
        "--from",
        dest="start",
        action="append",
        default=[],
        metavar="NAME=VALUE,…",
        help="joint positions to start from [rad or m] (default: the middle of the limits)",
    )
    add(
        "--hold",
        action="append",
        default=[],
        metavar="NAME=VALUE,…",
        help="joints of the chain that do not move, and their positions [rad or m]",
    )
    add("--position-only", action="store_true", help="ignore the orientation")
    add(
        "--tolerance",
        default=",".join(f"{number:g}" for number in TOLERANCE),
        metavar="M,RAD",
        help="distance and angle within which a pose is reached (default: %(default)s)",
    )
    add(
        "--prefer",
        choices=("nearest", "first", "manipulability"),
        help="solution to print: the one nearest to --from (default), the first one found, or the one with the highest "
        "manipulability; without this option, --targets compares the solutions of only 16 restarts",
    )
    add("--all", action="store_true", help="print all solutions found, including solutions that differ by whole turns")
    add(
        "--collision-free",
        action="store_true",
        help="return only solutions without collisions between links; adjacent links, and links that "
        "collide with all joints at zero, are not checked",
    )
    add("--restarts", type=int, default=200, metavar="N", help="random starts per pose (default: 200)")
    add("--seed", type=int, default=0, metavar="N", help="seed of all random numbers (default: 0)")
    add("--threads", type=int, metavar="N", help="threads for files of poses (default: one per processor)")
    add("-o", "--output", type=Path, metavar="FILE.npz", help="write arrays: joints, q, reached, errors, restarts")
    add("--json", action="store_true", help="print one JSON value")


def run(arguments: argparse.Namespace) -> int:
    """Solve the poses, print or write the solutions."""
    from urdfkit.cli.kinematics.ik.targets import pose_of, poses_of_file

    options = _options(arguments)
    start = joint_positions(arguments.start, "ik: --from")
    hold = joint_positions(arguments.hold, "ik: --hold")
    if arguments.output is not None and arguments.output.suffix.lower() != ".npz":
        raise UsageError(f"ik: -o {arguments.output}: unsupported file type; use .npz")
    if arguments.threads is not None and arguments.threads < 1:
        raise UsageError(f"ik: --threads {arguments.threads}: at least one thread is needed")
    pose = pose_of(arguments)
    if arguments.all and pose is None:
        raise UsageError("ik: --all needs one pose: use --xyz instead of --targets")
    robot, tip = robot_and_tip(arguments, "ik")
    if pose is not None:
        from urdfkit.cli.kinematics.ik.one_pose import solve_pose

        return solve_pose(robot, tip, pose, start, hold, options, arguments)
    require_packages("ik: --targets", "sim", {"numpy": "numpy", "numba": "numba"})
    poses = poses_of_file(arguments.targets, position_only=arguments.position_only)
    from urdfkit.cli.kinematics.ik.many_poses import solve_poses

    return solve_poses(robot, tip, poses, start, hold, options, arguments)


def _options(arguments: argparse.Namespace) -> SolverOptions:
    from dataclasses import replace

    from urdfkit.cli.kinematics.ik.targets import numbers
    from urdfkit.kinematics.serial.serial_solver import SolverOptions

    distance, angle = numbers(arguments.tolerance, 2, "--tolerance")
    prefer = "all" if arguments.all else arguments.prefer or "nearest"
    if arguments.restarts < 0:
        raise UsageError(f"ik: --restarts {arguments.restarts}: the number must not be negative")
    options = SolverOptions(arguments.position_only, distance, angle, prefer, arguments.restarts, arguments.seed)
    if arguments.prefer is None and arguments.targets is not None:
        return options
    return replace(options, further=arguments.restarts)
