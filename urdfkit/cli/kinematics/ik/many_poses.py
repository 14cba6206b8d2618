"""Solve the poses of a file in threads, print a summary or JSON, and write arrays."""

import argparse
import io
import json
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from urdfkit.atomic import write_bytes
from urdfkit.cli.kinematics.ik.printing import solution_as_json
from urdfkit.cli.progress_line import ProgressLine
from urdfkit.cli.robot_arguments.joint_positions import warn_of_limits
from urdfkit.cli.robot_arguments.robot_loading import repairs_as_json
from urdfkit.cli.robot_arguments.tip_link import announce
from urdfkit.description import Robot
from urdfkit.errors import short_lines
from urdfkit.kinematics.chain import Chain
from urdfkit.kinematics.serial.serial_chain import SerialChain
from urdfkit.kinematics.serial.serial_solver import SerialSolver, Solution, SolverOptions
from urdfkit.linear_algebra import Array

BLOCK = 5000
"""Poses between two lines of progress."""
EXPLAINED = 1000
"""Maximum number of poses whose reason is computed for the summary."""


def solve_poses(
    robot: Robot,
    tip: str,
    poses: Array,
    start: Mapping[str, float],
    hold: Mapping[str, float],
    options: SolverOptions,
    arguments: argparse.Namespace,
) -> int:
    """Solve poses and print or write the solutions; return the exit status.

    Args:
        robot: the robot.
        tip: link at the tip of the chain.
        poses: shape (N, 7) or (N, 4, 4).
        start: joint positions to start from.
        hold: joint positions that are held.
        options: options of the solver.
        arguments: those of the command line.
    """
    chain = Chain(robot, arguments.base, tip, hold=hold, compiling=None if arguments.quiet else announce)
    from_ = chain.configuration(start)
    warn_of_limits(robot, {**start, **hold})
    solutions = _solved(chain, poses, from_, options, arguments)
    solver = SerialSolver(chain.serial)
    if arguments.output is not None:
        write_arrays(arguments.output, chain.serial, solutions)
        if not arguments.quiet:
            print(f"wrote {arguments.output}", file=sys.stderr)
    reached = sum(solution.reached for solution in solutions)
    if arguments.json:
        rows = [pose.ravel().tolist() for pose in poses]
        listed = [
            solution_as_json(
                chain.serial,
                solver.at_limits(solution.q),
                solution,
                None if solution.reached else solver.reason(row, solution, options),
            )
            for row, solution in zip(rows, solutions, strict=True)
        ]
        values = {"base": chain.base, "tip": tip, "joints": list(chain.joint_names), "targets": len(poses)}
        print(json.dumps(values | {"reached": reached, "solutions": listed} | repairs_as_json(robot)))
    else:
        print(short_lines(f"{tip} in {chain.base}: {reached} of {len(poses)} poses reached"))
        missed = [k for k, solution in enumerate(solutions) if not solution.reached]
        reasons = Counter(
            solver.reason(poses[k].ravel().tolist(), solutions[k], options).partition(" by ")[0].partition(":")[0]
            for k in missed[:EXPLAINED]
        )
        for reason, count in reasons.most_common():
            print(f"{count:>6} not reached: {reason}")
    return 0 if reached == len(poses) else 1


def _solved(
    chain: Chain, poses: Array, start: Array, options: SolverOptions, arguments: argparse.Namespace
) -> list[Solution]:
    """Solve poses block by block, with progress on a terminal."""
    solutions: list[Solution] = []
    with ProgressLine(quiet=arguments.quiet or len(poses) <= BLOCK) as progress:
        for first in range(0, len(poses), BLOCK):
            found = chain.solve(
                poses[first : first + BLOCK],
                start,
                position_only=options.position_only,
                tolerance=(options.distance, options.angle),
                prefer=options.prefer,
                restarts=options.restarts,
                seed=options.seed,
                threads=arguments.threads,
                collision_free=arguments.collision_free,
                further=options.further,
            )
            solutions += found.listed()
            progress(f"{len(solutions)} of {len(poses)} poses")
    return solutions


def write_arrays(path: Path, chain: SerialChain, solutions: Sequence[Solution]) -> None:
    """Write solutions as arrays to an .npz file.

    Raises:
        ResourceError: the file cannot be written.
    """
    content = io.BytesIO()
    size = len(chain.variables)
    np.savez(
        content,
        joints=np.array([variable.name for variable in chain.variables]),
        q=np.array([solution.q for solution in solutions]).reshape(len(solutions), size),
        reached=np.array([solution.reached for solution in solutions], dtype=bool),
        position_error=np.array([solution.position_error for solution in solutions]),
        rotation_error=np.array([solution.rotation_error for solution in solutions]),
        restarts=np.array([solution.restarts for solution in solutions], dtype=np.int64),
    )
    write_bytes(path, content.getvalue())
