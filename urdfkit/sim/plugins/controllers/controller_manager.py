"""Services of controller_manager, also as topics: a topic with the name of a service carries its requests.

Sources: ros_control noetic, controller_manager; ros2_control, controller_manager. A failed request is reported as a
warning: a topic has no response, and a response has no reason.
"""

from collections.abc import Callable
from typing import Any

from urdfkit.errors import UrdfkitError
from urdfkit.messages import from_fields
from urdfkit.messages.control import CONFIGURE, LIST, LOAD, SWITCH, UNLOAD
from urdfkit.sim.plugins.controllers.control_loop import ControlLoop

BEST_EFFORT = 1
"""Strictness at which controllers that cannot be switched are skipped."""


def serve(loop: ControlLoop, manager: str = "controller_manager") -> None:
    """Subscribe to the requests to a control loop, and add its services for ROS 2.

    Args:
        loop: control loop that executes the requests.
        manager: node name of the controller manager.
    """
    hardware = loop.hardware

    def listen(service: str, type: str, act: Callable[[Any], object]) -> None:
        topic, response = hardware.resolve(f"{manager}/{service}"), type.replace("_Request", "_Response")

        def receive(message: Any) -> Any:
            try:
                done = act(message)
            except UrdfkitError as error:
                hardware.setup.note(f"{topic}: {error}")
                done = False
            return from_fields(response, {"ok": done is not False})

        hardware.setup.bus.subscribe(topic, type, receive)
        if hardware.ros == 2:
            loop.services[topic] = type.removesuffix("_Request"), receive

    def switch(message: Any) -> None:
        start = [*message.activate_controllers, *message.start_controllers]
        stop = [*message.deactivate_controllers, *message.stop_controllers]
        if message.strictness != BEST_EFFORT:
            loop.switch(start=start, stop=stop)
            return
        for one in [{"stop": [name]} for name in stop] + [{"start": [name]} for name in start]:
            try:
                loop.switch(**one)
            except UrdfkitError as error:
                hardware.setup.note(f"{hardware.resolve(f'{manager}/switch_controller')}: {error}")

    listen("load_controller", LOAD, lambda message: loop.load(message.name))
    listen("unload_controller", UNLOAD, lambda message: loop.unload(message.name))
    listen("switch_controller", SWITCH, switch)
    if hardware.ros == 2:  # `load` configures, too
        listen("configure_controller", CONFIGURE, lambda message: loop.load(message.name))
        loop.services[hardware.resolve(f"{manager}/list_controllers")] = LIST, lambda _: _states(loop)


def _states(loop: ControlLoop) -> Any:
    rows = [
        {"name": each.name, "state": each.state, "type": each.type, "claimed_interfaces": list(each.claims)}
        for each in loop.status()
        if each.state != "unloaded"
    ]
    return from_fields(f"{LIST}_Response", {"controller": rows})
