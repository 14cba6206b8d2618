"""What travels on the websocket, and the checks on every value that comes in.

Version 1. Text frames are JSON objects with a ``type``; binary frames whose first byte is 0x01 are packed poses, 0x02
what a sensor sees; other binary frames are meshcat commands (msgpack maps, whose first byte is neither).

Browser → Python: ``joints`` {positions: {name: value}}, ``axes`` {axes: [x, y, z, turn] each -1..1, speed, turn},
``control`` {action}, ``ack`` {sequence}.

Python → browser: ``hello``, ``model``, ``status``, ``fault``, ``progress``, ``driver``, ``joints``, ``sensors``.
"""

from __future__ import annotations

import json
import math
import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

VERSION = 1
MAX_INBOUND = 64 * 1024
"""Longest frame accepted from a browser [byte]."""
MAX_JOINTS = 2000
MAX_MAGNITUDE = 1e6
"""Largest joint position accepted [rad or m]."""
MAX_SPEED = 1000.0
"""Largest speed accepted [m/s, rad/s]; the default limit of teleop_twist_keyboard."""
ACTIONS = ("play", "pause", "reset")

POSE_HEADER = struct.Struct("<BBHId")
"""0x01, number of the model modulo 256, number of objects, sequence, time [s]: 16 bytes."""
POSE_MARK = 0x01
SENSED_MARK = 0x02
"""As `POSE_HEADER`: mark, kind (0 points, 1 a JPEG), number of the sensor, sequence, time [s]; then the content."""


class ProtocolError(Exception):
    """A frame from a browser that is dropped; the text says why."""


@dataclass(frozen=True, slots=True)
class Joints:
    """Joint positions set by hand [rad or m]."""

    positions: dict[str, float]


@dataclass(frozen=True, slots=True)
class Axes:
    """What a driver holds: `axes` (x, y, z, turn) in -1..1, `speed` [m/s] and `turn` [rad/s] to scale them with."""

    axes: tuple[float, float, float, float]
    speed: float
    turn: float

    @property
    def is_zero(self) -> bool:
        """Whether nothing is held."""
        return not any(self.axes)


@dataclass(frozen=True, slots=True)
class Control:
    """A button of the page: one of `ACTIONS`."""

    action: str


@dataclass(frozen=True, slots=True)
class Ack:
    """The browser has applied the pose frame with this sequence number."""

    sequence: int


Message = Joints | Axes | Control | Ack


def read(text: str | bytes) -> Message:
    """Read and check one frame from a browser.

    Raises:
        ProtocolError: anything but exactly one of the messages above with finite values inside the limits.
    """
    if isinstance(text, bytes):
        raise ProtocolError("binary frames are not accepted")
    try:
        message = json.loads(text, parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        raise ProtocolError("not JSON") from error
    if not isinstance(message, dict):
        raise ProtocolError("not a JSON object")
    kind = message.pop("type", None)
    try:
        reader, keys = _READERS[kind]
    except (KeyError, TypeError):
        raise ProtocolError("unknown type") from None
    if message.keys() != keys:
        raise ProtocolError(f"`{kind}` takes {', '.join(sorted(keys))} and nothing else")
    wish: Message = reader(message)
    return wish


def _refuse(constant: str) -> NoReturn:
    raise ProtocolError(f"{constant} is not a number")


def _number(value: object, limit: float) -> float:
    """Return a finite float of magnitude at most `limit`."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ProtocolError("not a number")
    if abs(value) > limit or not math.isfinite(value):
        raise ProtocolError(f"number outside ±{limit:g}")
    return float(value)


def _joints(message: dict[str, Any]) -> Joints:
    positions = message["positions"]
    if not isinstance(positions, dict) or len(positions) > MAX_JOINTS:
        raise ProtocolError(f"`positions` must be an object of at most {MAX_JOINTS} joints")
    return Joints({name: _number(value, MAX_MAGNITUDE) for name, value in positions.items()})


def _axes(message: dict[str, Any]) -> Axes:
    values = message["axes"]
    if not isinstance(values, list) or len(values) != 4:
        raise ProtocolError("`axes` must be four numbers")
    x, y, z, turn = (_number(value, 1.0) for value in values)
    speed, rate = _number(message["speed"], MAX_SPEED), _number(message["turn"], MAX_SPEED)
    if speed < 0 or rate < 0:
        raise ProtocolError("`speed` and `turn` must not be negative")
    return Axes((x, y, z, turn), speed, rate)


def _control(message: dict[str, Any]) -> Control:
    if message["action"] not in ACTIONS:
        raise ProtocolError(f"`action` must be one of {', '.join(ACTIONS)}")
    return Control(str(message["action"]))


def _ack(message: dict[str, Any]) -> Ack:
    sequence = message["sequence"]
    if isinstance(sequence, bool) or not isinstance(sequence, int) or not 0 <= sequence < 2**32:
        raise ProtocolError("`sequence` must be an unsigned 32-bit integer")
    return Ack(sequence)


_READERS: dict[object, tuple[Any, set[str]]] = {
    "joints": (_joints, {"positions"}),
    "axes": (_axes, {"axes", "speed", "turn"}),
    "control": (_control, {"action"}),
    "ack": (_ack, {"sequence"}),
}


def write(type: str, **values: Any) -> str:
    """Return a text frame for the browser; NaN and infinities are refused.

    Raises:
        ValueError: a value is not finite.
    """
    return json.dumps({"type": type, **values}, separators=(",", ":"), allow_nan=False)


def pack_sensed(index: int, time: float, kind: int, content: bytes) -> bytes:
    """Pack what a sensor sees for the browser.

    Args:
        index: number of the sensor in the last ``sensors``.
        time: simulated time [s].
        kind: 0 for points, float32 x y z [m] in the world; 1 for a JPEG.
        content: these.
    """
    return POSE_HEADER.pack(SENSED_MARK, kind, index & 0xFFFF, 0, time) + content


def pack_poses(sequence: int, time: float, poses: NDArray[np.float64], *, model: int = 0) -> bytes:
    """Pack poses for the browser.

    Args:
        sequence: counts frames, modulo 2³².
        time: simulated time [s].
        poses: shape (n, 7), position [m] and quaternion x, y, z, w.
        model: number of the model the poses belong to, modulo 256.

    Returns:
        16 bytes of header and n × 7 little-endian float32.
    """
    values = poses.astype("<f4").tobytes()
    return POSE_HEADER.pack(POSE_MARK, model, len(poses) & 0xFFFF, sequence & 0xFFFFFFFF, time) + values
