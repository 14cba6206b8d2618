"""``urdfkit srdf``: groups and disabled collisions for MoveIt."""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfkit.app.page import require_page
from urdfkit.cli.kinematics.robot_page import show_page
from urdfkit.cli.page_options import add_page_options
from urdfkit.cli.parser import count
from urdfkit.cli.progress_line import ProgressLine
from urdfkit.cli.robot_arguments.robot_loading import add_robot_options, load_with_notes, named_robot, repairs_as_json
from urdfkit.cli.sim.option_values import seed
from urdfkit.errors import ResourceError, UsageError
from urdfkit.missing_files import missing_path

if TYPE_CHECKING:
    from urdfkit.kinematics.self_collision import CollisionMatrix
    from urdfkit.kinematics.srdf import EndEffector, PlanningGroup


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit srdf``."""
    parser.usage = (
        "urdfkit srdf ROBOT [key:=value ...] [--group NAME=BASE:TIP ...] [--update OLD.srdf] [-o FILE]\n"
        "       [--view | --html FILE] [option ...]"
    )
    parser.epilog = (
        "reasons for disabling a pair: Adjacent (a joint connects the links),\n"
        "  Default (they collide at zero positions),\n"
        "  Always or Never (they collide in every sample, or in none)\n"
        "examples:\n"
        "  urdfkit srdf seven_dof_arm -o seven_dof_arm.srdf\n"
        "  urdfkit srdf arm.urdf --group arm=base_link:tool0 --samples 500000\n"
        "  urdfkit srdf arm.urdf --update config/arm.srdf"
    )
    parser.add_argument(
        "words", nargs="+", metavar="ROBOT", help="a .urdf or .xacro file, a package folder or a robot name"
    )
    parser.add_argument(
        "--group",
        action="append",
        default=[],
        type=_group,
        metavar="NAME=BASE:TIP",
        help="planning group of the chain from BASE to TIP, instead of automatic groups (repeatable)",
    )
    parser.add_argument(
        "--samples",
        type=count("number of configurations"),
        default=100_000,
        metavar="N",
        help="random configurations (default: 100000)",
    )
    parser.add_argument("--seed", type=seed, default=0, metavar="N", help="seed of all random numbers (default: 0)")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="write the SRDF (default: standard output)")
    parser.add_argument(
        "--update",
        type=Path,
        metavar="OLD.srdf",
        help="replace the disabled pairs of this SRDF; keep pairs with other reasons, groups and comments",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON value, with the samples of each pair")
    parser.add_argument("--view", action="store_true", help="show the pairs in the browser, until interrupted")
    parser.add_argument(
        "--html", type=Path, metavar="FILE", help="write the pairs as a self-contained page, which needs no server"
    )
    add_robot_options(parser)
    add_page_options(parser)


def run(arguments: argparse.Namespace) -> int:
    """Compute the collisions, then print or write the SRDF."""
    if arguments.update is not None and arguments.group:
        raise UsageError("srdf: --group cannot be combined with --update, which keeps the groups of the file")
    shows = arguments.view or arguments.html is not None
    if shows:
        require_page("srdf: the page", "view", modules=("rosbags",))
    old = _read(arguments.update) if arguments.update is not None else None
    from urdfkit.description.xml.cost_limit import loading_limit
    from urdfkit.kinematics.pinocchio_requirement import require_pinocchio

    require_pinocchio("srdf")
    from urdfkit.kinematics.self_collision import collision_matrix
    from urdfkit.kinematics.srdf import find_groups, group_of_chain, missing_links, new_srdf, updated_srdf

    found = named_robot(arguments.words, arguments)
    with loading_limit():
        robot = load_with_notes(found, arguments)
    if old is not None and (missing := missing_links(old, robot, str(arguments.update))):
        names = ", ".join([*(f"`{name}`" for name in missing[:8]), *("…" for _ in missing[8:9])])
        _note(
            f"{arguments.update}: robot `{robot.name}` has no link {names}; "
            "pairs that urdfkit disabled are removed; other lines are unchanged"
        )
    effectors: list[EndEffector] = []
    if arguments.group:
        groups = [group_of_chain(robot, *words) for words in arguments.group]
    else:
        groups, effectors = find_groups(robot)
    with ProgressLine(quiet=arguments.quiet, period=0.1) as line:

        def progress(done: int, total: int) -> None:
            line(f"{done} of {total} pairs of links")

        matrix = collision_matrix(robot, samples=arguments.samples, seed=arguments.seed, note=_note, progress=progress)
    if old is not None:
        text = updated_srdf(old, matrix, str(arguments.update))
    else:
        text = new_srdf(robot.name or "", groups, effectors, matrix, robot.roots()[0].name)
    output = arguments.output or arguments.update
    if output is not None:
        from urdfkit.atomic import write_bytes

        write_bytes(output, text.encode())
    if arguments.json:
        print(json.dumps(_values(matrix, groups, effectors) | repairs_as_json(robot)), flush=True)
    elif output is None and not shows:
        print(text, end="")
    if not arguments.quiet:
        counts = Counter(pair.reason or "to check" for pair in matrix.pairs)
        summary = ", ".join(f"{count} {reason}" for reason, count in sorted(counts.items()))
        written, count = f"wrote {output}: " if output is not None else "", len(matrix.pairs)
        print(f"{written}{count} pair{'s' * (count != 1)} of links{summary and ': '}{summary}", file=sys.stderr)
    if shows:
        values = _values(matrix, groups, effectors)
        show_page(arguments, found, {"collisions": {name: values[name] for name in ("links", "pairs")}})
    return 0


def _read(file: Path) -> str:
    try:
        return file.read_text("utf-8")
    except FileNotFoundError:
        raise ResourceError(f"srdf: --update: {missing_path(file)}") from None
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "not UTF-8 text"
        raise ResourceError(f"srdf: --update {file}: {reason}") from None


def _values(matrix: CollisionMatrix, groups: list[PlanningGroup], effectors: list[EndEffector]) -> dict[str, Any]:
    return {
        "links": list(matrix.links),
        "groups": [
            {"name": group.name, "base": group.base or None, "tip": group.tip or None, "joints": list(group.joints)}
            for group in groups
        ],
        "end_effectors": [
            {"name": each.name, "parent_link": each.parent, "group": each.group, "parent_group": each.parent_group}
            for each in effectors
        ],
        "pairs": [
            {
                "links": [pair.first, pair.second],
                "reason": pair.reason,
                "samples": pair.samples,
                "hits": pair.hits,
                "rate_bound": pair.rate_bound,
                "distance": pair.distance,
                "collision": pair.collision,
            }
            for pair in matrix.pairs
        ],
    }


def _note(text: str) -> None:
    print(f"urdfkit: warning: {text}", file=sys.stderr)


def _group(text: str) -> tuple[str, str, str]:
    name, equals, links = text.partition("=")
    base, colon, tip = links.partition(":")
    if not (name and equals and base and colon and tip):
        raise argparse.ArgumentTypeError(f"`{text}` must be NAME=BASE:TIP")
    return name, base, tip
