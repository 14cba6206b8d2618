"""Speeds that a Nav2 controller aims at and that the velocity smoother does not let through.

The parameters are those of nav2_regulated_pure_pursuit_controller, nav2_dwb_controller and nav2_velocity_smoother;
only the last were compared with the source.
"""

from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_wheels import diff_drives, wheels_of
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of, walk, yamls
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.model.model import Model

_AIMS = ("desired_linear_vel", "max_vel_x", "vx_max")
_MAX_RATIO = 2.0
"""Accepted ratio; many robots leave a higher speed to a smoother on purpose."""


_SPEEDS = ("desired_linear_vel", "max_vel_x", "vx_max", "max_vel_trans", "linear.x.max_velocity")
_SCALES = ("scale_linear", "scale_linear_turbo")
_MAX_WHEEL_RATIO = 1.1
"""Accepted ratio."""

_PLACEHOLDER = 10.0
"""Ratio above which the limit of the joint is a placeholder."""

_FEW = 2
"""Number of values beyond the limit that are wrong one by one; more of them follow the limit."""


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


def speeds_beyond_wheels(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield the linear speeds above that at which a wheel joint turns with its greatest velocity."""
    limits = list(_limits(model))
    if len(limits) != 1:
        return
    joint, most = limits[0]
    found = [
        (source, value, name, speed)
        for source in yamls(model)
        for name, value in _speeds(source)
        if (speed := number_of(value)) is not None and speed > _MAX_WHEEL_RATIO * most
    ]
    if any(speed > _PLACEHOLDER * most for _, _, _, speed in found):
        return
    for source, value, name, speed in found if len(found) <= _FEW else ():
        message = f"`{name}` is {speed:g} m/s, but the velocity limit of joint `{joint}` allows {most:.3g} m/s"
        yield source, value, message


def _limits(model: Model) -> Iterator[tuple[str, float]]:
    """Yield the wheel joint with the least velocity and its speed over the ground [m/s], for each drive."""
    for _, controller in diff_drives(model):
        radius = number_of(controller.group.find("wheel_radius"))
        wheels = [wheel for side in ("left", "right") for _, wheel in wheels_of(controller, model, side)]
        found = [
            (limit.velocity * size, wheel.joint.name)
            for wheel in wheels
            if (limit := wheel.joint.limit) is not None and limit.velocity is not None and limit.velocity > 0.0
            if (size := radius if radius is not None else max(wheel.radii, default=0.0)) > 0.0
        ]
        if found and len(found) == len(wheels):
            speed, name = min(found)
            yield name, speed


def _speeds(source: Source) -> Iterator[tuple[str, Node]]:
    seen = set[int]()
    for node in nodes(source):
        for key, value in node.entries:
            parts = [value] if key.text in (*_SPEEDS, *_SCALES) and value.kind == "text" else []
            if key.text in _SCALES and (along := value.find("x")) is not None:
                parts = [along]
            elif key.text == "max_velocity" and value.kind == "list" and value.items:
                parts = [value.items[0]]
            elif key.text == "linear" and (axis := value.find("x")) is not None and axis.find("max_velocity"):
                parts = [part for part in [axis.find("max_velocity")] if part is not None]
            for part in parts:
                if id(part) not in seen:
                    seen.add(id(part))
                    yield key.text if key.text != "linear" else "linear.x.max_velocity", part
