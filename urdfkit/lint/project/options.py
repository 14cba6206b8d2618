"""Options of a run of the linter: what to report, and how to expand."""

from __future__ import annotations

from urdfkit.record import field, record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path


@record
class Options:
    """What to look for, and how to expand.

    Attributes:
        select: codes, or beginnings of codes, to report; all where it is empty.
        ignore: codes, or beginnings, not to report.
        target: the consumer the robot is meant for, as `parse_target` returns it.
        arguments: values for ``$(arg …)``.
        package_path: folders to look for packages in first.
        texts: contents to lint instead of those on disk, by absolute path.
        guess_target: where `target` is None, take what the package.xml of each robot tells.
    """

    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    target: str | None = None
    arguments: Mapping[str, str] = field(default_factory=dict)
    package_path: tuple[Path, ...] = ()
    texts: Mapping[str, str] = field(default_factory=dict)
    guess_target: bool = False
