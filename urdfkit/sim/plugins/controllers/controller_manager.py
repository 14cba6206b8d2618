"""Services of controller_manager, emulated by topics: a topic with the name of a service carries its requests.

Sources: ros_control noetic, controller_manager; ros2_control, controller_manager. A failed request is reported as a
warning, because a topic has no response.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from urdfkit.errors import UrdfkitError
from urdfkit.messages.control import CONFIGURE, LOAD, SWITCH, UNLOAD
from urdfkit.sim.plugins.controllers.control_loop import ControlLoop

BEST_EFFORT = 1
"""Strictness at which controllers that cannot be switched are skipped."""


def serve(loop: ControlLoop, manager: str = "controller_manager") -> None:
    """Subscribe to the requests to a control loop.

    Args:
        loop: control loop that executes the requests.
        manager: node name of the controller manager.
    """
    hardware = loop.hardware

    def listen(service: str, type: str, act: Callable[[Any], object]) -> None:
        topic = hardware.resolve(f"{manager}/{service}")

        def receive(message: Any) -> None:
            try:
                act(message)
            except UrdfkitError as error:
                hardware.setup.note(f"{topic}: {error}")

        hardware.setup.bus.subscribe(topic, type, receive)

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
