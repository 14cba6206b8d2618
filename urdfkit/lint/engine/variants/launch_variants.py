"""Variants of a robot: the xacro arguments that its simulation and display launch files pass."""

from __future__ import annotations

from pathlib import Path

from urdfkit.lint.engine.consequences import without_consequences
from urdfkit.lint.finding import EntryResult, Finding
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from urdfkit.lint.model.model import Model

    Check = Callable[[Mapping[str, str]], tuple[EntryResult, Model]]

HARDWARE = "K965"
"""Code of the rule that compares controllers with ``<ros2_control>``; robots without it cannot contradict it."""

_TRANSMISSIONS = "K963"
"""The same for ROS 1 controllers and ``<transmission>``."""

_SIMULATED = ("K969", "K977")
"""Codes of rules that compare topics with the sensors and plugins for Gazebo."""

_DEPENDENCY = "K956"
"""Code of the rule that reports in package.xml the packages that a description lacks."""

MOST = 4
"""Maximum number of variants of one robot that are linted."""


@record(eq=False)
class Variant:
    """Xacro arguments in a launch file.

    Attributes:
        arguments: the arguments whose values differ from the default of their declaration.
        launch: the launch file.
    """

    arguments: Mapping[str, str]
    launch: Path

    def __str__(self) -> str:
        """Return the arguments and the launch file."""
        from urdfkit.description.xml.reader import shown_path

        words = " ".join(f"{name}:={value}" for name, value in self.arguments.items())
        return f"{words}, as {shown_path(self.launch)} passes"


def variants_of(model: Model, arguments: Mapping[str, str]) -> list[Variant]:
    """Return the variants that the launch files select and that are not the one of the default arguments.

    Args:
        model: the robot with its default arguments.
        arguments: arguments of the command line, which are never overridden.
    """
    path = model.expanded.path
    if model.package is None or not any("arg" in source.text for source in model.expanded.sources.values()):
        return []
    from urdfkit.description.launch.launch_arguments import for_purpose, passed_to
    from urdfkit.description.xacro.declared_arguments import declared_arguments
    from urdfkit.description.xacro.expand import is_xacro

    declared = declared_arguments(model.expanded.sources.values()) if is_xacro(path) else {}
    if not declared:
        return []
    included = [Path(name) for name, source in model.expanded.sources.items() if "<xacro:arg" in source.text]
    files = {file.resolve(): None for file in (path, *included)}  # MoveIt's packages include the description
    passed = [each for file in files for each in passed_to(file, model.expanded.packages)]
    found: dict[tuple[tuple[str, str], ...], Variant] = {}
    for purpose in ("simulation", "display"):
        for each in for_purpose(passed, purpose):
            own = {
                name: value
                for name, value in each.arguments.items()
                if name in declared and name not in arguments and value != declared[name]
            }
            if own:
                found.setdefault(tuple(sorted(own.items())), Variant(own, each.launch))
    return list(found.values())[:MOST]


def with_variants(
    found: EntryResult, model: Model, check: Check, arguments: Mapping[str, str]
) -> tuple[EntryResult, list[Model]]:
    """Return the result of a robot with the findings of its variants, and the variants.

    A finding in the description is added if the robot with the default arguments does not have it. A finding in another
    file, such as a YAML file that names an undefined joint, stays only if every variant has it; one on interfaces of
    the hardware, if every variant with ``<ros2_control>``, or in ROS 1 with transmissions, has it; one on topics, if
    every variant with sensors has it.

    Args:
        found: the result with the default arguments.
        model: the robot with the default arguments.
        check: lints the robot with other arguments.
        arguments: arguments of the command line.
    """
    variants = variants_of(model, arguments)
    if not variants:
        return found, []
    every: list[tuple[EntryResult, Model, str]] = [(found, model, "")]
    for each in variants:
        every.append((*check({**each.arguments, **arguments}), str(each)))
    sources = {file for _, each, _ in every for file in each.expanded.sources}
    complete = [(result, each) for result, each, _ in every if not each.is_incomplete]
    common = [{_identity(one) for one in result.findings} for result, _ in complete]
    with_hardware = [keys for keys, (_, each) in zip(common, complete, strict=True) if each.robot.ros2_control]
    with_transmissions = [keys for keys, (_, each) in zip(common, complete, strict=True) if each.robot.transmissions]
    gazebo = [keys for keys, (_, each) in zip(common, complete, strict=True) if _has_sensors(each)]
    common_of = {
        HARDWARE: with_hardware,
        _TRANSMISSIONS: with_transmissions,
        **dict.fromkeys(_SIMULATED, gazebo or common),
    }
    findings: list[Finding] = []
    for result, _, variant in every:
        present = {_identity(one) for one in findings}
        for one in result.findings:
            key = _identity(one)
            origins = {one.file, *(each.file for each in one.related if one.code == _DEPENDENCY)}
            is_defect = not sources.isdisjoint(origins) or all(key in keys for keys in common_of.get(one.code, common))
            if is_defect and key not in present and not _is_passed(one, variants):
                findings.append(Finding(**{**one.__dict__, "variant": variant, "fix": None}) if variant else one)
    if model.target != "urdfkit":
        names = {name for _, each, _ in every for name in each.unknown_parts}
        findings = without_consequences(findings, lambda: names)
    merged = EntryResult(
        tuple(findings),
        {name: path for result, _, _ in every for name, path in result.files.items()},
        found.note,
        tuple(dict.fromkeys(place for result, _, _ in every for place in result.used)),
        "; ".join(dict.fromkeys(result.refused for result, _, _ in every if result.refused)),
        found.unused,
        target=found.target,
    )
    return merged, [each for _, each, _ in every[1:]]


def _identity(finding: Finding) -> tuple[object, ...]:
    """Return the part of a finding that is equal in all variants; one place may lack several packages."""
    return finding.code, finding.span, finding.message if finding.code == _DEPENDENCY else ""


def _has_sensors(model: Model) -> bool:
    return any(block.sensors or block.plugins for block in model.robot.gazebo)


def _is_passed(finding: Finding, variants: list[Variant]) -> bool:
    """Return whether a finding reports an argument without a value, although a launch file passes one."""
    names = (name for variant in variants for name in variant.arguments)
    return finding.code == "X106" and finding.severity == "note" and any(name in finding.names for name in names)
