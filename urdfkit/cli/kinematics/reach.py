"""``urdfkit reach``: the map of the positions and orientations that a link reaches. See docs/reach.md."""

from __future__ import annotations

import argparse
import json
import math
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfkit.app.page import note, require_packages, require_page
from urdfkit.cli.kinematics.ik.targets import poses_of_file
from urdfkit.cli.kinematics.robot_page import show_page
from urdfkit.cli.page_options import add_page_options
from urdfkit.cli.parser import count
from urdfkit.cli.progress_line import ProgressLine
from urdfkit.cli.robot_arguments.robot_loading import repairs_as_json
from urdfkit.cli.robot_arguments.tip_link import add_tip, announce, model_of_tip, robot_and_tip
from urdfkit.cli.sim.option_values import positive, seed
from urdfkit.errors import UsageError, short_lines

if TYPE_CHECKING:
    from urdfkit.kinematics.chain import Chain
    from urdfkit.kinematics.reach import BasePlacement, ReachMap
    from urdfkit.linear_algebra import Array

AXES = {
    f"{sign}{name}": tuple(number if k == axis else 0.0 for k in range(3))
    for axis, name in enumerate("xyz")
    for sign, number in (("", 1.0), ("+", 1.0), ("-", -1.0))
}
SHARES = (0.25, 0.5, 0.75)
"""Scores whose cells are counted in the summary."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit reach``."""
    # argparse parses `-z,30` as an option unless this pattern matches it.
    parser._negative_number_matcher = re.compile(r"^-\.?\d|^-[xyz](,|$)")
    parser.usage = (
        "urdfkit reach ROBOT [key:=value ...] TIP [--base LINK] [--resolution M] [--orientations N]\n"
        "       [--down | --cone AXIS,DEG | --position-only] [--base-for POSES] [-o FILE] [--view | --html FILE]\n"
        "       [option ...]"
    )
    parser.epilog = (
        "the score of a cell is the share of the orientations that TIP reaches at its centre, within 1 mm and 0.1°\n"
        "exit status: 0 if any pose (with --base-for: every pose) is reached, 1 if not, 2 on failure\n"
        "examples:\n"
        "  urdfkit reach seven_dof_arm grasping_frame -o reach.npz\n"
        "  urdfkit reach seven_dof_arm grasping_frame --down --tool-axis x\n"
        "  urdfkit reach panda.urdf panda_hand --cone -z,30 --resolution 0.1 --json\n"
        "  urdfkit reach panda.urdf panda_hand --resolution 0.1 --base-for poses.csv"
    )
    add = parser.add_argument
    add_tip(parser)
    add("--resolution", type=positive, default=0.05, metavar="M", help="edge of a cell [m] (default: 0.05)")
    add(
        "--orientations",
        type=count("number of orientations"),
        default=50,
        metavar="N",
        help="number of orientations, spread evenly (default: 50)",
    )
    which = parser.add_mutually_exclusive_group()
    which.add_argument(
        "--down", action="store_true", help="use only orientations with the tool axis along -z of the base"
    )
    which.add_argument(
        "--cone",
        type=_cone,
        metavar="AXIS,DEG",
        help="use only orientations with the tool axis within DEG degrees of AXIS of the base (x, -z, … or X,Y,Z)",
    )
    which.add_argument("--position-only", action="store_true", help="ignore the orientation")
    add("--tool-axis", type=_axis, metavar="AXIS", help="axis of TIP for --down and --cone (default: z)")
    add(
        "--collision-free",
        action="store_true",
        help="count only poses that are reached without collisions between links",
    )
    add("--seed", type=seed, default=0, metavar="N", help="seed of all random numbers (default: 0)")
    add(
        "--base-for",
        type=Path,
        metavar="POSES",
        help="find where to put the base link, upright on the floor, to reach the poses of a .npy, .npz or .csv file",
    )
    add("-o", "--output", type=Path, metavar="FILE", help="write the map to a .npz, .json or .ply file")
    add("--json", action="store_true", help="print one JSON value")
    add("--view", action="store_true", help="show the map in the browser, until interrupted")
    add("--html", type=Path, metavar="FILE", help="write the map as a self-contained page, which needs no server")
    add_page_options(parser)


def run(arguments: argparse.Namespace) -> int:
    """Compute the map, then print a summary and write the files."""
    if arguments.tool_axis is not None and not (arguments.down or arguments.cone):
        raise UsageError("reach: --tool-axis requires --down or --cone")
    if arguments.html is not None or arguments.view:
        require_page("reach: the page", "view", modules=("rosbags",))
    require_packages("reach", "sim", {"numpy": "numpy", "numba": "numba"})
    robot, tip = robot_and_tip(arguments, "reach")
    poses = poses_of_file(arguments.base_for, "reach: --base-for") if arguments.base_for is not None else None

    from urdfkit.kinematics.chain import Chain
    from urdfkit.kinematics.reach import base_placement, reach_map, write_map
    from urdfkit.kinematics.reach.map_files import check_file

    if arguments.output is not None:
        check_file(arguments.output)
    chain = Chain(robot, arguments.base, tip, compiling=None if arguments.quiet else announce)
    if len(chain.joint_names) < 6 and not arguments.position_only and not arguments.quiet:
        message = f"urdfkit: warning: {len(chain.joint_names)} joints move `{tip}`; with fewer than six it reaches few "
        message += "orientations; use --position-only"
        print(message, file=sys.stderr)
    with ProgressLine(quiet=arguments.quiet) as progress:
        search: dict[str, Any] = {
            "position_only": arguments.position_only,
            "collision_free": arguments.collision_free,
            "seed": arguments.seed,
            "progress": progress,
        }
        found = reach_map(chain, resolution=arguments.resolution, orientations=_orientations(arguments), **search)
        base = base_placement(chain, found, poses, **search) if poses is not None else None
    if arguments.output is not None:
        write_map(arguments.output, found)
        if not arguments.quiet:
            print(f"wrote {arguments.output}", file=sys.stderr)
    if arguments.json:
        values = _values(found) | ({} if base is None else {"base_for": _place(base, chain)})
        print(json.dumps(values | repairs_as_json(robot)), flush=True)
    elif not arguments.view:
        print(short_lines(_text(found, base)), flush=True)
    elif not arguments.quiet:
        note(_text(found, base))  # the address of the page is alone on standard output
    if arguments.html is not None or arguments.view:
        from urdfkit.app.viewer.reach_layer import reach_message

        show_page(arguments, model_of_tip(arguments), {"reach": reach_message(found)})
    return 0 if (found.reached.any() if base is None else base.reached.all()) else 1


def _orientations(arguments: argparse.Namespace) -> int | Array:
    from urdfkit.kinematics.reach import cone_orientations, down_orientations

    tool_axis = arguments.tool_axis or AXES["z"]
    if arguments.down:
        return down_orientations(arguments.orientations, tool_axis)
    if arguments.cone is not None:
        axis, degrees = arguments.cone
        return cone_orientations(arguments.orientations, axis, degrees, tool_axis)
    return int(arguments.orientations)


def _values(found: ReachMap) -> dict[str, Any]:
    import numpy as np

    cells = int((found.score > 0.0).sum())
    best = np.unravel_index(int(np.argmax(found.score)), found.score.shape)
    return {
        "base": found.base,
        "tip": found.tip,
        "joints": list(found.joint_names),
        "resolution": found.resolution,
        "origin": found.origin.tolist(),
        "shape": list(found.score.shape),
        "orientations": len(found.orientations),
        "cells": cells,
        "volume": cells * found.resolution**3,
        "reached": int(found.reached.sum()),
        "mean_score": float(found.score[found.score > 0.0].mean()) if cells else 0.0,
        "cells_by_score": {f"{share:g}": int((found.score >= share).sum()) for share in SHARES},
        "best": {
            "position": found.centres()[best].tolist(),
            "score": float(found.score[best]),
            "manipulability": float(found.manipulability[best]),
        },
    }


def _place(base: BasePlacement, chain: Chain) -> dict[str, Any]:
    """Return a place of the base as JSON."""
    solutions = [
        {"reached": bool(reached), "positions": dict(zip(chain.joint_names, q, strict=True)) if reached else None}
        for reached, q in zip(base.reached, base.q.tolist(), strict=True)
    ]
    place = {"position": [base.x, base.y, 0.0], "yaw": base.yaw, "poses": len(solutions)}
    return place | {"reached": base.rank[0], "manipulability": base.manipulability, "solutions": solutions}


def _text(found: ReachMap, base: BasePlacement | None) -> str:
    values = _values(found)
    count = values["orientations"]
    head = f"{found.tip} in {found.base}: {values['cells']} cells of {found.resolution:g} m reached"
    if not values["cells"]:
        return f"{found.tip} reaches no cell of {found.resolution:g} m in {found.base}"
    low = found.origin
    high = [corner + found.resolution * count for corner, count in zip(low, found.score.shape, strict=True)]
    best = values["best"]
    shares = ", ".join(f"{values['cells_by_score'][f'{share:g}']} of {share:g} or more" for share in SHARES)
    place = ""
    if base is not None:
        reached = f"{base.rank[0]} of {len(base.reached)} poses reached"
        place = f"\nput {found.base} at ({_numbers([base.x, base.y, 0.0])}) m, yaw {base.yaw:.4g} rad: {reached}"
    return (
        f"{head}, {values['volume']:.3g} m³\n"
        f"box from ({_numbers(low)}) to ({_numbers(high)}) m\n"
        f"score: share of {count} orientations; mean {values['mean_score']:.2f}; cells with {shares}\n"
        f"best cell ({_numbers(best['position'])}) m: score {best['score']:.2f}, "
        f"manipulability {best['manipulability']:.3g}{place}"
    )


def _numbers(values: Any) -> str:
    return ", ".join(f"{value:.4g}" for value in [round(float(value), 9) + 0.0 for value in values])


def _axis(text: str) -> tuple[float, float, float]:
    """Return an axis: x, -z, … or three numbers."""
    if text in AXES:
        return AXES[text]  # type: ignore[return-value]
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        x = y = z = math.nan
    if not math.isfinite(x + y + z) or not (x or y or z):
        raise argparse.ArgumentTypeError(f"`{text}` is not an axis; use x, y, z, -x, -y, -z or X,Y,Z")
    return x, y, z


def _cone(text: str) -> tuple[tuple[float, float, float], float]:
    axis, comma, angle = text.rpartition(",")
    try:
        degrees = float(angle)
    except ValueError:
        degrees = math.nan
    if not comma or not 0.0 <= degrees <= 180.0:
        raise argparse.ArgumentTypeError(f"`{text}` must be AXIS,DEG with an angle from 0 to 180, such as -z,30")
    return _axis(axis), degrees
