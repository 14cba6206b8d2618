"""Rejection of invalid requests: one line on the wire and on standard error, never a traceback."""

import logging
from collections.abc import Mapping
from typing import Any

from pygls.exceptions import JsonRpcException, JsonRpcInvalidParams
from pygls.protocol import LanguageServerProtocol


class Protocol(LanguageServerProtocol):
    """The protocol with an error response to every invalid request; pygls leaves the editor waiting for ever."""

    def structure_message(self, data: dict[str, Any]) -> Any:
        """Return a message structured by pygls; None for a request that has been rejected.

        Raises:
            JsonRpcException: a notification is invalid.
        """
        try:
            return super().structure_message(data)
        except JsonRpcException as error:
            if not _is_request(data):
                raise
            refusal = JsonRpcInvalidParams(_reason(error))
            self._send_response(data["id"], error=refusal.to_response_error())
            return None

    def handle_message(self, message: Any) -> None:
        """Handle a message, unless it has been rejected."""
        if message is not None:
            super().handle_message(message)


class OneLine(logging.Formatter):
    """Log formatter that prints each error in one line."""

    def format(self, record: logging.LogRecord) -> str:
        """Return the first line of a message, with the exception."""
        text = record.getMessage().partition("\n")[0]
        raised = record.exc_info[1] if record.exc_info else None
        cause = f": {type(raised).__name__}: {_reason(raised)}" if raised is not None else ""
        return f"urdfkit: {text[:200]}{cause}"


def log_in_one_line() -> None:
    """Make pygls log each error in one line, and omit rejected requests, which the editor reports."""
    handler = logging.StreamHandler()
    handler.setLevel(logging.WARNING)
    handler.setFormatter(OneLine())
    handler.addFilter(lambda record: not _is_answered(record))
    for name in ("pygls", "asyncio"):
        logger = logging.getLogger(name)
        logger.addHandler(handler)
        logger.propagate = False


def _is_answered(record: logging.LogRecord) -> bool:
    """Whether the editor receives the error, another line reports it, or the editor has disconnected."""
    raised = record.exc_info[1] if record.exc_info else None
    is_refusal = isinstance(raised, JsonRpcInvalidParams) and raised.__cause__ is None
    has_gone = isinstance(raised, ConnectionError) or (isinstance(raised, ValueError) and "closed file" in str(raised))
    return is_refusal or has_gone or str(record.msg).startswith(("Unable to deserialize", "Failed to report error"))


def _is_request(data: Mapping[str, Any]) -> bool:
    return "method" in data and isinstance(data.get("id"), (int, str))


def _reason(error: BaseException) -> str:
    """Return the root cause of an error, in one line."""
    while True:
        below = getattr(error, "exceptions", None)
        if below:
            error = below[0]
        elif isinstance(error, JsonRpcException) and error.__cause__ is not None:
            error = error.__cause__
        else:
            return " ".join(str(error).split())
