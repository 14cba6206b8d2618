"""The benchmark's scenes of one robot in a whole `Simulator`, with its topics: what a user steps."""

from __future__ import annotations

from tests.bench.peers.parsed_urdf import read
from tests.bench.peers.scene import DT, GRAVITY, Pose, Running, Scene
from urdfkit.sim.construction.start_pose import Spawn
from urdfkit.sim.simulator import Simulator

SLIPPERY = '<gazebo reference="{}"><mu1>0</mu1><mu2>0</mu2></gazebo>'


def fits(scene: Scene) -> bool:
    """Whether a scene is of one robot and nothing else."""
    return len(scene.things) == 1 and not scene.loose


class InSimulator(Running):
    """A scene of one robot, see `fits`, in a `Simulator`."""

    def __init__(self, scene: Scene) -> None:
        super().__init__(scene)
        (self._thing,) = scene.things
        thing = self._thing
        slippery = "".join(SLIPPERY.format(link) for link in thing.slippery)
        start = dict(thing.poses[0]) if thing.poses else {}
        self.simulator = Simulator(
            read(thing.urdf.replace("</robot>", f"{slippery}</robot>")),
            dt=DT,
            gravity=GRAVITY,
            spawn=Spawn(*thing.at, joints=start),
            fixed_base=thing.bolted,
        )
        for joint, (speed, effort) in thing.motors.items():
            self.simulator.motors.drive(joint, speed, effort)
        self.pose(0)

    def many(self, steps: int) -> None:
        """Advance by `steps` in one call."""
        self.simulator.step(steps)

    def one_by_one(self, steps: int) -> None:
        """Advance by `steps`, each a call."""
        step = self.simulator.step
        for _ in range(steps):
            step()

    def base(self, k: int) -> Pose:
        """Return where the robot's root link is."""
        return self.simulator.state.base_pose

    def position(self, k: int, joint: str) -> float:
        """Return a joint's position [rad]."""
        return self.simulator.state.position(joint)

    def set_targets(self, k: int, number: int) -> None:
        """Set the targets of the robot's servos."""
        thing = self._thing
        for joint, (stiffness, damping, effort) in thing.servos.items():
            target = thing.poses[number][joint]
            self.simulator.motors.servo(joint, stiffness=stiffness, damping=damping, position=target, effort=effort)

    def knock(self, k: int, speed: float) -> None:
        """Knock nothing: only boxes are knocked.

        Raises:
            NotImplementedError: always.
        """
        raise NotImplementedError("scenes that knock are of boxes")

    def asleep(self) -> int | None:
        """Return None: a robot under commands never sleeps."""
        return None
