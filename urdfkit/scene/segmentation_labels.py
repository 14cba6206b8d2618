"""Labels of segmentation and bounding-box cameras, by the label system of gz sim."""

from collections.abc import Iterable

from urdfkit.description.plugins.lookup import stem
from urdfkit.description.urdf.robot import Plugin, Robot

LABEL_SYSTEMS = ("gz-sim-label-system", "ignition-gazebo-label-system")

MAX_LABEL = 255
"""Labels are bytes."""


def label_of(plugins: Iterable[Plugin]) -> int:
    """Return the ``<label>`` of a label system among the plugins; 0 (unlabelled) without one."""
    for plugin in plugins:
        written = plugin.element.find("label")
        if stem(plugin.filename or "") in LABEL_SYSTEMS and written is not None:
            try:
                label = int(written.text)
            except ValueError:
                continue
            if 0 <= label <= MAX_LABEL:
                return label
    return 0


def labels_of(robot: Robot) -> dict[str, int]:
    """Return link → label; the label of the whole robot has an empty name."""
    found: dict[str, int] = {}
    for block in robot.gazebo:
        visual = block.element.find("visual")
        inside = [] if visual is None else [Plugin(e.get("name"), e.get("filename"), e) for e in visual.children]
        if label := label_of((*block.plugins, *inside)):
            found[block.reference or ""] = label
    return found
