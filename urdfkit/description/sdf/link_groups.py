"""Groups of a model's links that joints connect, in the form of the file."""

from urdfkit.description.sdf.model import WorldJoint, WorldLink, WorldModel
from urdfkit.description.urdf.robot import Pose
from urdfkit.record import record


@record(eq=False)
class Group:
    """Connected links and joints of a model, in the form of the file.

    Attributes:
        name: name of the model, with ``::`` and the name of the first link if the model has several groups.
        links: name in the model, pose in the model, and link; the first is the root.
        joints: name prefix, and joint.
        fixed_base: whether a joint connects the group to the world.
        first: whether the group contains the canonical link; the plugins of the model apply to this group.
    """

    name: str
    links: tuple[tuple[str, Pose, WorldLink], ...]
    joints: tuple[tuple[str, WorldJoint], ...]
    fixed_base: bool
    first: bool

    @property
    def moves(self) -> bool:
        """Whether any joint of the group is movable."""
        return any(joint.type != "fixed" for _, joint in self.joints)


def groups_of(model: WorldModel) -> tuple[Group, ...]:
    """Return the connected groups of a model's links, in the order of their first links."""
    links = {name: (name, pose, link) for name, pose, link in model.all_links()}
    joints = list(model.all_joints())
    leader = {name: name for name in links}

    def find(name: str) -> str:
        while leader[name] != name:
            name = leader[name]
        return name

    on_world = set()
    for prefix, joint in joints:
        ends = ends_of(prefix, joint)
        if "world" in ends:
            on_world.add(ends[1])
        else:
            leader[find(ends[1])] = find(ends[0])
    canonical = model.canonical_link or next(iter(links), "")
    found: dict[str, list[str]] = {}
    for name in links:
        found.setdefault(find(name), []).append(name)
    groups = []
    for members in found.values():
        own = tuple([each for each in joints if ends_of(*each)[1] in members])
        inner = {ends_of(*each)[1] for each in own if "world" not in ends_of(*each)}
        root = next((name for name in members if name not in inner), members[0])
        ordered = [root, *(name for name in members if name != root)]
        groups.append(
            Group(
                model.name if len(found) == 1 else f"{model.name}::{root}",
                tuple([links[name] for name in ordered]),
                own,
                bool(on_world.intersection(members)),
                canonical in members,
            )
        )
    return tuple(groups)


def ends_of(prefix: str, joint: WorldJoint) -> tuple[str, str]:
    """Return the names of parent and child link in the model; the parent may be ``world``."""
    parent = joint.parent if joint.parent == "world" else prefix + joint.parent
    return parent, prefix + joint.child
