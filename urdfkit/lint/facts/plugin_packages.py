"""Packages whose plugins a robot's files name, and places of missing dependencies in package.xml.

The packages are those of Gazebo and MoveIt, and that of the description in a MoveIt package.

Sources: the plugin descriptions and package.xml of moveit_kinematics, moveit_planners, moveit_plugins, trac_ik and
pick_ik, and of gazebo_ros2_control, gz_ros2_control and gazebo_ros_control; moveit_configs_utils,
moveit_configs_builder.py.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.related_files import LAUNCH, dependencies_in, neighbours, package_of
from urdfkit.lint.model.model import Model
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.xml.source import Source, Span

SIMULATED_CONTROL = {
    "gazebo_ros2_control": "gazebo_ros",
    "gz_ros2_control": "ros_gz_sim",
    "ign_ros2_control": "ros_ign_gazebo ros_gz_sim",
    "gazebo_ros_control": "gazebo_ros",
}
"""Package with a Gazebo plugin that runs controllers → packages that start its Gazebo.

The file of the plugin has the name of its package in it.
"""

_MOVEIT = {
    "cached_ik_kinematics_plugin": "moveit_kinematics",
    "kdl_kinematics_plugin": "moveit_kinematics",
    "lma_kinematics_plugin": "moveit_kinematics",
    "srv_kinematics_plugin": "moveit_kinematics",
    "pick_ik": "pick_ik",
    "trac_ik_kinematics_plugin": "trac_ik_kinematics_plugin",
    "chomp_interface": "moveit_planners_chomp",
    "ompl_interface": "moveit_planners_ompl",
    "pilz_industrial_motion_planner": "pilz_industrial_motion_planner",
    "moveit_fake_controller_manager": "moveit_fake_controller_manager",
    "moveit_simple_controller_manager": "moveit_simple_controller_manager",
}
"""Name before the class of a MoveIt plugin → its package."""

_USE = re.compile(rf"(?<![\w/-])({'|'.join(_MOVEIT)})/[A-Z]\w+")
_BUILDER = re.compile(r"MoveItConfigsBuilder\s*\(")
_LEAST = 2
"""Number of MoveIt packages in a package.xml from which on it lists all MoveIt packages that it needs."""


@record(eq=False)
class PackageUse:
    """A place that needs a package: the text in a source, the package, and the reason.

    Attributes:
        is_own: whether the package of the source has to depend on it, not another one of the robot.
    """

    source: Source
    start: int
    end: int
    package: str
    use: str
    is_own: bool = False


def moveit_uses(model: Model, declared: dict[Path, set[str]]) -> Iterator[PackageUse]:
    """Yield the MoveIt plugins, and the descriptions of `MoveItConfigsBuilder`, in packages that depend on MoveIt.

    Args:
        model: the linted model.
        declared: folder of a package → its name and its dependencies.
    """
    for file, source in model.related_files.items():
        if not file.endswith((*LAUNCH, ".yaml", ".yml")):
            continue
        package = package_of(Path(file))
        of_moveit = [name for name in declared.get(package, ()) if name.startswith("moveit")] if package else []
        if package is None or len(of_moveit) < _LEAST:
            continue
        for match in _USE.finditer(source.text):
            line = source.text[source.text.rfind("\n", 0, match.start()) + 1 : match.start()]
            if "#" not in line and "<!--" not in line:
                yield PackageUse(source, match.start(), match.end(), _MOVEIT[match[1]], "whose plugin this file uses")
        builder = _BUILDER.search(source.text)
        assistant = package / ".setup_assistant"
        if builder is None or ".robot_description(" in source.text or not assistant.is_file():
            continue
        described = re.search(r"(?im)^\s*urdf:\s*\n\s+package:\s*([\w-]+)\s*$", assistant.read_text("utf-8", "replace"))
        if described is not None:
            use = "whose description MoveItConfigsBuilder reads"
            yield PackageUse(source, builder.start(), builder.end() - 1, described[1], use, is_own=True)


_DEPENDENCY = r"<(exec_depend|run_depend|build_depend|depend)\b[^>]*>\s*([^<\s]+)\s*</\1>"


def place_of_dependency(name: str, used_in: str, model: Model, is_own: bool, tag: str) -> Span | None:
    """Return the element in package.xml after which a dependency is to be added; None without a package.xml.

    It is added to the package that uses it. Where any package of the robot may have it, a package is preferred that
    depends on one of the same family, such as ``gazebo_ros`` and ``gazebo_plugins``.

    Args:
        name: the missing package.
        used_in: the file that uses it, as shown to the user.
        model: the linted model.
        is_own: whether only the package that uses it can have it.
        tag: the element that is missing, such as ``exec_depend``.
    """
    from urdfkit.lint.facts.ros_packages import RENAMED

    own, words = package_of(Path(used_in)), {name.partition("_")[0], name.rpartition("_")[2].removesuffix("s")}
    found: list[tuple[bool, int, Source]] = []
    old = "|".join(old for old, new in RENAMED.items() if new == name)
    for file, source in model.related_files.items():
        if file.endswith("package.xml"):
            renamed = re.search(rf">\s*({old})\s*<", source.text) if old else None
            if renamed is not None and Path(file).absolute().parent == own:
                return source.span(*renamed.span(1))
            needed = dependencies_in(source.text)
            family = [each for each in needed if not words.isdisjoint(re.split("_|s$", each))]
            found.append((Path(file).absolute().parent == own, len(family), source))
    manifest = next((source for is_user, family, source in found if is_user and (family or is_own)), None)
    others = sorted((each for each in found if each[1] and not is_own), key=lambda each: -each[1])
    manifest = manifest or next((source for _, _, source in others), None)
    manifest = manifest or next((source for is_user, _, source in found if is_user), None)
    return _place_in(manifest, name, tag) if manifest is not None else None


def plural_dependency(name: str, used_in: str, model: Model) -> tuple[Span, str] | None:
    """Return the dependency of the package of a file that differs from a missing one by the plural of a word only.

    Such a name can be another package, but not where no package has it and the other one is missing.
    """
    from urdfkit.lint.facts.ros_packages import names

    own = package_of(Path(used_in))
    near = {*names(), *(neighbours(own) if own is not None else ())}
    for file, source in model.related_files.items():
        if file.endswith("package.xml") and Path(file).absolute().parent == own:
            for each in re.finditer(_DEPENDENCY, source.text):
                if each[2] != name and each[2] not in near and _singular(each[2]) == _singular(name):
                    return source.span(*each.span(2)), each[2]
    return None


def _singular(name: str) -> list[str]:
    return [word.removesuffix("s") for word in name.split("_")]


def _place_in(manifest: Source, name: str, tag: str) -> Span:
    """Return the dependency before the place of a new one: by the alphabet if it orders them, else the last one."""
    text = re.sub(r"(?s)<!--.*?-->", lambda comment: " " * len(comment[0]), manifest.text)
    entries = list(re.finditer(_DEPENDENCY, text))
    kinds = ("depend", "build_depend") if tag == "depend" else ("exec_depend", "run_depend")
    entries = [each for each in entries if each[1] in kinds] or entries
    names = [each[2] for each in entries]
    if not entries:
        end = text.rfind("</package>")
        return manifest.span(max(end, 0), max(end, 0) + len("</package>"))
    before = [each for each in entries if each[2] < name] if names == sorted(names) else entries
    last = (before or entries[:1])[-1]
    return manifest.span(last.start(), last.end())
