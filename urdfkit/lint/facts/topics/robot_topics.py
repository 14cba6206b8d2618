"""Topics that the robot itself has: those of Gazebo plugins and sensors, of bridges and of controllers."""

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.control.controller_joints import controllers
from urdfkit.lint.facts.control.ros_gz_bridges import in_launch
from urdfkit.lint.facts.control.yaml_tree import documents, yamls
from urdfkit.lint.facts.gazebo.plugins import references
from urdfkit.lint.facts.gazebo.sensor_topics import published
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.model.model import Model
from urdfkit.record import record

BRIDGE_KEYS = ("ros_topic_name", "topic_name", "gz_topic_name", "ign_topic_name")
"""Keys of ros_gz_bridge in YAML that name a topic."""


@record(eq=False)
class RobotTopics:
    """The topics of a robot, as the last parts of their names.

    Attributes:
        described: topics in the description.
        elements: topics in the description → the elements that name them.
        bridged: topics that a bridge names on either side.
        sensors: topics of sensors.
        controllers: names of controllers, below which controllers have their topics.
    """

    described: frozenset[str]
    elements: dict[str, tuple[Element, ...]]
    bridged: frozenset[str]
    sensors: frozenset[str]
    controllers: frozenset[str]

    @property
    def names(self) -> frozenset[str]:
        """All of them."""
        return self.described | self.bridged


def last(topic: str) -> str:
    """Return the name of a topic without its namespaces."""
    return topic.strip().rstrip("/").rpartition("/")[2]


def robot_topics(model: Model) -> RobotTopics:
    """Return the topics of the robot."""
    elements: dict[str, list[Element]] = {}
    sensors = set[str]()
    for publication in published(model):
        elements.setdefault(last(publication.topic), []).append(publication.element)
        sensors.add(last(publication.topic))
    for text, element, _, _ in references(model, ("topic",)):
        elements.setdefault(last(text), []).append(element)
    bridged = set[str]()
    for source in yamls(model):
        for item in (item for root in documents(source) for item in root.items):
            names = [last(node.text) for key in BRIDGE_KEYS if (node := item.find(key)) is not None]
            # A name that nearly equals the other side of its bridge may be misspelt.
            is_equal = len(names) < 2 or not is_slip(names[0], names[-1])
            bridged.update(names if is_equal else names[-1:])
    for name, source in model.related_files.items():
        if name.endswith(LAUNCH) and "_bridge" in source.text:
            bridged.update(last(bridge.topic.name) for bridge in in_launch(source) if bridge.topic is not None)
    return RobotTopics(
        frozenset(elements),
        {name: tuple(each) for name, each in elements.items()},
        frozenset(bridged) - {""},
        frozenset(sensors),
        frozenset(name for source in yamls(model) for name in controllers(source)),
    )
