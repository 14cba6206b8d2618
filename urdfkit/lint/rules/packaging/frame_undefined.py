"""K961 yaml-link-undefined."""

import re
from collections.abc import Iterator

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
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

_OF_OCTOMAP = (
    r"(?m)[\"']?\b(octomap_frame)\b([\"']?)(?:\s*:\s*|\s+(?:type=\"\w+\"\s+)?value=)[\"']?([\w/]+)[\"']?"
    r"[ \t]*(?=[,}/>\r]|$)"
)
"""Matches the frame of the octomap of MoveIt in launch files and YAML."""

_ANY_FRAME = ("frame_id", "sensor_frame")
"""Parameters that can name frames of other robots."""


class FrameUndefined(RobotRule):
    """A parameter in YAML names a link that does not exist in the robot.

    ## What it does
    Checks these parameters in the YAML files of the robot's package and of neighbouring packages that depend on it:

    - ``base_frame_id``, ``base_frame``, ``robot_base_frame`` and ``base_link_frame``, also in launch files
    - ``base_link``, ``root_link``, ``tip_link`` and ``ee_link`` of arms
    - ``frame_id`` and ``sensor_frame``, if the name differs from a link by one letter
    - the frames of well-known sensor drivers in launch files
    - the frame of the octomap of MoveIt, which another file must name

    The rule reports misspelt link names, unless another description in these packages defines a link of that name.
    Other names are reported only if no other file in these packages mentions them, and only in three parameters:

    - a frame of a drive controller or broadcaster
    - the ``sensor_frame`` of a sensor of the robot
    - a base frame next to a map or odometry frame, if another parameter names a link as base frame

    ## Why is this bad?
    The controller publishes a frame that is not part of the TF tree, or navigation waits for a frame that never
    appears.

    ## Example
    ```diff
     drive:
       ros__parameters:
    -    base_frame_id: base_linc
    +    base_frame_id: base_link
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K961"
    name = "yaml-link-undefined"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each named link that no description in these packages can define."""
        from urdfkit.lint.facts.control.launch_package_paths import uncommented
        from urdfkit.lint.facts.nodes.driver_frames import unknown_frames
        from urdfkit.lint.facts.ros_packages import is_slip
        from urdfkit.lint.fix_builders import meant

        links_by_name = model.robot.link_by_name
        if not links_by_name:
            return
        for source, frame in unknown_frames(model):
            span = source.span(frame.start, frame.end)
            hint = meant(frame.name, links_by_name)[1]
            message = f"robot `{model.robot.name}` has no link `{frame.name}`, the frame of this node" + hint
            yield self.at_span(span, message, link=frame.name)
        for source in model.related_files.values():
            for match in _named(source, uncommented(source)):
                name = match[3].rpartition("/")[2]
                if name in links_by_name:
                    continue
                if match[1] == "octomap_frame":
                    yield from self._of_octomap(source, match, model)
                    continue
                suggestion, hint = meant(name, links_by_name)
                needs_slip = match[1] in _ANY_FRAME or not source.file.endswith((".yaml", ".yml"))
                is_slip_of_link = suggestion is not None and (not needs_slip or is_slip(name, suggestion))
                if not is_slip_of_link and not _is_of_robot(source, match, model):
                    continue
                if model.neighbouring_descriptions.define("link", name):
                    continue
                message = f"`{match[1]}` is `{name}`, but robot `{model.robot.name}` has no such link" + hint
                finding = self.at_span(source.span(*match.span(3)), message, link=name)
                yield from unless_masked(model, name, suggestion, finding)

    def _of_octomap(self, source: Source, match: re.Match[str], model: Model) -> Findings:
        """Yield a finding for the frame of the octomap if nothing else in these packages names it."""
        from urdfkit.lint.facts.topics.words import Words

        if not model.is_incomplete and Words(model).occurs_once(match[3]):
            message = f"no other file names the frame `{match[3]}` of the octomap"
            yield self.at_span(source.span(*match.span(3)), message, link=match[3])


def _named(source: Source, text: str) -> Iterator[re.Match[str]]:
    """Yield the parameters that name a link: the name in group 1 and the link in group 3."""
    yield from re.finditer(_OF_OCTOMAP, text) if "octomap_frame" in text else ()
    if source.file.endswith((".yaml", ".yml")):
        yield from re.finditer(_FRAME, text)
    elif source.file.endswith(LAUNCH) and "frame" in text:
        pattern = _IN_PYTHON if source.file.endswith(".py") else _IN_XML
        yield from (match for match in re.finditer(pattern, text) if match[1] in _IN_LAUNCH)


def _is_of_robot(source: Source, match: re.Match[str], model: Model) -> bool:
    """Return whether a frame in YAML must be a link of the robot, and no other file mentions it.

    They are the frames of drive controllers, broadcasters and sensors of the robot, and base frames next to others.
    """
    from urdfkit.lint.facts.control.controller_settings import settings
    from urdfkit.lint.facts.control.yaml_tree import nodes
    from urdfkit.lint.facts.gazebo.sensor_topics import published

    pattern = rf"(?<![\w-]){re.escape(match[3])}(?![\w-])"
    others = [other.text for other in model.related_files.values() if other is not source]
    if not source.file.endswith((".yaml", ".yml")) or any(re.search(pattern, text) for text in others):
        return False
    line = source.position(match.start(3)).line
    if match[1] in ("base_frame_id", "frame_id"):
        of_robot = [one for one in settings(source) if re.search(_OF_ROBOT, one.kind) is not None]
        written = (entry for one in of_robot for entry in one.group.entries)
        if any(value.line == line and key.text == match[1] for key, value in written):
            return True
    groups = nodes(source)
    around = [node for node in groups if any((key.text, value.line) == (match[1], line) for key, value in node.entries)]
    if match[1] == "sensor_frame":
        topics = {publication.topic.strip("/") for publication in published(model)}
        read = [node.find("topic") for node in around]
        return any(topic is not None and topic.text.strip("/") in topics for topic in read)
    is_alone = not any(node.find(name) is not None for node in around for name in _FIXED)
    if is_alone and match[1] != "robot_base_frame":
        return False
    text = source.text[: match.start()] + source.text[match.end() :]
    if match[1] not in _IN_LAUNCH or model.is_incomplete or re.search(pattern, text):
        return False
    bases = (found[3] for other in (*others, text) for found in re.finditer(_FRAME, other) if found[1] in _IN_LAUNCH)
    return any(base in model.robot.link_by_name for base in bases)


_FIXED = ("odom_frame", "odom_frame_id", "global_frame", "global_frame_id", "map_frame", "local_frame")
"""Parameters next to the base frame of a node of navigation or localization."""

_OF_ROBOT = r"^(?:diff_drive|mecanum_drive|tricycle|\w+_steering)_controller/|Broadcaster$"
"""Matches the types of controllers whose frame is a link."""
