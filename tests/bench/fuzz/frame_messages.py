"""Valid messages of pages, with the names of a running simulation or viewer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from urdfkit.app.viewer.session import Session
    from urdfkit.sim.simulator import Simulator
    from urdfkit.view.server.server import Server

COMMON: tuple[dict[str, Any], ...] = (
    {"type": "ack", "sequence": 1},
    {"type": "seen", "key": "sensor:/scan", "sequence": 1},
    {"type": "joints", "positions": {"joint1": 0.5, "missing": 1.0}},
    {"type": "axes", "axes": [1, 0, 0, -0.5], "speed": 0.5, "turn": 1.0, "robot": ""},
    {"type": "axes", "axes": [0, 0, 0, 0], "speed": 0.5, "turn": 1.0},
    *({"type": "control", "action": action} for action in ("play", "pause", "reset", "stop")),
)


def _requests(values: dict[str, list[dict[str, Any]]]) -> list[dict[str, Any]]:
    return [
        {"type": "request", "number": number, "name": name, "values": each}
        for number, (name, some) in enumerate(values.items())
        for each in some
    ]


def sim_messages(simulator: Simulator, server: Server) -> list[dict[str, Any]]:
    """Return messages to a simulation; each of its requests is among them."""
    robot, links = simulator.name, simulator.kinematics.link_names
    topics = {topic.name: topic.type for topic in simulator.bus.topics}
    arms = [
        {"controller": f"{robot}/{each.name}", "joint": claim.split("/")[0], "value": 0.3}
        for each in simulator.controllers.list()
        for claim in each.claims
    ] or [{"controller": "arm", "joint": "joint1", "value": 0.1}]
    door = {"segment": 0, "at": 1.0, "width": 0.8}
    walls = {"corners": [[0, 0], [3, 0], [3, 2]], "doors": [door], "height": 2.5, "thickness": 0.1, "name": "walls"}
    push = {"link": links[-1], "force": [0, 5, 0], "torque": [0, 0, 1], "at": [0, 0, 0]}
    twist = {"linear": {"x": 0.5, "y": 0.0, "z": 0.0}, "angular": {"x": 0.0, "y": 0.0, "z": 0.5}}
    spawned = [{"model": name, "pose": [1.0, k, 0.5]} for k, name in enumerate(("unit_box", "ball", "rrbot"))]
    requests = _requests(
        {
            "step": [{"steps": 5}],
            "speed": [{"factor": 2.0}, {}],
            "form": [{"topic": topic, "type": kind} for topic, kind in list(topics.items())[:6]],
            "publish": [
                {"topic": "/cmd_vel", "type": "geometry_msgs/msg/Twist", "message": twist},
                {"topic": "/new", "type": "std_msgs/msg/Float64MultiArray", "message": {"data": [1, 2.5]}},
                {"topic": "/new_image", "type": "sensor_msgs/msg/Image", "message": {"data": [1, 2], "height": 1}},
            ],
            "spawn": [*spawned, {"model": "wall", "name": "w", "pose": [2, 0, 0, 0, 0, 1.5]}],
            "place": [{"name": robot, "pose": [0, 0, 0.1]}, {"name": "unit_box", "pose": [1, 1, 1, 0, 0, 0, 1]}],
            "duplicate": [{"name": "ball", "pose": [2, 2, 0.5]}, {"name": robot, "pose": [0, 3, 0.1]}],
            "remove": [{"name": "unit_box"}, {"name": "ball"}],
            "restore": [{"name": "unit_box"}, {"name": "missing"}],
            "publish_pose": [{"as": tool, "position": [1.0, 2.0], "yaw": 0.5} for tool in ("goal", "estimate")],
            "get_pose": [{"name": robot}, {"name": "unit_box"}],
            "walls": [walls],
            "save": [{"name": "world"}],
            "arm": arms[:6],
            "controller": [{"controller": each["controller"], "running": False} for each in arms[:2]],
            "gravity": [{"gravity": [0, 0, -9.81]}],
            "mass": [{"name": robot, "mass": 2.0, "link": links[-1]}, {"name": "unit_box", "mass": 0.5}],
            "mu": [{"name": robot, "mu": 0.8, "link": links[0]}],
            "gains": [{"path": f"{robot}/joint1", "p": 10.0, "i": 0.1, "d": 1.0, "clamp": 5.0}],
            "push": [push],
            "release": [{}],
            "services": [{}],
            "service_type": [{"service": "/pause_physics"}],
            "call_service": [
                {"service": "/get_simulation_state", "request": {}},
                {"service": "/spawn_entity", "request": {"name": "x"}},
            ],
            "actions": [{}],
            "send_goal": [{"action": "/arm/follow_joint_trajectory", "goal": {"trajectory": {"joint_names": ["a"]}}}],
            "goal_state": [{"goal": 1}],
            "cancel_goal": [{"goal": 1}],
            "record": [{"on": True, "topics": True, "pictures": False}, {"on": False}],
            "replay": [
                {"action": "pause"},
                *({"action": a, "at": 0.1, "speed": 1.0} for a in ("show", "play", "end")),
            ],
        }
    )
    missing = set(server.requests) - {message["name"] for message in requests}
    assert not missing, f"requests without a message: {missing}"
    names = list(topics)
    keys = [[f"{kind}:{name}" for name in names[:8]] for kind in ("sensor", "echo", "times", "sizes", "messages")]
    fields = [f"field:{name}:{path}" for name in names[:8] for path in ("header.stamp.sec", "data[0]", "x.y[2].z")]
    some = [*keys, fields, ["topics", "arms", "contacts", "slip"], [f"full_messages:{name}" for name in names[:4]]]
    return [*COMMON, *requests, *({"type": "subscribe", "keys": each} for each in some)]


def view_messages(session: Session) -> list[dict[str, Any]]:
    """Return messages to the viewer."""
    names = list(session.positions)
    link = session.shown.kinematics.link_names[-1]
    requests = _requests(
        {"point": [{"frame": link, "position": [0.1, 0, 0]}] * 3, "fix": [{"finding": 1}], "spawn": [{}]}
    )
    sliders = [{"type": "joints", "positions": dict.fromkeys(names[k : k + 3], 0.4)} for k in range(3)]
    return [*COMMON, *requests, *sliders, {"type": "subscribe", "keys": ["topics"]}]
