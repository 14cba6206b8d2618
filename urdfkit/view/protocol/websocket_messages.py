"""Messages of the WebSocket and the checks on every received value; docs/protocol.md describes them completely.

Version 3. Text frames are JSON objects with a ``type``. Binary frames whose first byte is 0x01 are packed poses, 0x02
sensor data, 0x03 a file to save; other binary frames are meshcat commands (msgpack maps, whose first byte differs).

Browser → Python: ``joints`` {positions: {name: value}}, ``axes`` {axes: [x, y, z, turn] each -1..1, speed, turn,
robot}, ``control`` {action}, ``ack`` {sequence}, ``seen`` {key, sequence}, ``subscribe`` {keys: [key]}, ``request``
{number, name, values}.

Python → browser: ``hello``, ``you``, ``model``, ``status``, ``fault``, ``progress``, ``joints``, ``sensors``,
``stop``, ``answer``, and the messages of the mode.
"""

import json
import math
import struct
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

VERSION = 3
MAX_INBOUND = 64 * 1024
"""Longest frame accepted from a browser [byte]."""
MAX_JOINTS = 2000
MAX_MAGNITUDE = 1e6
"""Largest joint position accepted [rad or m]."""
MAX_SPEED = 1000.0
"""Largest speed accepted [m/s, rad/s]; the default limit of teleop_twist_keyboard."""
MAX_NAME = 200
"""Longest name of a request, a robot or a key [characters]."""
MAX_KEYS = 64
"""Maximum number of keys that a page may subscribe to."""
_MAX_DIGITS = 300
ACTIONS = ("play", "pause", "reset", "stop")

POSE_HEADER = struct.Struct("<BBHId")
"""0x01, number of the model modulo 256, number of objects, sequence, time [s]: 16 bytes."""
POSE_MARK = 0x01
SENSED_MARK = 0x02
"""Header as `POSE_HEADER`: mark, kind, number of the source, sequence, time [s]; then the content."""
POINTS, PICTURE, ARROWS, COLORED = 0, 1, 2, 3
"""Kinds of sensor data: float32 x y z [m] in the world; a JPEG or WebP; float32 x y z [m] and a vector, six each;
float32 x y z [m] and red, green, blue and 255, a byte each."""
FILE_MARK = 0x03
"""Header as `POSE_HEADER`: mark, 0, length of the name, 0, 0; then the name in UTF-8 and the content."""


class ProtocolError(Exception):
    """A frame from a browser is invalid and is dropped; the text gives the reason."""


@dataclass(frozen=True, slots=True)
class Joints:
    """Joint positions set with the sliders [rad or m]."""

    positions: dict[str, float]


@dataclass(frozen=True, slots=True)
class Axes:
    """Input of the driver: `axes` (x, y, z, turn) in -1..1, scaled by `speed` [m/s] and `turn` [rad/s].

    `robot` is the name of the driven robot; empty for the first one.
    """

    axes: tuple[float, float, float, float]
    speed: float
    turn: float
    robot: str = ""

    @property
    def is_zero(self) -> bool:
        """Whether all axes are zero."""
        return not any(self.axes)


@dataclass(frozen=True, slots=True)
class Control:
    """A pressed button of the page: one of `ACTIONS`."""

    action: str


@dataclass(frozen=True, slots=True)
class Ack:
    """The browser has applied the pose frame with this sequence number."""

    sequence: int


@dataclass(frozen=True, slots=True)
class Seen:
    """The browser has shown a frame of a source and can receive another."""

    key: str
    sequence: int


@dataclass(frozen=True, slots=True)
class Subscribe:
    """All keys that the browser subscribes to; replaces its previous subscriptions."""

    keys: frozenset[str]


@dataclass(frozen=True, slots=True)
class RawRequest:
    """A request that expects an answer. Its values are not yet checked, see `page_requests.check`."""

    number: int
    name: str
    values: dict[str, Any]


Message = Joints | Axes | Control | Ack | Seen | Subscribe | RawRequest


def read(text: str | bytes) -> Message:
    """Read and check one frame from a browser.

    Raises:
        ProtocolError: the frame is not exactly one of the messages above with finite values within the limits.
    """
    if isinstance(text, bytes):
        raise ProtocolError("binary frames are not accepted")
    try:
        message = json.loads(text, parse_int=_integer, parse_constant=_reject)
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
        raise ProtocolError(f"`{kind}` accepts exactly {', '.join(sorted(keys))}")
    checked: Message = reader(message)
    return checked


def _integer(digits: str) -> int | float:
    """Return an integer; infinity if no float can hold it, which the checks of numbers reject."""
    return int(digits) if len(digits) <= _MAX_DIGITS else float(digits)


def _reject(constant: str) -> NoReturn:
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


def _subscribe(message: dict[str, Any]) -> Subscribe:
    keys = message["keys"]
    if not isinstance(keys, list) or len(keys) > MAX_KEYS:
        raise ProtocolError(f"`keys` must be a list of at most {MAX_KEYS} keys")
    return Subscribe(frozenset(_name(key) for key in keys))


def _request(message: dict[str, Any]) -> RawRequest:
    values = message["values"]
    if not isinstance(values, dict):
        raise ProtocolError("`values` must be an object")
    return RawRequest(_sequence(message["number"]), _name(message["name"]), values)


def _sequence(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 2**32:
        raise ProtocolError("`sequence` and `number` must be unsigned 32-bit integers")
    return value


def _name(value: Any) -> str:
    if not isinstance(value, str) or len(value) > MAX_NAME:
        raise ProtocolError(f"a name must be a string of at most {MAX_NAME} characters")
    return value


_READERS: dict[object, tuple[Any, set[str], set[str]]] = {
    "joints": (_joints, {"positions"}, set()),
    "axes": (_axes, {"axes", "speed", "turn"}, {"robot"}),
    "control": (_control, {"action"}, set()),
    "ack": (_ack, {"sequence"}, set()),
    "seen": (_seen, {"key", "sequence"}, set()),
    "subscribe": (_subscribe, {"keys"}, set()),
    "request": (_request, {"number", "name", "values"}, set()),
}


def write(type: str, **values: Any) -> str:
    """Return a text frame for the browser.

    Raises:
        ValueError: a value is NaN or infinite.
    """
    return json.dumps({"type": type, **values}, separators=(",", ":"), allow_nan=False)


def pack_sensed(index: int, time: float, kind: int, content: bytes, sequence: int = 0) -> bytes:
    """Pack sensor data for the browser.

    Args:
        index: number of the source in the last ``sensors``, modulo 2¹⁶.
        time: simulated time [s].
        kind: `POINTS`, `PICTURE`, `ARROWS` or `COLORED`.
        content: the data in the format of the kind.
        sequence: counts frames, modulo 2³².
    """
    return POSE_HEADER.pack(SENSED_MARK, kind, index & 0xFFFF, sequence & 0xFFFFFFFF, time) + content


def pack_file(name: str, content: bytes) -> bytes:
    """Pack a file that the browser saves."""
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
