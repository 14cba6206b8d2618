"""The extensions of URDF: transmissions, ``<gazebo>`` and ``<ros2_control>``."""

from urdfkit.description.urdf.robot import (
    Actuator,
    GazeboBlock,
    Plugin,
    Ros2Control,
    SensorTag,
    Transmission,
    TransmissionJoint,
)
from urdfkit.description.urdf.values import GAZEBO_VALUES, Reader
from urdfkit.description.xml.element import Element


def transmission(reader: Reader, element: Element) -> Transmission:
    """Read a ``<transmission>``, in the current form (``<type>``) or the old form (``type=…``)."""
    kind = element.find("type")
    return Transmission(
        element.get("name"),
        kind.text if kind is not None else element.get("type"),
        tuple([TransmissionJoint(e.get("name"), _interfaces(e), e) for e in element.find_all("joint")]),
        tuple(
            [
                Actuator(e.get("name"), _interfaces(e), reader.inner_number(e.find("mechanicalReduction")), e)
                for e in element.find_all("actuator")
            ]
        ),
        element,
    )


def gazebo_block(reader: Reader, element: Element) -> GazeboBlock:
    """Read a ``<gazebo>``; children other than plugins and sensors are only in its element."""
    for child in element.children:
        if child.tag in GAZEBO_VALUES:
            reader.check_gazebo_value(child)
    sensors = [SensorTag(e.get("name"), e.get("type"), plugins_in(e), e) for e in element.find_all("sensor")]
    return GazeboBlock(element.get("reference"), plugins_in(element), tuple(sensors), element)


def ros2_control(element: Element) -> Ros2Control:
    """Read a ``<ros2_control>``; hardware and joints are only in its element."""
    return Ros2Control(element.get("name"), element.get("type"), element)


def plugins_in(element: Element) -> tuple[Plugin, ...]:
    """Return the ``<plugin>`` children of an element."""
    return tuple([Plugin(e.get("name"), e.get("filename"), e) for e in element.find_all("plugin")])


def _interfaces(element: Element) -> tuple[str, ...]:
    return tuple([child.text for child in element.find_all("hardwareInterface")])
