"""Service: a function of the simulation that peers can call."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from urdfkit.errors import UrdfkitError
from urdfkit.messages import from_fields


@dataclass(frozen=True, slots=True)
class Service:
    """A service; `call` runs in the thread of the simulation.

    Attributes:
        name: absolute, e.g. ``/gazebo/reset_simulation``.
        type: e.g. ``std_srvs/srv/Empty``; its messages are this name with ``_Request`` and ``_Response``.
        call: takes the request, a message, and returns the response; may raise `UrdfkitError`.
    """

    name: str
    type: str
    call: Callable[[Any], Any]

    @property
    def request(self) -> str:
        """Message type of the request."""
        return f"{self.type}_Request"

    @property
    def response(self) -> str:
        """Message type of the response."""
        return f"{self.type}_Response"


def response(type: str, **values: Any) -> Any:
    """Return the response of a service type with these fields."""
    return from_fields(f"{type}_Response", values or None)


def respond(service: Service, request: Any, done: Callable[[Any, str | None], None]) -> None:
    """Call a service in the thread of the simulation; `done` receives its response, or None and the reason."""
    try:
        found, reason = service.call(request), None
    except (UrdfkitError, ArithmeticError, LookupError, TypeError, ValueError) as error:
        found, reason = None, str(error)
    done(found, reason)
