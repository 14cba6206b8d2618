"""K961 yaml-link-undefined."""

from __future__ import annotations

import re

from urdfkit.lint.around import names_around
from urdfkit.lint.finding import Finding
from urdfkit.lint.hidden import doubted
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.source import Source
    from urdfkit.lint.model import Model

_FRAME = (
    r"(?m)^[ \t]*(robot_base_frame|base_frame(?:_id)?|base_link_frame(?:_id)?|base_link|tip_link|ee_link|root_link)"
    r"[ \t]*:[ \t]*([\"']?)([\w./-]+)\2[ \t]*\r?$"
)
"""Settings of controllers, navigation and localisation that are links of the robot."""


class FrameUndefined(RobotRule):
    """Settings in YAML name a link that the robot does not have.

    ## What it does
    Looks for ``base_frame_id``, ``base_frame``, ``robot_base_frame``, ``base_link_frame`` and, for arms, ``base_link``,
    ``root_link``, ``tip_link`` and ``ee_link`` in the YAML of the robot's package, and of the packages beside it that
    depend on it. A name is reported where it is nearly that of a link, and no description around has it; the
    ``base_frame_id`` of a controller that drives also where no other file around has a frame of that name.

    ## Why is this bad?
    A controller publishes, and navigation waits for, a frame that is not in the tree of transforms.

    ## Example
    ```yaml
    drive:
      ros__parameters:
        base_frame_id: base_linc
    ```

    ## Use instead
    ```yaml
    drive:
      ros__parameters:
        base_frame_id: base_link
    ```
    """

    code = "K961"
    name = "yaml-link-undefined"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each link in settings that no description around can have."""
        from urdfkit.lint.edits import meant
        from urdfkit.lint.launch import uncommented

        known = model.robot.link_by_name
        if not known:
            return
        others: list[str] | None = None
        for source in model.around.values():
            if not source.file.endswith((".yaml", ".yml")):
                continue
            for at in re.finditer(_FRAME, uncommented(source)):
                name = at[3].rpartition("/")[2]
                near, hint = meant(name, known)
                if name in known or (near is None and not _is_drives(source, at, model)):
                    continue
                others = names_around(model, "link") if others is None else others
                if any(re.fullmatch(pattern, name) for pattern in others):
                    continue
                found = Finding(
                    self.code,
                    self.name,
                    self.severity,
                    f"`{at[1]}` is `{name}`, which is no link of `{model.robot.name}`{hint}",
                    source.span(*at.span(3)),
                    link=name,
                )
                yield from doubted(model, name, near, found)


def _is_drives(source: Source, at: re.Match[str], model: Model) -> bool:
    """Whether a setting is the base frame of a controller that drives, and no other file around has such a frame."""
    from urdfkit.lint.controller_settings import settings

    if at[1] != "base_frame_id" or any(
        re.search(rf"(?<![\w-]){re.escape(at[3])}(?![\w-])", other.text)
        for other in model.around.values()
        if other is not source
    ):
        return False
    place = source.position(at.start(3))
    return any(
        value.line == place.line and re.search(_DRIVES, one.kind) is not None
        for one in settings(source)
        for key, value in one.group.entries
        if key.text == at[1]
    )


_DRIVES = r"^(?:diff_drive|mecanum_drive|tricycle|\w+_steering)_controller/"
