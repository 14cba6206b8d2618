"""``urdfkit jacobian``: the Jacobian of a link. It prints singular values and the direction of motion that is lost."""

from __future__ import annotations

import argparse
import json
import math
from typing import TYPE_CHECKING

from urdfkit.app.page import require_packages
from urdfkit.cli.robot_arguments.joint_positions import joint_positions, warn_of_limits
from urdfkit.cli.robot_arguments.robot_loading import repairs_as_json
from urdfkit.cli.robot_arguments.tip_link import add_tip, announce, robot_and_tip
from urdfkit.errors import short_lines

if TYPE_CHECKING:
    from urdfkit.kinematics.jacobian_analysis import JacobianAnalysis
    from urdfkit.linear_algebra import Array


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit jacobian``."""
    parser.usage = "urdfkit jacobian ROBOT [key:=value ...] TIP [--base LINK] [--joint name=value ...] [--json]"
    parser.epilog = (
        "rows: linear x y z, angular x y z of TIP, in the axes of the base link; columns: the joints of the chain\n"
        "examples:\n"
        "  urdfkit jacobian seven_dof_arm wrist_roll_link --joint elbow_pan_joint=1.2\n"
        "  urdfkit jacobian panda.urdf panda_hand --base panda_link0 --json"
    )
    add_tip(parser)
    parser.add_argument(
        "--joint",
        nargs="+",
        action="extend",
        default=[],
        metavar="name=value",
        help="joint positions in rad or m; the default is zero",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON value")


def run(arguments: argparse.Namespace) -> int:
    """Print the Jacobian."""
    require_packages("jacobian", "sim", {"numpy": "numpy", "numba": "numba"})
    positions = joint_positions(arguments.joint, "jacobian: --joint")
    robot, tip = robot_and_tip(arguments, "jacobian")

    from urdfkit.kinematics.chain import Chain
    from urdfkit.kinematics.jacobian_analysis import SINGULAR, analyse, direction_in_words

    chain = Chain(robot, arguments.base, tip, compiling=None if arguments.quiet else announce)
    chain.configuration(positions)  # refuses unknown names
    q = [positions.get(name, 0.0) for name in chain.joint_names]
    warn_of_limits(robot, positions)
    jacobian = chain.jacobian(q)
    analysis = analyse(jacobian)
    lost = [direction_in_words(direction, chain.base) for direction in analysis.lost]
    if arguments.json:
        values = {
            "base": chain.base,
            "tip": tip,
            "joints": list(chain.joint_names),
            "positions": dict(zip(chain.joint_names, q, strict=True)),
            "jacobian": jacobian.tolist(),
            "singular_values": analysis.singular_values.tolist(),
            "rank": analysis.rank,
            "singular": analysis.is_singular,
            "threshold": SINGULAR,
            "manipulability": analysis.manipulability,
            "condition": analysis.condition if math.isfinite(analysis.condition) else None,
            "lost": [
                {"direction": direction.tolist(), "words": words}
                for direction, words in zip(analysis.lost, lost, strict=True)
            ],
        }
        print(json.dumps(values | repairs_as_json(robot)))
    else:
        print(short_lines(_text(chain.joint_names, jacobian, analysis, lost, f"{tip} in {chain.base}")))
    return 0


def _text(names: tuple[str, ...], jacobian: Array, analysis: JacobianAnalysis, lost: list[str], head: str) -> str:
    width = max(len(name) for name in names)
    columns = ("vx", "vy", "vz", "wx", "wy", "wz")
    lines = [f"Jacobian of {head}, linear and angular velocity per joint"]
    lines.append(" ".join([" " * width, *(f"{column:>9}" for column in columns)]))
    for k, name in enumerate(names):
        lines.append(" ".join([f"{name:<{width}}", *(f"{number + 0.0:>9.4f}" for number in jacobian[:, k].round(4))]))
    values = " ".join(f"{value:.4g}" for value in analysis.singular_values.round(12))
    lines.append(f"singular values {values}")
    # In a singular configuration, both depend on rounding errors only.
    product, ratio = (0.0, math.inf) if analysis.is_singular else (analysis.manipulability, analysis.condition)
    lines.append(
        f"rank {analysis.rank} of {len(analysis.singular_values)}, manipulability {product:.4g}, condition {ratio:.4g}"
    )
    lines += [f"singular: no {words}" for words in lost]
    return "\n".join(lines)
