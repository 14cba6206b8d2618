"""What travels on the websocket, and the checks on every value that comes in; docs/protocol.md tells it in full.

Version 2. Text frames are JSON objects with a ``type``; binary frames whose first byte is 0x01 are packed poses, 0x02
what a sensor sees, 0x03 a file to keep; other binary frames are meshcat commands (msgpack maps, whose first byte is
none of these).

Browser → Python: ``joints`` {positions: {name: value}}, ``axes`` {axes: [x, y, z, turn] each -1..1, speed, turn, and
which robot}, ``control`` {action}, ``ack`` {sequence}, ``seen`` {key, sequence}, ``watch`` {wanted: [key]}, ``do``
{number, order, values}.

Python → browser: ``hello``, ``you``, ``model``, ``status``, ``fault``, ``progress``, ``joints``, ``sensors``,
``stop``, ``answer``, and what the mode adds.
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

VERSION = 2
MAX_INBOUND = 64 * 1024
"""Longest frame accepted from a browser [byte]."""
MAX_JOINTS = 2000
MAX_MAGNITUDE = 1e6
"""Largest joint position accepted [rad or m]."""
MAX_SPEED = 1000.0
"""Largest speed accepted [m/s, rad/s]; the default limit of teleop_twist_keyboard."""
MAX_NAME = 200
"""Longest name of an order, a robot or a key [characters]."""
MAX_WANTED = 64
"""Most keys one page may want."""
ACTIONS = ("play", "pause", "reset", "stop")

POSE_HEADER = struct.Struct("<BBHId")
"""0x01, number of the model modulo 256, number of objects, sequence, time [s]: 16 bytes."""
POSE_MARK = 0x01
SENSED_MARK = 0x02
"""As `POSE_HEADER`: mark, kind, number of the source, sequence, time [s]; then the content."""
POINTS, PICTURE, ARROWS, COLORED = 0, 1, 2, 3
"""Kinds of what is sensed: float32 x y z [m] in the world; a JPEG or WebP; float32 x y z [m] and a vector, six each;
float32 x y z [m] and red, green, blue and 255, a byte each."""
FILE_MARK = 0x03
"""As `POSE_HEADER`: mark, 0, length of the name, 0, 0; then the name in UTF-8 and the content."""


class ProtocolError(Exception):
    """A frame from a browser that is dropped; the text says why."""


@dataclass(frozen=True, slots=True)
class Joints:
    """Joint positions set by hand [rad or m]."""

    positions: dict[str, float]


@dataclass(frozen=True, slots=True)
class Axes:
    """What a driver holds: `axes` (x, y, z, turn) in -1..1, `speed` [m/s] and `turn` [rad/s] to scale them with.

    `robot` is the one driven; the first where it is empty.
    """

    axes: tuple[float, float, float, float]
    speed: float
    turn: float
    robot: str = ""

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


@dataclass(frozen=True, slots=True)
class Seen:
    """The browser has shown a frame of a source, and can take another."""

    key: str
    sequence: int


@dataclass(frozen=True, slots=True)
class Watch:
    """What the browser wants to be sent beside what everybody gets, all of it."""

    wanted: frozenset[str]


@dataclass(frozen=True, slots=True)
class Do:
    """Something to be done and answered. The values are not yet checked: what they may be depends on the order."""

    number: int
    order: str
    values: dict[str, Any]


Message = Joints | Axes | Control | Ack | Seen | Watch | Do


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
        reader, keys, optional = _READERS[kind]
    except (KeyError, TypeError):
        raise ProtocolError("unknown type") from None
    if not keys <= message.keys() <= keys | optional:
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
    return Axes((x, y, z, turn), speed, rate, _name(message.get("robot", "")))


def _control(message: dict[str, Any]) -> Control:
    if message["action"] not in ACTIONS:
        raise ProtocolError(f"`action` must be one of {', '.join(ACTIONS)}")
    return Control(str(message["action"]))


def _ack(message: dict[str, Any]) -> Ack:
    return Ack(_sequence(message["sequence"]))


def _seen(message: dict[str, Any]) -> Seen:
    return Seen(_name(message["key"]), _sequence(message["sequence"]))


def _watch(message: dict[str, Any]) -> Watch:
    wanted = message["wanted"]
    if not isinstance(wanted, list) or len(wanted) > MAX_WANTED:
        raise ProtocolError(f"`wanted` must be a list of at most {MAX_WANTED} keys")
    return Watch(frozenset(_name(key) for key in wanted))


def _do(message: dict[str, Any]) -> Do:
    values = message["values"]
    if not isinstance(values, dict):
        raise ProtocolError("`values` must be an object")
    return Do(_sequence(message["number"]), _name(message["order"]), values)


def _sequence(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 2**32:
        raise ProtocolError("`sequence` and `number` must be unsigned 32-bit integers")
    return value


def _name(value: Any) -> str:
    if not isinstance(value, str) or len(value) > MAX_NAME:
        raise ProtocolError(f"a name must be a text of at most {MAX_NAME} characters")
    return value


_READERS: dict[object, tuple[Any, set[str], set[str]]] = {
    "joints": (_joints, {"positions"}, set()),
    "axes": (_axes, {"axes", "speed", "turn"}, {"robot"}),
    "control": (_control, {"action"}, set()),
    "ack": (_ack, {"sequence"}, set()),
    "seen": (_seen, {"key", "sequence"}, set()),
    "watch": (_watch, {"wanted"}, set()),
    "do": (_do, {"number", "order", "values"}, set()),
}


def write(type: str, **values: Any) -> str:
    """Return a text frame for the browser; NaN and infinities are refused.

    Raises:
        ValueError: a value is not finite.
    """
    return json.dumps({"type": type, **values}, separators=(",", ":"), allow_nan=False)


def pack_sensed(index: int, time: float, kind: int, content: bytes, sequence: int = 0) -> bytes:
    """Pack what a sensor sees for the browser.

    Args:
        index: number of the source in the last ``sensors``, modulo 2¹⁶.
        time: simulated time [s].
        kind: `POINTS`, `PICTURE`, `ARROWS` or `COLORED`.
        content: these.
        sequence: counts frames, modulo 2³².
    """
    return POSE_HEADER.pack(SENSED_MARK, kind, index & 0xFFFF, sequence & 0xFFFFFFFF, time) + content


def pack_file(name: str, content: bytes) -> bytes:
    """Pack a file that the browser is to keep."""
    encoded = name.encode()[:0xFFFF]
    return POSE_HEADER.pack(FILE_MARK, 0, len(encoded), 0, 0.0) + encoded + content


def pack_poses(sequence: int, time: float, poses: NDArray[np.floating[Any]], *, model: int = 0) -> bytes:
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
