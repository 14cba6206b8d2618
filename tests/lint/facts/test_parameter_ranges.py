"""Numbers of parameters against their sensible ranges."""

import pytest

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import nodes
from urdfkit.lint.facts.parameters.ranges import out_of_range

TRICYCLE = "traction_joint_name: steered\nwheel_radius: 0.1\ncmd_vel_timeout: "
DIFFERENTIAL = "wheel_separation: 0.4\nwheel_radius: 0.1\ncmd_vel_timeout: "


@pytest.mark.parametrize(
    ("text", "messages"),
    [
        (f"{TRICYCLE}500\n", []),
        (f"{TRICYCLE}0.5\n", ["`cmd_vel_timeout` is 0.5 ms, less than 10 ms; check the unit and the value"]),
        (f"{DIFFERENTIAL}500.0\n", ["`cmd_vel_timeout` is 500 s, more than 10 s; check the unit and the value"]),
        (f"{DIFFERENTIAL}0.5\n", []),
    ],
)
def test_the_timeout_of_the_tricycle_controller_is_in_milliseconds(text, messages):
    source = Source("controllers.yaml", text)
    assert [message for _, message in out_of_range(nodes(source))] == messages
