"""Solve one pose and print its solutions, without numpy."""

import argparse
import json
from collections.abc import Mapping, Sequence

from urdfkit.cli.kinematics.ik.printing import solution_as_json, table
from urdfkit.cli.robot_arguments.joint_positions import warn_of_limits
from urdfkit.cli.robot_arguments.robot_loading import repairs_as_json
from urdfkit.cli.robot_arguments.tip_link import announce
from urdfkit.description import Robot
from urdfkit.errors import short_lines
from urdfkit.kinematics.serial.serial_chain import SerialChain
from urdfkit.kinematics.serial.serial_solver import SerialSolver, SolverOptions

MOST = 256
"""Maximum number of solutions with --all, before whole turns."""


def solve_pose(
    robot: Robot,
    tip: str,
    pose: Sequence[float],
    start: Mapping[str, float],
    hold: Mapping[str, float],
    options: SolverOptions,
    arguments: argparse.Namespace,
) -> int:
    """Print the solution for a pose, or all; return the exit status.

    Args:
        robot: the robot.
        tip: link at the tip of the chain.
        pose: x y z and quaternion x y z w.
        start: joint positions to start from.
        hold: joint positions that are held.
        options: options of the solver.
        arguments: those of the command line.
    """
    chain = SerialChain(robot, arguments.base, tip, hold=hold)
    solver = SerialSolver(chain, None if arguments.quiet else announce)
    from_ = chain.start(start)
    warn_of_limits(robot, {**start, **hold})
    solutions = solver.solve(pose, from_, options, rows=MOST if arguments.all else 1)
    if arguments.collision_free:
        from urdfkit.kinematics.self_collision.collision_free_search import CollisionFreeSearch

        search = CollisionFreeSearch(chain)
        found = solutions[0]
        solutions = search.filtered(solutions) if arguments.all else [search.free(found, pose, from_, options)]
    if arguments.all and solutions[0].reached:
        solutions = solver.with_whole_turns(solutions, from_)
    best = solutions[0]
    reason = None if best.reached else solver.reason(pose, best, options)
    if arguments.output is not None:
        from urdfkit.cli.kinematics.ik.many_poses import write_arrays

        write_arrays(arguments.output, chain, solutions)
    if arguments.json:
        listed = [solution_as_json(chain, solver.at_limits(each.q), each, reason) for each in solutions]
        names = [variable.name for variable in chain.variables]
        values = {"base": chain.base, "tip": tip, "joints": names, "targets": 1, "reached": int(best.reached)}
        print(json.dumps(values | {"solutions": listed} | repairs_as_json(robot)))
    else:
        print(short_lines(table(chain, solver, solutions, reason, position_only=options.position_only)), end="")
    return 0 if best.reached else 1
