"""Robot: links, joints and their properties as in the description, before any computation.

The records are lenient: a value that is missing or could not be read is ``None`` (and listed in
`Robot.problems`). SI units: [m] [rad] [kg] [kg·m²] [N] [N·m] [m/s] [rad/s].
"""

from __future__ import annotations

from functools import cached_property
from pathlib import Path

from urdfkit.description.urdf.joint import JOINT_TYPES as JOINT_TYPES
from urdfkit.description.urdf.joint import Calibration as Calibration
from urdfkit.description.urdf.joint import Dynamics as Dynamics
from urdfkit.description.urdf.joint import Joint as Joint
from urdfkit.description.urdf.joint import Limit as Limit
from urdfkit.description.urdf.joint import Mimic as Mimic
from urdfkit.description.urdf.joint import SafetyController as SafetyController
from urdfkit.description.urdf.shapes import Box as Box
from urdfkit.description.urdf.shapes import Capsule as Capsule
from urdfkit.description.urdf.shapes import Cylinder as Cylinder
from urdfkit.description.urdf.shapes import Geometry as Geometry
from urdfkit.description.urdf.shapes import Mesh as Mesh
from urdfkit.description.urdf.shapes import Pose as Pose
from urdfkit.description.urdf.shapes import Sphere as Sphere
from urdfkit.description.urdf.shapes import Vector as Vector
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Origin
from urdfkit.record import field, record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any, Literal

    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.urdf.repair_record import Repair

    ProblemKind = Literal[
        "bad-number", "wrong-arity", "not-finite", "missing", "unknown-value", "conflict", "zero", "version"
    ]


@record(eq=False)
class Material:
    """A colour and/or texture. `rgba` components are in 0..1."""

    name: str | None
    rgba: tuple[float, float, float, float] | None
    texture: str | None
    element: Element = field(repr=False)


@record(eq=False)
class Visual:
    """Appearance of a link. `geometry` is None when it is missing or unreadable."""

    name: str | None
    origin: Pose
    geometry: Geometry | None
    material: Material | None
    element: Element = field(repr=False)


@record(eq=False)
class Collision:
    """Collision shape of a link. `geometry` is None when it is missing or unreadable."""

    name: str | None
    origin: Pose
    geometry: Geometry | None
    element: Element = field(repr=False)


@record(eq=False)
class Inertia:
    """The tensor about the centre of mass, in the inertial frame [kg·m²]."""

    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    element: Element = field(repr=False)

    @property
    def rows(self) -> tuple[Vector, Vector, Vector]:
        """The tensor as a matrix, by rows."""
        return (self.ixx, self.ixy, self.ixz), (self.ixy, self.iyy, self.iyz), (self.ixz, self.iyz, self.izz)


@record(eq=False)
class Inertial:
    """Mass [kg], centre of mass (`origin`) and inertia tensor of a link."""

    origin: Pose
    mass: float | None
    inertia: Inertia | None
    element: Element = field(repr=False)


@record(eq=False)
class Link:
    """A rigid body."""

    name: str
    inertial: Inertial | None
    visuals: tuple[Visual, ...]
    collisions: tuple[Collision, ...]
    element: Element = field(repr=False)


@record(eq=False)
class TransmissionJoint:
    """A joint of a transmission and the hardware interfaces written inside it."""

    name: str | None
    hardware_interfaces: tuple[str, ...]
    element: Element = field(repr=False)


@record(eq=False)
class Actuator:
    """An actuator of a transmission."""

    name: str | None
    hardware_interfaces: tuple[str, ...]
    mechanical_reduction: float | None
    element: Element = field(repr=False)


@record(eq=False)
class Transmission:
    """A ``<transmission>`` of ros_control."""

    name: str | None
    type: str | None
    joints: tuple[TransmissionJoint, ...]
    actuators: tuple[Actuator, ...]
    element: Element = field(repr=False)


@record(eq=False)
class Plugin:
    """A ``<plugin>`` inside ``<gazebo>`` or inside a sensor; parameters are its element's children."""

    name: str | None
    filename: str | None
    element: Element = field(repr=False)


@record(eq=False)
class SensorTag:
    """A ``<sensor>`` inside ``<gazebo reference=…>``."""

    name: str | None
    type: str | None
    plugins: tuple[Plugin, ...]
    element: Element = field(repr=False)


@record(eq=False)
class GazeboBlock:
    """A ``<gazebo>`` extension. `reference` names a link or joint; None for model-level blocks."""

    reference: str | None
    plugins: tuple[Plugin, ...]
    sensors: tuple[SensorTag, ...]
    element: Element = field(repr=False)


@record(eq=False)
class Ros2Control:
    """A ``<ros2_control>`` block; hardware and joints are read from its element."""

    name: str | None
    type: str | None
    element: Element = field(repr=False)


@record(eq=False)
class Problem:
    """Defect that the lenient reader skipped.

    Attributes:
        kind: category of the problem.
        message: one line for the user.
        element: the element that has the problem.
        attribute: the affected attribute; None for the element as a whole or its text.
    """

    kind: ProblemKind
    message: str
    element: Element = field(repr=False)
    attribute: str | None = None

    @property
    def origin(self) -> Origin:
        """Source position of the element, and the macro calls that produced it."""
        return self.element.origin


@record(eq=False)
class Robot:
    """A robot as in its description; may be invalid (see `problems`, `roots`, `cycles`).

    `links` and `joints` keep document order and duplicates. `files` are all files that were read, the entry first;
    `packages` resolves the URIs of its meshes; `arguments` are the xacro arguments. `load` sets all three. `repairs`
    are the changes to a defective robot.

    Examples:
        >>> import urdfkit
        >>> robot = urdfkit.load("simpleton")
        >>> [joint.name for joint in robot.joints if joint.type == "continuous"]
        ['left_wheel_joint', 'right_wheel_joint']
        >>> [link.name for link in robot.roots()], list(robot.root_by_name)
        (['base_footprint'], ['base_footprint'])
        >>> robot.joint_by_name["left_wheel_joint"].axis
        (0.0, 1.0, 0.0)
        >>> [joint.child for joint in robot.children_of["chassis"]]
        ['left_wheel', 'right_wheel', 'caster', 'camera']
        >>> [joint.parent for joint in robot.parents_of["chassis"]]
        ['base_footprint']
        >>> robot.link_by_name["chassis"].inertial.mass  # [kg]
        1.0
        >>> len(robot.link_by_name_in_order())
        7
    """

    name: str | None
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    materials: tuple[Material, ...]
    transmissions: tuple[Transmission, ...]
    gazebo: tuple[GazeboBlock, ...]
    ros2_control: tuple[Ros2Control, ...]
    problems: tuple[Problem, ...]
    element: Element = field(repr=False)
    files: tuple[Path, ...] = ()
    packages: Packages | None = field(default=None, repr=False)
    arguments: Mapping[str, str] = field(default_factory=dict, repr=False)
    repairs: tuple[Repair, ...] = field(default=(), repr=False)

    def __repr__(self) -> str:
        """Return the name, the file and the numbers of links and joints."""
        file = f" from {self.files[0]}" if self.files else ""
        return f"<Robot {self.name}{file}: {len(self.links)} links, {len(self.joints)} joints>"

    @cached_property
    def link_by_name(self) -> dict[str, Link]:
        """Links by name; the first of duplicates."""
        return {link.name: link for link in reversed(self.links)}

    @cached_property
    def joint_by_name(self) -> dict[str, Joint]:
        """Joints by name; the first of duplicates."""
        return {joint.name: joint for joint in reversed(self.joints)}

    @cached_property
    def parents_of(self) -> dict[str, list[Joint]]:
        """Link name → joints that have it as child."""
        found: dict[str, list[Joint]] = {}
        for joint in self.joints:
            if joint.child is not None:
                found.setdefault(joint.child, []).append(joint)
        return found

    @cached_property
    def children_of(self) -> dict[str, list[Joint]]:
        """Link name → joints that have it as parent."""
        found: dict[str, list[Joint]] = {}
        for joint in self.joints:
            if joint.parent is not None:
                found.setdefault(joint.parent, []).append(joint)
        return found

    def roots(self) -> list[Link]:
        """Return the links that are the child of no joint, in document order. A loadable robot has exactly one."""
        return list(self.root_by_name.values())

    @cached_property
    def root_by_name(self) -> dict[str, Link]:
        """Root links by name, in document order."""
        return {link.name: link for link in self.link_by_name_in_order() if link.name not in self.parents_of}

    def link_by_name_in_order(self) -> list[Link]:
        """Return the links in document order without duplicates."""
        first = self.link_by_name
        return [link for link in self.links if first[link.name] is link]

    def to_yourdfpy(self, **options: Any) -> Any:
        """Return the robot as ``yourdfpy.URDF``; its meshes are found as ours are.

        As in yourdfpy, planar and floating joints do not move. A capsule becomes a cylinder and two spheres.

        Args:
            options: those of ``yourdfpy.URDF``, such as ``load_meshes``.

        Raises:
            MissingDependencyError: yourdfpy is not installed.
            ResourceError: yourdfpy cannot read a mesh.

        Examples:
            >>> import urdfkit
            >>> urdf = urdfkit.load("simpleton").to_yourdfpy(load_meshes=False)
            >>> urdf.actuated_joint_names
            ['left_wheel_joint', 'right_wheel_joint']
        """
        from urdfkit.description.urdf.yourdfpy_export import yourdfpy_of

        return yourdfpy_of(self, **options)
