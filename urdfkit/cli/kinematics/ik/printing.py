"""Solutions as text and JSON."""

from typing import Any

from urdfkit.kinematics.serial.serial_chain import SerialChain
from urdfkit.kinematics.serial.serial_solver import SerialSolver, Solution


def solution_as_json(
    chain: SerialChain, at_limits: list[str], solution: Solution, reason: str | None
) -> dict[str, Any]:
    """Return a solution as JSON value; `reason` is null where the pose is reached."""
    names = (variable.name for variable in chain.variables)
    return {
        "reached": solution.reached,
        "positions": dict(zip(names, solution.q, strict=True)),
        "position_error": solution.position_error,
        "rotation_error": solution.rotation_error,
        "restarts": solution.restarts,
        "at_limits": at_limits,
        "collisions": None if solution.collisions is None else [list(pair) for pair in solution.collisions],
        "reason": None if solution.reached else reason,
    }


def table(
    chain: SerialChain, solver: SerialSolver, solutions: list[Solution], reason: str | None, *, position_only: bool
) -> str:
    """Return solutions as a table of joints, one column per solution, up to six."""
    best, shown = solutions[0], solutions[:6]
    errors = f"{best.position_error:.3g} m" + ("" if position_only else f" and {best.rotation_error:.3g} rad")
    if best.reached:
        several = f"{len(solutions)} solutions, nearest first; " if len(solutions) > 1 else ""
        head = f"{chain.tip} in {chain.base}: reached, {several}{errors} off"
    else:
        head = f"{chain.tip} in {chain.base}: not reached: {reason}; the nearest configuration is {errors} off"
    lines = [head]
    width = max(len(variable.name) for variable in chain.variables)
    limits = [set(solver.at_limits(solution.q)) for solution in shown]
    for k, variable in enumerate(chain.variables):
        cells = [
            f"{round(s.q[k], 6) + 0.0:>10.6f}{'*' if variable.name in at else ' '}"
            for s, at in zip(shown, limits, strict=True)
        ]
        lines.append(f"{variable.name:<{width}} {' '.join(cells)}".rstrip())
    if any(limits):
        lines.append("* at a limit")
    if len(solutions) > len(shown):
        lines.append(f"and {len(solutions) - len(shown)} more: --json prints all")
    return "\n".join(lines) + "\n"
