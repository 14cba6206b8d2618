"""load: the strict reader, which raises the most important error of a description with its position."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.urdf.parser import parse
from urdfkit.description.urdf.queries import cycles
from urdfkit.description.urdf.robot import Joint, Link, Problem, Robot
from urdfkit.description.xacro.expand import expand as expand_file
from urdfkit.description.xacro.expand import is_xacro
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xml.element import Element
from urdfkit.errors import ModelError, UsageError, did_you_mean
from urdfkit.resources import ModelArgument, find_model

_HARMLESS = frozenset({"unknown-value", "missing"})
_NEEDED = {("joint", "type"), ("parent", "link"), ("child", "link"), ("mimic", "joint")}
_UNREAD = frozenset({"mechanicalReduction"})
"""Elements whose text neither urdfkit nor urdfdom uses; only the linter checks them."""
_OTHER_ROOTS = {
    "sdf": "an SDF file",
    "gazebo": "an SDF file",
    "mujoco": "an MJCF file (MuJoCo)",
    "mujocoinclude": "an MJCF file (MuJoCo)",
    "collada": "a COLLADA mesh",
    "launch": "a launch file",
    "package": "a package manifest",
}


def load(
    robot: Robot | str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    package_path: Iterable[str | Path] = (),
) -> Robot:
    """Load a robot that is one tree of links and joints.

    Args:
        robot: a ``.urdf`` or ``.xacro`` file, a package folder or the name of a bundled robot. A loaded robot is
            returned unchanged, or loaded again if `arguments` or `package_path` is set.
        arguments: xacro arguments.
        package_path: folders to search for packages first.

    Raises:
        UsageError: `robot` is something else.
        ResourceError: no such file, folder or bundled robot.
        XmlError: a file is not well-formed, declares entities, or exceeds a limit.
        XacroError: xacro could not expand it.
        ModelError: the file is not a robot, the links are not a single tree, or a value is invalid.
    """
    package_path = tuple(package_path)
    if isinstance(robot, Robot) and not arguments and not package_path:
        return robot
    model = model_argument(robot, arguments=arguments, package_path=package_path)
    packages = Packages(model.package_path, model.path)
    expanded = expand_file(model.path, arguments=model.arguments, packages=packages)
    try:
        return robot_of(expanded, model.arguments)
    except ModelError as error:
        if is_xacro(model.path) or not _holds_xacro(expanded):
            raise
        hint = "; xacro is not run on .urdf files: rename it to .urdf.xacro"
        raise ModelError(error.message + hint, position=error.position) from None


def expand(
    robot: Robot | str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    package_path: Iterable[str | Path] = (),
) -> str:
    """Expand xacro to URDF.

    Args:
        robot: see `load`; the file of a loaded robot is read again.
        arguments: xacro arguments.
        package_path: folders to search for packages first.

    Returns:
        The URDF, byte for byte what stock xacro prints.

    Raises:
        UsageError: `robot` is neither a path, a name nor a robot that was loaded from a file.
        ResourceError: no such file, folder or bundled robot.
        XmlError: a file is not well-formed, declares entities, or exceeds a limit.
        XacroError: xacro could not expand it.
    """
    model = model_argument(robot, arguments=arguments, package_path=package_path)
    packages = Packages(model.package_path, model.path)
    return expand_file(model.path, arguments=model.arguments, packages=packages, run_xacro=True).xml


def model_argument(
    robot: Robot | str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    package_path: Iterable[str | Path] = (),
) -> ModelArgument:
    """Return the file of a robot and the arguments to load it with.

    Args:
        robot: see `load`.
        arguments: xacro arguments, added to the arguments of a loaded robot.
        package_path: folders to search for packages first.

    Raises:
        UsageError: `robot` is neither a path, a name nor a robot that was loaded from a file.
        ResourceError: no such file, folder or bundled robot.
    """
    arguments, folders = dict(arguments or {}), tuple(Path(folder) for folder in package_path)
    if isinstance(robot, Robot):
        if not robot.files:
            raise UsageError(f"robot `{robot.name}` was not read from a file; pass a robot returned by urdfkit.load()")
        if robot.packages is not None:
            folders += robot.packages.search
        name = robot.name or robot.files[0].stem
        return ModelArgument(robot.files[0], {**robot.arguments, **arguments}, folders, name)
    if not isinstance(robot, (str, os.PathLike)):
        raise UsageError(f"{robot!r} is not a robot: pass a file, a package folder, a bundled name or a loaded robot")
    path = Path(robot)
    if path.is_file():
        return ModelArgument(path, arguments, folders, path.name.split(".")[0])
    found = find_model([str(robot)], package_path=folders)
    return ModelArgument(found.path, arguments, found.package_path, found.name)


def robot_of(expanded: Expanded, arguments: Mapping[str, str] | None = None) -> Robot:
    """Return the robot that an expanded file describes, checked.

    Args:
        expanded: from `expand`.
        arguments: the xacro arguments, for `Robot.arguments`.

    Raises:
        ModelError: see `load`.
    """
    root = expanded.root
    if root is None:
        raise ModelError(f"{expanded.path} could not be read")
    check_is_robot(root)
    robot = parse(root, files=expanded.files, packages=expanded.packages, arguments=arguments)
    check(robot)
    return robot


def _holds_xacro(expanded: Expanded) -> bool:
    return any("${" in source.text or "<xacro:" in source.text for source in expanded.sources.values())


def check_is_robot(root: Element) -> None:
    """Raise unless the document element is ``<robot>``.

    Args:
        root: the document element.

    Raises:
        ModelError: the document element is another one; the message contains its name.
    """
    if root.tag == "robot":
        return
    kind = _OTHER_ROOTS.get(root.tag.lower())
    what = f"this is {kind}, not a robot description" if kind else f"the root element is <{root.tag}>, not <robot>"
    raise ModelError(f"{what}{'' if kind else did_you_mean(root.tag, ['robot'])}", position=root.origin.position)


def check(robot: Robot) -> None:
    """Raise the most important error of a robot that is not a single valid tree.

    Args:
        robot: the robot returned by `parse`.

    Raises:
        ModelError: the error, with its source position.
    """
    for found in _reasons(robot):
        raise found


def _reasons(robot: Robot) -> Iterator[ModelError]:
    if not robot.links:
        yield _error("the robot has no link", robot.element)
    yield from _unusable_values(robot)
    yield from _nameless(robot)
    yield from _duplicates("link", robot.links)
    yield from _duplicates("joint", robot.joints)
    for joint in robot.joints:
        yield from _ill_defined(robot, joint)
    for link in robot.links:
        if len(parents := robot.parents_of.get(link.name, [])) > 1:
            yield _error(
                f"link `{link.name}` is the child of two joints, `{parents[0].name}` "
                f"({parents[0].element.origin.position}) and `{parents[1].name}`",
                parents[1].element,
            )
    for loop in cycles(robot):
        yield _error(f"the joints form a loop: {' → '.join(_loop_links(loop))}", loop[0].element)
    roots = robot.roots()
    if len(roots) > 1:
        yield _two_roots(robot, roots)
    for joint in robot.joints:
        if joint.mimic is not None and joint.mimic.joint not in robot.joint_by_name:
            hint = did_you_mean(joint.mimic.joint, robot.joint_by_name)
            yield _error(
                f"joint `{joint.name}` mimics the unknown joint `{joint.mimic.joint}`{hint}", joint.mimic.element
            )


def _unusable_values(robot: Robot) -> Iterator[ModelError]:
    for problem in robot.problems:
        if problem.element.tag in _UNREAD:
            continue
        if problem.kind not in _HARMLESS or _is_needed(problem):
            yield _error(problem.message, problem.element)


def _is_needed(problem: Problem) -> bool:
    """Return whether a missing value has no valid default (urdfdom rejects these problems too)."""
    tag = problem.element.tag
    if problem.kind == "unknown-value":
        return tag == "joint"
    return tag in ("limit", "inertia", "mass") or (tag, problem.attribute) in _NEEDED


def _nameless(robot: Robot) -> Iterator[ModelError]:
    for name, element in [(x.name, x.element) for x in robot.links] + [(x.name, x.element) for x in robot.joints]:
        if not name:
            yield _error(f"a <{element.tag}> has no name", element)


def _duplicates(kind: str, parts: tuple[Link, ...] | tuple[Joint, ...]) -> Iterator[ModelError]:
    first: dict[str, Element] = {}
    for part in parts:
        if part.name in first:
            at = first[part.name].origin.position
            yield _error(f"two {kind}s are called `{part.name}`; the first is at {at}", part.element)
        first.setdefault(part.name, part.element)


def _ill_defined(robot: Robot, joint: Joint) -> Iterator[ModelError]:
    for end, name in (("parent", joint.parent), ("child", joint.child)):
        if name is None:
            yield _error(f"joint `{joint.name}` lacks <{end} link=…>", joint.element)
        elif name not in robot.link_by_name:
            hint = did_you_mean(name, robot.link_by_name)
            element = joint.element.find(end) or joint.element
            yield _error(f"joint `{joint.name}`: its {end} link `{name}` does not exist{hint}", element)
    if joint.type in ("revolute", "prismatic") and joint.limit is None:
        wanted = '<limit lower="…" upper="…" effort="…" velocity="…"/>'
        yield _error(f"{joint.type} joint `{joint.name}` lacks {wanted}", joint.element)
    if joint.is_movable and joint.type != "floating" and not any(joint.axis):
        yield _error(f"the axis of joint `{joint.name}` is zero", joint.element.find("axis") or joint.element)


def _two_roots(robot: Robot, roots: list[Link]) -> ModelError:
    below: dict[str, int] = {}
    for root in roots:
        reached, stack = 0, [root.name]
        while stack:
            reached += 1
            stack += [j.child for j in robot.children_of.get(stack.pop(), []) if j.child is not None]
        below[root.name] = reached
    main = max(roots, key=lambda link: below[link.name])
    others = [link for link in roots if link is not main]
    more = f" and {len(others) - 3} more" if len(others) > 3 else ""
    names = ", ".join(f"`{link.name}`" for link in others[:3]) + more
    verb = "has" if len(others) == 1 else "have"
    return _error(
        f"{len(roots)} root links: {names} {verb} no parent joint; a joint to the tree of `{main.name}` "
        f"({main.element.origin.position}) is missing",
        others[0].element,
    )


def _loop_links(loop: list[Joint]) -> list[str]:
    names = [joint.parent or "" for joint in loop]
    return [*names, names[0]]


def _error(message: str, element: Element) -> ModelError:
    from urdfkit.description.xacro.evaluation.failures import chain_words

    return ModelError(message + chain_words(element.origin.expansions), position=element.origin.position)
