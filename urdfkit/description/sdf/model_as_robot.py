"""Convert models of a world to robots: trees of links and joints with URDF's joint frames.

In SDF a joint has a pose in its child link; in URDF the frame of the child link is the joint frame. If the two frames
differ, a massless link named after the joint with the suffix ``_frame`` is inserted between joint and child link, so
that every link keeps its frame from the file.
"""

from collections.abc import Callable, Sequence
from math import isinf

from urdfkit.description.sdf.link_groups import Group, ends_of
from urdfkit.description.sdf.model import WorldAxis, WorldJoint, WorldLink, WorldModel
from urdfkit.description.sdf.shapes import Kept
from urdfkit.description.urdf.extensions import plugins_in
from urdfkit.description.urdf.geometry import IDENTITY, between, compose
from urdfkit.description.urdf.robot import (
    Dynamics,
    GazeboBlock,
    Inertia,
    Inertial,
    Joint,
    Limit,
    Link,
    Mimic,
    Pose,
    Robot,
    SensorTag,
    Vector,
)
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Origin, Position
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.record import record

MOVES = ("revolute", "continuous", "prismatic")
"""The movable SDF joint types that urdfkit simulates."""

ANCHOR = "anchor"
"""Name of the root link of a tree with a fixed base; its frame is the model frame."""


@record(eq=False)
class Tree:
    """Tree of a model's links, connected by joints.

    Attributes:
        name: name of the model, with ``::`` and the name of the first link if the model has several trees.
        prefix: ``nested::`` for a tree inside a nested model; omitted from names in `robot`.
        robot: links without shapes, joints and plugins; names are relative to `prefix`.
        root: pose of the root link in the model.
        fixed_base: whether the base is fixed to the world.
        links: name in `robot` → link in the file, with its shapes.
        poses: name in `robot` → pose in the model with every joint at zero.
        self_collide: names in `robot` of the links that collide with the others.
        weightless: names in `robot` of the links without gravity.
    """

    name: str
    prefix: str
    robot: Robot
    root: Pose
    fixed_base: bool
    links: dict[str, WorldLink]
    poses: dict[str, Pose]
    self_collide: frozenset[str]
    weightless: frozenset[str]


def tree_of(model: WorldModel, group: Group) -> Tree:
    """Return a group of links as a robot.

    Args:
        model: a model of a world.
        group: a group of its links, as `groups_of` returns it.

    Raises:
        SimulationError: a joint type is not simulated, or joints form a loop; with the position.
    """
    prefix = _common_prefix([name for name, _, _ in group.links])
    builder = _Builder(model, group, prefix)
    builder.grow()
    return Tree(
        group.name,
        prefix,
        Robot(
            model.name,
            tuple(builder.links),
            tuple(builder.joints),
            (),
            (),
            tuple(_blocks(model, group, prefix)),
            (),
            (),
            _element("model", model.position),
        ),
        IDENTITY if group.fixed_base else group.links[0][1],
        group.fixed_base,
        {name[len(prefix) :]: link for name, _, link in group.links},
        {name[len(prefix) :]: pose for name, pose, _ in group.links},
        _named(group, prefix, lambda link: model.self_collide if link.self_collide is None else link.self_collide),
        _named(group, prefix, lambda link: not link.gravity),
    )


def _named(group: Group, prefix: str, holds: Callable[[WorldLink], bool]) -> frozenset[str]:
    return frozenset(name[len(prefix) :] for name, _, link in group.links if holds(link))


class _Builder:
    """Builder of a tree, from the root along the joints."""

    def __init__(self, model: WorldModel, group: Group, prefix: str) -> None:
        self._model, self._group, self._prefix = model, group, prefix
        self._poses = {name: pose for name, pose, _ in group.links}
        self._written = {name: link for name, _, link in group.links}
        self.links: list[Link] = []
        self.joints: list[Joint] = []

    def grow(self) -> None:
        model, group = self._model, self._group
        if group.fixed_base:
            root, names = ANCHOR, {name[len(self._prefix) :] for name in self._written}
            while root in names:
                root += "_"
            self._anchor = root
            self.links.append(Link(root, None, (), (), _element("link", model.position)))
            reached, stack = {"world"}, ["world"]
        else:
            root = group.links[0][0]
            self._add(root)
            reached, stack = {root}, [root]
        left = list(group.joints)
        while stack:
            here = stack.pop()
            for each in [each for each in left if here in ends_of(*each)]:
                left.remove(each)
                parent, child = ends_of(*each)
                beyond = child if here == parent else parent
                if beyond in reached:
                    raise SimulationError(
                        f"joint `{each[1].name}` of model `{model.name}` closes a loop, which cannot be simulated: "
                        "remove one of its joints",
                        position=each[1].position,
                    )
                reached.add(beyond)
                stack.append(beyond)
                self._join(each, here, beyond, reverse=here != parent)

    def _join(self, each: tuple[str, WorldJoint], here: str, beyond: str, *, reverse: bool) -> None:
        prefix, joint = each
        name = (prefix + joint.name)[len(self._prefix) if prefix.startswith(self._prefix) else 0 :]
        element = _element("joint", joint.position)
        start = IDENTITY if here == "world" else self._poses[here]
        end = self._poses[beyond]
        parent = self._anchor if here == "world" else here[len(self._prefix) :]
        child = beyond[len(self._prefix) :]
        if joint.type == "fixed":
            self.joints.append(_plain(name, "fixed", parent, child, between(start, end), element))
            self._add(beyond)
            return
        axis = _axis_of(self._model, joint)
        frame = compose(self._poses[ends_of(*each)[1]], joint.pose)
        x, y, z = axis.xyz
        direction = (-x, -y, -z) if reverse else axis.xyz
        offset = between(frame, end) if reverse or joint.pose != IDENTITY else IDENTITY
        carried = child if offset == IDENTITY else f"{name}_frame"
        mimic = self._mimic(prefix, joint, axis, element)
        origin = between(start, frame)
        self.joints.append(_moving(name, joint, axis, direction, parent, carried, origin, mimic, element))
        if carried != child:
            self.links.append(Link(carried, None, (), (), element))
            self.joints.append(_plain(f"{name}_frame_joint", "fixed", carried, child, offset, element))
        self._add(beyond)

    def _mimic(self, prefix: str, joint: WorldJoint, axis: WorldAxis, element: Element) -> Mimic | None:
        """Return the mimic relation of a joint in the form of URDF."""
        if axis.mimic is None:
            return None
        joints = {before + other.name: other for before, other in self._group.joints}
        met, leader = [prefix + joint.name], prefix + axis.mimic.joint
        while leader not in met:
            found = joints.get(leader)
            if found is None or found.type == "fixed" or not found.axes:
                hint = did_you_mean(leader, [name for name, each in joints.items() if each.type != "fixed"])
                raise self._cannot(joint, f"follows `{leader}`, which is not a moving joint of the same tree" + hint)
            if found.axes[0].mimic is None:
                break
            met.append(leader)
            leader = leader[: len(leader) - len(found.name)] + found.axes[0].mimic.joint
        else:
            raise self._cannot(joint, f"follows itself through {', '.join(f'`{name}`' for name in met)}")
        name, own = prefix + axis.mimic.joint, axis.mimic
        name = name.removeprefix(self._prefix)
        return Mimic(name, own.multiplier, own.offset - own.multiplier * own.reference, element)

    def _cannot(self, joint: WorldJoint, what: str) -> SimulationError:
        return SimulationError(f"joint `{joint.name}` of model `{self._model.name}` {what}", position=joint.position)

    def _add(self, name: str) -> None:
        link = self._written[name]
        element = _element("link", link.position)
        self.links.append(Link(name[len(self._prefix) :], inertial_of(link), (), (), element))


def inertial_of(link: WorldLink) -> Inertial:
    """Return the mass properties of a link in the form of URDF."""
    body, element = link.inertial, _element("inertial", link.position)
    tensor = Inertia(body.ixx, body.ixy, body.ixz, body.iyy, body.iyz, body.izz, element)
    return Inertial(body.pose, body.mass, tensor, element)


def _plain(name: str, kind: str, parent: str, child: str, origin: Pose, element: Element) -> Joint:
    return Joint(name, kind, parent, child, origin, (1.0, 0.0, 0.0), None, None, None, None, None, element)


def _moving(
    name: str,
    joint: WorldJoint,
    axis: WorldAxis,
    direction: Vector,
    parent: str,
    child: str,
    origin: Pose,
    mimic: Mimic | None,
    element: Element,
) -> Joint:
    is_continuous = isinf(axis.lower) and isinf(axis.upper)
    kind = "continuous" if joint.type != "prismatic" and is_continuous else joint.type.replace("continuous", "revolute")
    limit = Limit(axis.lower, axis.upper, _written(axis.effort), _written(axis.velocity), element)
    dynamics = Dynamics(axis.damping, axis.friction, element)
    return Joint(name, kind, parent, child, origin, direction, limit, dynamics, mimic, None, None, element)


def _written(limit: float) -> float | None:
    return None if isinf(limit) else limit


def _axis_of(model: WorldModel, joint: WorldJoint) -> WorldAxis:
    if joint.type not in MOVES:
        message = f"joint `{joint.name}` of model `{model.name}` is {joint.type}, which cannot be simulated: "
        message += f"{', '.join(('fixed', *MOVES))} can"
        raise SimulationError(message, position=joint.position)
    axis = joint.axes[0]
    if axis.spring_stiffness:
        raise SimulationError(
            f"joint `{joint.name}` of model `{model.name}` has a spring of {axis.spring_stiffness:g}, which cannot be "
            "simulated: remove <spring_stiffness>",
            position=joint.position,
        )
    return axis


def _common_prefix(names: Sequence[str]) -> str:
    """Return the common prefix ``nested::`` of all names; empty without one."""
    prefix = ""
    while True:
        first, separator, _ = names[0][len(prefix) :].partition("::")
        if not separator or not all(name.startswith(f"{prefix}{first}::") for name in names):
            return prefix
        prefix += f"{first}::"


def _blocks(model: WorldModel, group: Group, prefix: str) -> list[GazeboBlock]:
    """Return the plugins and sensors of a tree as ``<gazebo>`` blocks."""
    found = []
    for name, _, link in group.links:
        sensors = [kept.element for kept in link.kept if kept.element.tag == "sensor"]
        if sensors:
            tags = [SensorTag(e.get("name"), e.get("type"), plugins_in(e), e) for e in sensors]
            element = Element("gazebo", {"reference": name[len(prefix) :]}, sensors, "", sensors[0].origin)
            found.append(GazeboBlock(name[len(prefix) :], (), tuple(tags), element))
    if group.first:
        kept = [each.element for each in all_kept(model) if each.element.tag == "plugin"]
        if kept:
            element = Element("gazebo", {}, kept, "", kept[0].origin)
            found.append(GazeboBlock(None, plugins_in(element), (), element))
    return found


def all_kept(model: WorldModel) -> list[Kept]:
    """Return the preserved elements of a model and of its nested models."""
    return [*model.kept, *(kept for nested in model.models for kept in all_kept(nested))]


def _element(tag: str, position: Position | None) -> Element:
    return Element(tag, {}, [], "", Origin(position or Position("", 0, 0)))
