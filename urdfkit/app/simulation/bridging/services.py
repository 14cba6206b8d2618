"""Services of a simulation for the peers of bridges: those of Gazebo Classic, gz, ros2_control and the standard."""

from collections.abc import Callable
from typing import Any

from urdfkit.app.simulation.bridging.simulation_interfaces import Controls, standard_services
from urdfkit.bridges.service import Service, response
from urdfkit.errors import SimulationError, UrdfkitError
from urdfkit.sim.simulator import Simulator

EMPTY = "std_srvs/srv/Empty"
MOST_STEPS = 10_000
"""Steps of one request."""

Act = Callable[[Any], object]


def simulation_services(simulator: Simulator, controls: Controls) -> dict[str, Service]:
    """Return the services of a simulation by name."""
    found: dict[str, Service] = {}

    def add(name: str, type: str, act: Act) -> None:
        found[name] = Service(name, type, _answering(type, act))

    for prefix in ("/gazebo", ""):  # Gazebo Classic under ROS 1 and ROS 2
        add(f"{prefix}/pause_physics", EMPTY, lambda _: controls.pause(True))
        add(f"{prefix}/unpause_physics", EMPTY, lambda _: controls.pause(False))
        add(f"{prefix}/reset_simulation", EMPTY, lambda _: controls.reset())
    requests, world = simulator.requests, f"/world/{simulator.world.name}"
    for name, type in (
        ("/gazebo/spawn_sdf_model", "gazebo_msgs/srv/SpawnModel"),
        ("/gazebo/spawn_urdf_model", "gazebo_msgs/srv/SpawnModel"),
        ("/gazebo/delete_model", "gazebo_msgs/srv/DeleteModel"),
        ("/gazebo/apply_body_wrench", "gazebo_msgs/srv/ApplyBodyWrench"),
        ("/gazebo/clear_body_wrenches", "gazebo_msgs/srv/BodyRequest"),
        (f"{world}/set_pose", "ros_gz_interfaces/srv/SetEntityPose"),
    ):
        add(name, type, requests[name])
    for name, type, part in (
        ("/gazebo/set_model_state", "gazebo_msgs/srv/SetModelState", "model_state"),
        (f"{world}/create", "ros_gz_interfaces/srv/SpawnEntity", "entity_factory"),
        (f"{world}/remove", "ros_gz_interfaces/srv/DeleteEntity", "entity"),
    ):
        add(name, type, _part(requests[name], part))
    add(f"{world}/control", "ros_gz_interfaces/srv/ControlWorld", lambda it: _control(simulator, controls, it))
    for robot in simulator.world.robots.values():
        found |= {name: Service(name, type, act) for name, (type, act) in robot.controllers.services.items()}
    found |= {service.name: service for service in standard_services(simulator, controls)}
    return found


def _part(act: Act, name: str) -> Act:
    return lambda request: act(getattr(request, name))


def _answering(type: str, act: Act) -> Callable[[Any], Any]:
    """Return a function that reports an error in the response, if its type has a field for it."""
    reports = "status_message" in type_fields(type)

    def call(request: Any) -> Any:
        try:
            act(request)
        except UrdfkitError as error:
            if reports:
                return response(type, success=False, status_message=str(error))
            raise
        return response(type, **({"success": True} if "success" in type_fields(type) else {}))

    return call


def type_fields(type: str) -> tuple[str, ...]:
    """Return the names of the fields of a service's response."""
    from urdfkit.messages import message_type

    return tuple(message_type(f"{type}_Response").__dataclass_fields__)


def _control(simulator: Simulator, controls: Controls, request: Any) -> None:
    """Pause, step and reset, as gz does."""
    control = request.world_control
    steps = control.multi_step or int(control.step)
    if steps > MOST_STEPS:
        raise SimulationError(f"{steps} steps are requested; request at most {MOST_STEPS} at once")
    if control.reset.all or control.reset.model_only or control.reset.time_only:
        controls.reset()
    controls.pause(bool(control.pause or steps))
    if steps:
        simulator.step(steps)
