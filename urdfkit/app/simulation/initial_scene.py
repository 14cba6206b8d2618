"""Initial scene: the robot in its initial pose, on the page while the engine is compiled."""

from urdfkit.description import Robot
from urdfkit.description.sdf import World
from urdfkit.kinematics import Kinematics
from urdfkit.scene import Scene, scene_of
from urdfkit.sim.construction.loading import require_masses
from urdfkit.sim.construction.repairs.collector import DENSITY, Repairs
from urdfkit.sim.construction.repairs.robot_repairs import repaired
from urdfkit.sim.construction.start_pose import Spawn
from urdfkit.view.content.display_interface import Display


class InitialScene:
    """Scene of a robot that does not move.

    Args:
        robot: the loaded description.
        world: the world of the simulation.
        strict: refuse robots that need a repair.
        density: density for the mass of moving links without one [kg/m³].

    Raises:
        UrdfkitError: the robot cannot be simulated.

    Attributes:
        scene: shapes of the robot; the simulation uses them too.
    """

    def __init__(self, robot: Robot, world: World, *, strict: bool = False, density: float = DENSITY) -> None:
        self._robot = robot
        on_world = robot.roots()[0].name == "world"
        self.scene: Scene = scene_of(robot, strict=False)
        repairs = Repairs(lambda _: None, strict=strict, density=density)  # the simulation reports them
        robot, scene = repaired(robot, self.scene, repairs, floating=not on_world)
        self._kinematics = kinematics = Kinematics(robot, floating_base=not on_world)
        spawn = Spawn(z=0.0 if on_world else None)
        base = spawn.place(kinematics, scene, None if world.ground is None else world.ground.height)
        self._q = spawn.configuration(kinematics, base)[0]
        require_masses(kinematics, self._q, lambda _: None)

    def show(self, server: Display) -> None:
        """Show the robot on the page."""
        from urdfkit.view.content.joint_panel import joint_rows
        from urdfkit.view.content.meshcat_objects import draw, link_path

        names = self._kinematics.link_names
        server.show(
            name=self._robot.name or "robot",
            nodes=[link_path(name) for name in names],
            joints=joint_rows(self._kinematics, self._kinematics.positions(self._q)),
            root=names.index(self._kinematics.root),
            draw=lambda window: draw(self.scene, window, server.geometries),
        )
        server.publish(0.0, self._kinematics.link_poses(self._q))
