"""The linter: report defects of URDF and xacro files at their source position, and fix many of them.

Data flow: `engine` expands each entry file with error recovery (`urdfkit.description.xacro.expand`) and runs the rules,
layer by layer: `SourceRule` on the text of each file, `FaultRule` on xacro errors, `RobotRule` on the expanded robot.
It drops suppressed findings and merges findings that several expansions of one macro have in common. `fixes` edits the
source text, `report` prints the findings.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path
    from typing import Any

    from urdfkit.description.urdf.robot import Robot
    from urdfkit.lint.finding import Finding as Finding
    from urdfkit.lint.finding import Findings
    from urdfkit.lint.rules import RULES as RULES

_MODULES = {"Finding": "finding", "RULES": "rules"}

__all__ = ["RULES", "Finding", "lint"]


def lint(
    robots: Robot | str | Path | Iterable[Robot | str | Path],
    *,
    select: Iterable[str] = (),
    ignore: Iterable[str] = (),
    target: str | None = None,
    arguments: Mapping[str, str] | None = None,
    package_path: Iterable[str | Path] = (),
) -> Findings:
    """Lint robots, packages or workspaces.

    Args:
        robots: one or more files, folders, names of bundled robots, or loaded robots. The files of a loaded robot are
            read again, with the xacro arguments that it was loaded with.
        select: codes, or prefixes of codes, to report; all if empty.
        ignore: codes, or prefixes of codes, not to report.
        target: the consumer of the robot, one of `TARGETS`, or with its release: ``ros2-jazzy``.
        arguments: values for ``$(arg …)``.
        package_path: folders to search first for packages.

    Returns:
        The findings, sorted by position. Defects in the files are findings, not exceptions.

    Raises:
        UsageError: a code or the target is unknown, or a loaded robot was not read from a file.
        ResourceError: a path does not exist or has no robot description.

    Examples:
        >>> import urdfkit
        >>> urdfkit.lint("simpleton")
        []
        >>> [finding.code for finding in urdfkit.lint("arm.urdf", select=["I"])]
        ['I503']
    """
    from collections.abc import Iterable
    from pathlib import Path

    from urdfkit.lint.engine.rule_runner import every_code
    from urdfkit.lint.engine.run import merged, run
    from urdfkit.lint.finding import Findings
    from urdfkit.lint.project.entry_files import find_entries
    from urdfkit.lint.project.options import Options
    from urdfkit.lint.project.rule_selection import checked
    from urdfkit.lint.project.target_platform import parse_target

    selected = checked("select", [select] if isinstance(select, str) else select, every_code)
    ignored = checked("ignore", [ignore] if isinstance(ignore, str) else ignore, every_code)
    every = list(robots) if isinstance(robots, Iterable) and not isinstance(robots, str) else [robots]
    paths = [one for one in every if isinstance(one, (str, Path))]
    folders = tuple(Path(folder) for folder in package_path)
    options = Options(selected, ignored, parse_target(target, "target"), dict(arguments or {}), folders)
    outcomes = [run(find_entries(paths), options)]
    for robot in every:
        if not isinstance(robot, (str, Path)):
            from urdfkit.description.model_argument import model_argument

            model = model_argument(robot, arguments=arguments, package_path=folders)
            own = {"arguments": model.arguments, "package_path": model.package_path}
            outcomes.append(run(find_entries([model.path]), Options(**{**options.__dict__, **own})))
    return Findings(merged(finding for outcome in outcomes for finding in outcome.findings))


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
