"""Sleep of a robot that is alone on its plane, by the criteria of worlds.

Its contacts and their impulses stay where the last step left them, so that they are reported, and found again when the
robot wakes. Only a change from outside wakes it, between two calls: nothing else can touch it.
"""

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.dynamics.odometry import update_odometry_at_rest
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import AT_REST, DT, OBSERVED, STEPS
from urdfkit.sim.engine.sleep.sleep_criteria import PATIENCE, is_left_alone, is_quiet
from urdfkit.sim.engine.sleep.tree_rest import gravity_changed, is_disturbed, stop


@compiled
def wake_if_disturbed(w: KernelWorld) -> None:
    """Wake the robot if it was moved or has new targets, or if gravity has changed, since the last call."""
    changed = gravity_changed(w)
    if w.asleep[0] != 0 and (changed or is_disturbed(w, 0)):
        w.asleep[0] = 0
        for k in range(OBSERVED):
            w.still[k] = 0.0


@compiled
def let_robot_sleep(w: KernelWorld, contacts: int) -> None:
    """Let the robot sleep if it has been at rest for long enough. What floats and touches nothing is on its way."""
    if not is_left_alone(w, 0):
        w.still[AT_REST] = 0.0
        return
    dt = w.numbers[DT]
    w.still[AT_REST] = w.still[AT_REST] + dt if is_quiet(w, 0) else 0.0
    if w.still[AT_REST] >= PATIENCE and (contacts > 0 or w.tree_floats[0] == 0):
        w.asleep[0] = 1
        stop(w, 0)


@compiled
def pass_time(w: KernelWorld, steps: int) -> None:
    """Advance the time of the sleeping robot."""
    w.counts[STEPS] += steps
    update_odometry_at_rest(w, 0, w.counts[STEPS])
