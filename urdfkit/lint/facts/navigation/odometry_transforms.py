"""Transforms of the odometry that a drive controller and a filter of robot_localization both publish."""

from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import ControllerSettings, settings
from urdfkit.lint.facts.control.yaml_tree import Node, documents, yamls
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.model.model import Model

_TRUE = ("true", "True", "TRUE")


def published_twice(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield the ``enable_odom_tf`` of each controller whose transform a filter publishes too: file, value, message."""
    filters = [(source, group) for source in yamls(model) for group in _filters(source)]
    if not filters:
        return
    for source in yamls(model):
        for controller in settings(source) if "enable_odom_tf" in source.text else ():
            enabled = controller.group.find("enable_odom_tf")
            if enabled is None or enabled.text not in _TRUE:
                continue
            other = next((file for file, group in filters if _is_same_transform(group, controller)), None)
            if other is not None:
                message = (
                    f"`enable_odom_tf` of controller `{controller.name}` is true, but the filter in "
                    f"{other.file.rpartition('/')[2]} publishes the same transform; "
                    "set this, or `publish_tf` of the filter, to false"
                )
                yield source, enabled, message


def filters(model: Model) -> list[tuple[str, str]]:
    """Return the file of each filter that publishes the transform from the odometry frame, and this frame."""
    found = [(source.file, group.find("odom_frame")) for source in yamls(model) for group in _filters(source)]
    return [(file, frame.text.strip("/")) for file, frame in found if frame is not None]


def _filters(source: Source) -> Iterator[Node]:
    """Yield the parameters of each filter that publishes the transform from the odometry frame."""
    if "world_frame" not in source.text:
        return
    groups = [group for _, group in sections(source)] or [
        group for root in documents(source) for group in (root, *(value for _, value in root.entries))
    ]
    for group in groups:
        world, odom, publishes = (group.find(name) for name in ("world_frame", "odom_frame", "publish_tf"))
        is_published = publishes is None or publishes.text in _TRUE
        if is_published and world is not None and odom is not None and world.text == odom.text:
            yield group


def _is_same_transform(group: Node, controller: ControllerSettings) -> bool:
    odom, frame = group.find("odom_frame"), controller.group.find("odom_frame_id")
    return odom is not None and odom.text.strip("/") == (frame.text.strip("/") if frame is not None else "odom")
