"""K961 yaml-link-undefined."""

import re
from collections.abc import Iterator

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import Findings, Model, RobotRule

_FRAME = (
    r"(?m)(?:^|[{,])[ \t]*(robot_base_frame|base_frame(?:_id)?|base_link_frame(?:_id)?|base_link|tip_link|ee_link"
    r"|root_link|frame_id|sensor_frame)"
    r"[ \t]*:[ \t]*([\"']?)([\w./-]+)\2[ \t]*(?=\r?$|[},])"
)
"""Matches parameters of controllers, navigation and localisation that name a link of the robot."""


_IN_XML = r"<param\b[^<>]*?\bname\s*=\s*[\"'](\w+)([\"'])[^<>]*?\bvalue\s*=\s*[\"']([\w/]+)[\"']"
_IN_PYTHON = r"[\"'](\w+)([\"'])\s*:\s*[\"']([\w/]+)[\"']"
_IN_LAUNCH = ("robot_base_frame", "base_frame", "base_frame_id", "base_link_frame", "base_link_frame_id")
"""Parameters of nodes in launch files that name a link of the robot."""

_ANY_FRAME = ("frame_id", "sensor_frame")
"""Parameters that can name frames of other robots."""


class FrameUndefined(RobotRule):
    """A parameter in YAML names a link that the robot does not have.

    ## What it does
    Checks ``base_frame_id``, ``base_frame``, ``robot_base_frame`` and ``base_link_frame``, and for arms ``base_link``,
    ``root_link``, ``tip_link`` and ``ee_link``, and ``frame_id`` and ``sensor_frame`` with a name that differs by a
    letter, in the YAML files of the robot's package and of neighbouring packages that depend on it, and the base frames
    in parameters of launch files. The rule reports misspelt link names, unless another description in these packages
    defines a link of that name. For the ``base_frame_id`` of a drive controller, it also reports names that no other
    file in these packages mentions.

    ## Why is this bad?
    The controller publishes a frame that is not part of the TF tree, or navigation waits for a frame that never
    appears.

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

    ## Fix safety
    Unsafe: the fix writes the nearest name in place of a misspelt one; another name may be meant.
    """

    code = "K961"
    name = "yaml-link-undefined"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each named link that no description in these packages can define."""
        from urdfkit.lint.facts.control.launch_package_paths import uncommented
        from urdfkit.lint.facts.ros_packages import is_slip
        from urdfkit.lint.fix_builders import meant

        links_by_name = model.robot.link_by_name
        if not links_by_name:
            return
        for source in model.related_files.values():
            for match in _named(source, uncommented(source)):
                name = match[3].rpartition("/")[2]
                suggestion, hint = meant(name, links_by_name)
                if name in links_by_name or (suggestion is None and not _is_drive_frame(source, match, model)):
                    continue
                if model.neighbouring_descriptions.define("link", name):
                    continue
                needs_slip = match[1] in _ANY_FRAME or not source.file.endswith((".yaml", ".yml"))
                if needs_slip and (suggestion is None or not is_slip(name, suggestion)):
                    continue
                finding = Finding(
                    self.code,
                    self.name,
                    self.severity,
                    f"`{match[1]}` is `{name}`, but robot `{model.robot.name}` has no such link{hint}",
                    source.span(*match.span(3)),
                    link=name,
                )
                yield from unless_masked(model, name, suggestion, finding)


def _named(source: Source, text: str) -> Iterator[re.Match[str]]:
    """Yield the parameters that name a link: the name in group 1 and the link in group 3."""
    if source.file.endswith((".yaml", ".yml")):
        yield from re.finditer(_FRAME, text)
    elif source.file.endswith(LAUNCH) and "frame" in text:
        pattern = _IN_PYTHON if source.file.endswith(".py") else _IN_XML
        yield from (match for match in re.finditer(pattern, text) if match[1] in _IN_LAUNCH)


def _is_drive_frame(source: Source, match: re.Match[str], model: Model) -> bool:
    """Return whether a parameter is the base frame of a drive controller, and no other file mentions the frame."""
    from urdfkit.lint.facts.control.controller_settings import settings

    is_yaml = source.file.endswith((".yaml", ".yml"))
    if (
        match[1] != "base_frame_id"
        or not is_yaml
        or any(
            re.search(rf"(?<![\w-]){re.escape(match[3])}(?![\w-])", other.text)
            for other in model.related_files.values()
            if other is not source
        )
    ):
        return False
    position = source.position(match.start(3))
    return any(
        value.line == position.line and re.search(_DRIVE_CONTROLLER, controller.kind) is not None
        for controller in settings(source)
        for key, value in controller.group.entries
        if key.text == match[1]
    )


_DRIVE_CONTROLLER = r"^(?:diff_drive|mecanum_drive|tricycle|\w+_steering)_controller/"
