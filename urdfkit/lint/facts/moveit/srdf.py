"""SRDF of the robot: the names that it uses, and the joints of its groups.

Sources: srdfdom, src/model.cpp (elements); moveit_core, robot_model/src/robot_model.cpp (groups, states).
"""

import re
from collections.abc import Collection, Iterator
from functools import lru_cache

from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Severity
from urdfkit.lint.model.model import Model
from urdfkit.record import record

ELEMENTS: dict[str, dict[str, str]] = {
    "group": {"name": ""},
    "group/link": {"name": "link"},
    "group/joint": {"name": "joint"},
    "group/chain": {"base_link": "link", "tip_link": "link"},
    "group/group": {"name": "group"},
    "group_state": {"name": "", "group": "group"},
    "group_state/joint": {"name": "joint", "value": ""},
    "end_effector": {"name": "", "parent_link": "link", "group": "group", "parent_group": "group"},
    "virtual_joint": {"name": "", "type": "", "parent_frame": "", "child_link": "link"},
    "passive_joint": {"name": "joint"},
    "disable_collisions": {"link1": "link", "link2": "link", "reason": ""},
    "enable_collisions": {"link1": "link", "link2": "link", "reason": ""},
    "disable_default_collisions": {"link": "link"},
    "link_sphere_approximation": {"link": "link"},
    "link_sphere_approximation/sphere": {"center": "", "radius": ""},
    "joint_property": {"joint_name": "joint", "property_name": "", "value": ""},
}
"""Element, after its parent unless that is the root → attribute → kind of the name in it."""

NAME = r"<robot\b[^>]*?(?<![\w:])name\s*=\s*[\"']([^\"']*)"
"""Matches the name of a robot in a description or SRDF."""

OPTIONAL = frozenset(("parent_group", "reason"))

_SHARE_OF_OWN = 0.8
"""Smallest proportion of existing links and joints in an SRDF with another name that is for the robot."""
_LOWEST_SHARE = 0.5
"""Smallest proportion of existing links and joints in the references of a robot's SRDF."""


@record(eq=False)
class NameUse:
    """A name in an SRDF.

    Attributes:
        element: the element.
        attribute: the attribute that contains the name.
        kind: ``link``, ``joint`` or ``group``.
        name: the name.
    """

    element: Element
    attribute: str
    kind: str
    name: str


def elements(root: Element) -> Iterator[tuple[str, Element]]:
    """Yield the elements of an SRDF with their keys in `ELEMENTS`."""
    for element in root.children:
        yield element.tag, element
        yield from ((f"{element.tag}/{child.tag}", child) for child in element.children)


def references(root: Element) -> Iterator[NameUse]:
    """Yield the names of links, joints and groups that an SRDF uses."""
    for key, element in elements(root):
        for attribute, kind in ELEMENTS.get(key, {}).items():
            if kind and (name := element.get(attribute)):
                yield NameUse(element, attribute, kind, name)


@lru_cache(maxsize=1)
def semantics_of(model: Model) -> tuple[Element, ...]:
    """Return the root elements of the SRDF files that describe this robot, also under the name of no robot."""
    robot, roots = model.robot, model.semantic_roots.values()
    return (
        tuple(root for root in roots if root.get("name") == robot.name or is_misnamed(root, model))
        if robot.links
        else ()
    )


def is_misnamed(root: Element, model: Model) -> bool:
    """Return whether an SRDF describes this robot but has a name that no robot of these packages has."""
    robot, name = model.robot, root.get("name")
    if name == robot.name or not robot.name or not fits(root, robot, _SHARE_OF_OWN):
        return False
    stem = root.origin.position.file.rpartition("/")[2].partition(".")[0]
    others = robot_names(model)
    if stem != robot.name and stem in others:
        return False  # It belongs to the robot that its file is named after.
    return name is None or not any(re.fullmatch(pattern, name) for pattern in others)


def severity_for(root: Element, model: Model, severity: Severity | None = None) -> Severity | None:
    """Return the severity of a defect that breaks MoveIt: a note if other programs read the SRDF (Pinocchio, HPP).

    MoveIt reads it if it is in a folder ``config``, or if a package.xml or YAML file of these packages names MoveIt.
    """
    from urdfkit.lint.facts.control.launch_package_paths import uncommented

    folder = root.origin.position.file.rpartition("/")[0]
    manifests = (source for name, source in model.related_files.items() if name.endswith("package.xml"))
    is_for_moveit = (
        folder.rpartition("/")[2] == "config"
        or any(name.endswith("kinematics.yaml") for name in model.related_files)
        or any("moveit" in uncommented(source) for source in manifests)
    )
    return severity if is_for_moveit else "note"


def fits(root: Element, robot: Robot, share: float = _LOWEST_SHARE) -> bool:
    """Return whether most links and joints that an SRDF uses exist in a robot."""
    existing: dict[str, Collection[str]] = {"link": robot.link_by_name, "joint": robot.joint_by_name}
    found = [
        name in existing[kind]
        for key, element in elements(root)
        for attribute, kind in ELEMENTS.get(key, {}).items()
        if kind in existing and (name := element.get(attribute))
    ]
    return bool(found) and sum(found) >= share * len(found)


def virtual_joints(root: Element) -> dict[str, Element]:
    """Return the virtual joints of an SRDF by name."""
    return {element.get("name") or "": element for element in root.find_all("virtual_joint")}


def groups(root: Element) -> dict[str, Element]:
    """Return the groups of an SRDF by name; the first of several."""
    return {element.get("name") or "": element for element in reversed(root.find_all("group"))}


def path_between(base: str, tip: str, robot: Robot) -> list[Joint] | None:
    """Return the joints between a link and a link below it; None if it is not below."""
    path: list[Joint] = []
    while tip != base:
        joint = next(iter(robot.parents_of.get(tip, ())), None)
        if joint is None or joint.parent is None or joint in path:
            return None
        path.append(joint)
        tip = joint.parent
    return path


def joints_of(group: str, root: Element, robot: Robot) -> set[str] | None:
    """Return the joints of a group, those of its subgroups included; None if a name in it is unknown."""
    by_name, found, pending, seen = groups(root), set[str](), [group], set[str]()
    while pending:
        name = pending.pop()
        if name in seen:
            continue
        seen.add(name)
        if name not in by_name:
            return None
        for child in by_name[name].children:
            wanted = child.get("name") or ""
            if child.tag == "group":
                pending.append(wanted)
            elif child.tag == "joint" and (wanted in robot.joint_by_name or wanted in virtual_joints(root)):
                found.add(wanted)
            elif child.tag == "link" and wanted in robot.link_by_name:
                found.update(joint.name for joint in robot.parents_of.get(wanted, ()))
            elif child.tag == "chain":
                path = path_between(child.get("base_link") or "", child.get("tip_link") or "", robot)
                if path is None:
                    return None
                found.update(joint.name for joint in path)
            else:
                return None
    return found


def near_links(link: str, model: Model) -> set[str]:
    """Return the links that at most one moving joint separates from a link; links without shapes do not count."""
    near, links = _neighbours(model), model.robot.link_by_name
    distances, pending = {link: 0}, [link]
    for each in pending:  # The list grows during the iteration.
        for name, is_fixed in near.get(each, ()):
            part = links.get(name)
            further = distances[each] + (not is_fixed and part is not None and bool(part.collisions))
            if further < distances.get(name, 2):
                distances[name] = further
                pending.append(name)
    return set(distances)


@lru_cache(maxsize=1)
def _neighbours(model: Model) -> dict[str, list[tuple[str, bool]]]:
    """Return the links that joints connect to each link, each with whether the joint is fixed."""
    near: dict[str, list[tuple[str, bool]]] = {}
    for joint in model.robot.joints:
        if joint.parent is not None and joint.child is not None:
            near.setdefault(joint.parent, []).append((joint.child, joint.type == "fixed"))
            near.setdefault(joint.child, []).append((joint.parent, joint.type == "fixed"))
    return near


@lru_cache(maxsize=1)
def robot_names(model: Model) -> list[str]:
    """Return patterns of the names of all robots in the packages of the related files, or in the robot's folder."""
    from pathlib import Path

    from urdfkit.description.packages.related_files import package_of
    from urdfkit.lint.project.description_files import SUFFIXES, descriptions, near_descriptions

    folders = {package_of(Path(file)) for file in (*model.related_files, *model.expanded.sources)}
    found = [re.escape(model.robot.name or "")]
    texts = [text for folder in sorted(filter(None, folders)) for _, text in descriptions(folder)]
    if model.package is None:
        texts += [text for _, text in near_descriptions(None, model.expanded.path, SUFFIXES)]
    for text in texts:
        for name in re.findall(NAME, text):
            found.append(re.sub(r"\\\$\\[({].*?\\[)}]", ".*", re.escape(name)))
    return found
