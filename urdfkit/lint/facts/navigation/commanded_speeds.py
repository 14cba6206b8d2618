"""Speeds that a Nav2 controller aims at and that the velocity smoother does not let through.

The parameters are those of nav2_regulated_pure_pursuit_controller, nav2_dwb_controller and nav2_velocity_smoother;
only the last were compared with the source.
"""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, number_of, walk, yamls
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.model.model import Model

_AIMS = ("desired_linear_vel", "max_vel_x", "vx_max")
_MAX_RATIO = 2.0
"""Accepted ratio; many robots leave a higher speed to a smoother on purpose."""


def unreachable_speeds(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield the speeds of controllers that are far above the limit of the only velocity smoother."""
    found = [(source, key.text, group) for source in yamls(model) for key, group in sections(source)]
    smoothers = [group for _, name, group in found if name.strip("/").rpartition("/")[2] == "velocity_smoother"]
    if len(smoothers) != 1 or (listed := smoothers[0].find("max_velocity")) is None or not listed.items:
        return
    most = number_of(listed.items[0])
    for source, name, group in found if most is not None and most > 0.0 else ():
        if name.strip("/").rpartition("/")[2] != "controller_server":
            continue
        for key, value in (entry for node in walk(group) for entry in node.entries):
            speed = number_of(value) if key.text in _AIMS else None
            if speed is not None and most is not None and speed > _MAX_RATIO * most:
                message = f"`{key.text}` is {speed:g} m/s, but `max_velocity` of velocity_smoother is {most:g} m/s"
                yield source, value, message
