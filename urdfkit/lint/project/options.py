"""Options of a run of the linter: what to report, and how to expand."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from urdfkit.record import field, record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.project.confinement import Confinement

TIME_LIMIT = 10.0
"""Seconds of CPU that a file may take in commands and on the page of the viewer."""


@record
class Options:
    """Options of a lint run.

    Attributes:
        select: codes, or prefixes of codes, to report; all if empty.
        ignore: codes, or prefixes of codes, not to report.
        target: the consumer of the robot, as `parse_target` returns it; None for all consumers.
        arguments: values for ``$(arg …)``.
        package_path: folders to search for packages first.
        texts: absolute path → content that replaces the file on disk.
        time_limit: seconds of CPU that a file may take; 0 for no limit.
        confinement: what may be read; everything when None. It has to be started in the process.
        launch_arguments: also lint each robot with the arguments that its launch files pass.
        guess_target: if `target` is None, guess the target from the package.xml of each robot.
    """

    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    target: str | None = None
    arguments: Mapping[str, str] = field(default_factory=dict)
    package_path: tuple[Path, ...] = ()
    texts: Mapping[str, str] = field(default_factory=dict)
    guess_target: bool = False
    launch_arguments: bool = False
    time_limit: float = 0.0
    confinement: Confinement | None = None
