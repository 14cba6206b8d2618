"""Text frames of the server: its capabilities, channels, services and parameters."""

import json
from collections.abc import Iterable, Mapping
from typing import Any

from urdfkit.bridges.foxglove.encodings import ENCODINGS, definition
from urdfkit.bridges.service import Service

CAPABILITIES = ("clientPublish", "parameters", "services", "assets", "time")
ERROR = 2
"""Level of a status."""


def server_info(session: str) -> str:
    """Return the first message of a connection."""
    return json.dumps(
        {
            "op": "serverInfo",
            "name": "urdfkit",
            "capabilities": CAPABILITIES,
            "supportedEncodings": ENCODINGS,
            "metadata": {"ROS_DISTRO": "humble"},
            "sessionId": session,
        }
    )


def advertise(channels: Iterable[tuple[int, str, str]]) -> str:
    """Return the message about channels: id, topic, type."""
    rows = [
        {
            "id": number,
            "topic": topic,
            "encoding": "cdr",
            "schemaName": type,
            "schema": definition(type),
            "schemaEncoding": "ros2msg",
        }
        for number, topic, type in channels
    ]
    return json.dumps({"op": "advertise", "channels": rows})


def advertise_services(services: Mapping[int, Service]) -> str:
    """Return the message about services."""
    rows = [
        {"id": number, "name": service.name, "type": service.type}
        | {"request": _part(service.request), "response": _part(service.response)}
        for number, service in services.items()
    ]
    return json.dumps({"op": "advertiseServices", "services": rows})


def _part(type: str) -> dict[str, str]:
    return {"encoding": "cdr", "schemaName": type, "schemaEncoding": "ros2msg", "schema": definition(type)}


def parameter_values(parameters: Mapping[str, Any], names: Iterable[str], request: Any) -> str:
    """Return the values of parameters; of all for no names."""
    wanted = list(names) or list(parameters)
    rows = [{"name": name, "value": parameters[name]} for name in wanted if name in parameters]
    return json.dumps({"op": "parameterValues", "parameters": rows} | ({} if request is None else {"id": request}))


def status(reason: str) -> str:
    """Return an error message."""
    return json.dumps({"op": "status", "level": ERROR, "message": reason})


def service_failure(service: int, call: int, reason: str) -> str:
    """Return the failure of a call."""
    return json.dumps({"op": "serviceCallFailure", "serviceId": service, "callId": call, "message": reason})
