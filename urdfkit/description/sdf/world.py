"""World: gravity, models, lights and physics settings of an SDF file."""

from functools import cached_property
from pathlib import Path

from urdfkit.description.sdf.model import WorldJoint, WorldModel
from urdfkit.description.sdf.shapes import Kept, Light, Plane, Written, plugins_of
from urdfkit.description.urdf.geometry import compose, rotate, rotation_of
from urdfkit.description.urdf.robot import Plugin, Pose, Vector
from urdfkit.description.xml.source import Position
from urdfkit.record import field, record

GROUND_MU = 100.0
"""Friction coefficient of Gazebo's ground plane (gazebo_models/ground_plane/model.sdf)."""

GRAVITY: Vector = (0.0, 0.0, -9.8)
"""Default gravity of an SDF world (sdformat, world.sdf) [m/s²]."""


@record(eq=False)
class WorldRobot(Written):
    """A robot in a URDF file that the world includes.

    Attributes:
        name: name of the robot in the world.
        uri: URI in the world file.
        file: local path of the URDF file.
        pose: pose of the root link in the world.
        static: whether the robot never moves.
        kept: plugins and other elements, preserved unchanged.
        position: source position.
    """

    name: str
    uri: str
    file: str
    pose: Pose = Pose()
    static: bool = False
    kept: tuple[Kept, ...] = ()
    position: Position | None = field(default=None, repr=False)


@record
class Physics:
    """Requested simulation parameters; the defaults are sdformat's (physics.sdf).

    Attributes:
        max_step_size: time step [s].
        real_time_factor: requested ratio of simulated time to real time; 0 is unlimited.
        real_time_update_rate: steps per second of real time [1/s].
        engine: ``ode``, ``bullet``, ``dart``, ``simbody`` or ``ignored``.
        name: name of the physics profile.
        kept: engine-specific settings.
    """

    max_step_size: float = 0.001
    real_time_factor: float = 1.0
    real_time_update_rate: float = 1000.0
    engine: str = "ode"
    name: str = ""
    kept: tuple[Kept, ...] = ()


@record
class Ground:
    """A horizontal plane that does not move.

    Attributes:
        name: name of the model, used in contacts.
        height: z of the surface [m].
        mu: Coulomb friction coefficient; a contact uses the minimum of its two surfaces.
    """

    name: str = "ground_plane"
    height: float = 0.0
    mu: float = GROUND_MU


@record(eq=False)
class World(Written):
    """World of a simulation.

    Attributes:
        name: name of the world, e.g. ``empty``.
        gravity: gravitational acceleration [m/s²].
        models: all models, including the ground.
        lights: all lights.
        physics: requested simulation parameters.
        robots: robots in included URDF files.
        joints: joints between models (SDF 1.10).
        magnetic_field: magnetic field [T].
        kept: plugins, scene, gui and other elements, preserved unchanged.
        notes: notes for the user, one line each.
        files: all files that were read, the world first.
        unknown_plugins: positions of the plugins that a note reports as unknown.
        position: source position.

    Examples:
        >>> from urdfkit.description.sdf import load_world
        >>> world = load_world("house")
        >>> world.name, world.gravity
        ('house', (0.0, 0.0, -9.81))
        >>> world.model_by_name["sofa"].pose
        Pose(xyz=(-3.2, -3.3, 0.0), rpy=(0.0, 0.0, 0.0))
        >>> world.ground
        Ground(name='ground_plane', height=0.0, mu=100.0)
    """

    name: str
    gravity: Vector = GRAVITY
    models: tuple[WorldModel, ...] = ()
    lights: tuple[Light, ...] = ()
    physics: Physics = Physics()
    robots: tuple[WorldRobot, ...] = ()
    joints: tuple[WorldJoint, ...] = ()
    magnetic_field: Vector = (5.5645e-6, 22.8758e-6, -42.3884e-6)
    kept: tuple[Kept, ...] = ()
    notes: tuple[str, ...] = field(default=(), repr=False)
    files: tuple[Path, ...] = field(default=(), repr=False)
    unknown_plugins: tuple[Position, ...] = field(default=(), repr=False)
    position: Position | None = field(default=None, repr=False)

    def __repr__(self) -> str:
        """Return the name, the models and the robots."""
        names = [*(model.name for model in self.models), *(robot.name for robot in self.robots)]
        return f"<World {self.name}: {', '.join(names) or 'empty'}>"

    @cached_property
    def model_by_name(self) -> dict[str, WorldModel]:
        """Models by name."""
        return {model.name: model for model in self.models}

    @cached_property
    def plugins(self) -> tuple[Plugin, ...]:
        """Plugins of the world itself.

        Examples:
            >>> from pathlib import Path
            >>> from urdfkit.description.sdf import load_world
            >>> plugin = '<plugin filename="gz-sim-imu-system" name="gz::sim::systems::Imu"/>'
            >>> size = Path("imu.sdf").write_text(f'<sdf version="1.9"><world name="imu">{plugin}</world></sdf>')
            >>> [plugin.name for plugin in load_world("imu.sdf").plugins]
            ['gz::sim::systems::Imu']
        """
        return plugins_of(self.kept)

    @cached_property
    def ground(self) -> Ground | None:
        """The first horizontal static plane; None without one."""
        for model in self.models:
            if model.static and (ground := ground_of(model)) is not None:
                return ground
        return None


def ground_of(model: WorldModel) -> Ground | None:
    """Return the first horizontal plane that faces up among a model's collisions; None without one."""
    for _, pose, link in model.all_links():
        for shape in link.collisions:
            if isinstance(shape.geometry, Plane):
                placed = compose(compose(model.pose, pose), shape.pose)
                if rotate(rotation_of(placed.rpy), shape.geometry.normal)[2] > 1 - 1e-12:
                    return Ground(model.name, placed.xyz[2], shape.surface.mu)
    return None
