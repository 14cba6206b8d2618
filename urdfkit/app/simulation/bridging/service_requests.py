"""Requests of the command ``service``: list the services of a simulation or of another graph, and call them."""

from collections.abc import Callable, Mapping
from typing import Any, Protocol

from urdfkit.app.simulation.features.feature import Done, Takes
from urdfkit.bridges.json_messages import from_json, json_values
from urdfkit.bridges.service import Service, respond
from urdfkit.bus import absolute, similar_topic
from urdfkit.errors import SimulationError, UsageError
from urdfkit.view.protocol.page_requests import Request, Schema, text, tree


class Callables(Protocol):
    """Services by name, such as those of a `Node`; each method raises `UrdfkitError`."""

    def services(self) -> list[str]:
        """Return the names of the services."""

    def service_type(self, service: str) -> str:
        """Return the type of a service; an empty string if it is unknown."""

    def call(self, service: str, type: str, fields: Any) -> Any:
        """Call a service and return the fields of its response as JSON values."""


class SimulationServices:
    """Services of a simulation, called in its thread.

    Args:
        find: returns the services, by name.
    """

    def __init__(self, find: Callable[[], Mapping[str, Service]]) -> None:
        self._find = find

    def services(self) -> list[str]:
        """Return the names of the services."""
        return sorted(self._find())

    def service_type(self, service: str) -> str:
        """Return the type of a service; an empty string if it is unknown."""
        found = self._find().get(service)
        return "" if found is None else found.type

    def call(self, service: str, type: str, fields: Any) -> Any:
        """Call a service and return the fields of its response.

        Raises:
            SimulationError: the service fails.
        """
        found = self._find()[service]
        answers: list[tuple[Any, str | None]] = []
        respond(found, from_json(found.request, fields), lambda *answer: answers.append(answer))
        ((response, reason),) = answers
        if reason is not None:
            raise SimulationError(f"{service}: {reason}")
        return json_values(response)


def service_requests(source: Callables) -> Takes:
    """Return the requests to list services, and to call one of them.

    Args:
        source: the services.
    """

    def named(request: Request) -> tuple[str, str]:
        name = absolute(request.values["service"])
        if not (type := source.service_type(name)):
            raise UsageError(f"unknown service `{name}`{similar_topic(name, source.services())}")
        return name, type

    def type_of(request: Request) -> Done:
        return {"type": named(request)[1]}

    def call(request: Request) -> Done:
        return {"response": source.call(*named(request), request.values["request"])}

    return {
        "services": (Schema({}, changes=False), lambda _: {"services": source.services()}),
        "service_type": (Schema({"service": text()}, changes=False), type_of),
        "call_service": (Schema({"service": text(), "request": tree}), call),
    }
