"""``sim run --save-scan``: the last scan or cloud of a topic, as JSON or as a table."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfkit.app.simulation import saved_topics
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from urdfkit.app.simulation.saved_topics import TopicFile
    from urdfkit.sim.simulator import Simulator

SCAN = "sensor_msgs/msg/LaserScan"
CLOUD = "sensor_msgs/msg/PointCloud2"


def find_topics(simulator: Simulator, wanted: Sequence[TopicFile]) -> list[tuple[str, Path]]:
    """Return the topic and the file of each ``--save-scan``; without a topic it is a scan, a cloud where there is none.

    Raises:
        UsageError: there is no such topic, it carries no scans, or none is named and there are several.
    """
    has_scan = any(topic.type == SCAN for topic in simulator.bus.topics)
    found = []
    for each in wanted:
        types = (SCAN,) if has_scan and not each.topic else (SCAN, CLOUD)
        found += saved_topics.find_topics(
            simulator, [each], option="--save-scan", types=types, what="scans", suffix=".json"
        )
    return found


def contents(simulator: Simulator, wanted: Sequence[tuple[str, Path]]) -> Iterator[tuple[Path, bytes]]:
    """Yield each file and what is to be in it, the last scan of its topic; what is not finite is null in JSON.

    Raises:
        UsageError: none has been taken so far.
    """
    for topic, file in wanted:
        message = simulator.bus.latest(topic)
        if message is None:
            raise UsageError(f"--save-scan: no scan came on {topic} in {simulator.t:g} s; run for longer")
        numbers, columns = _scan(message) if hasattr(message, "ranges") else _cloud(message)
        stamp = message.header.stamp
        time = stamp.sec + 1e-9 * stamp.nanosec
        about = {"topic": topic, "frame": message.header.frame_id, "time": time, **numbers}
        text = _table(columns) if file.suffix.lower() == ".csv" else _json(about, columns)
        yield file, text.encode()


def _scan(message: Any) -> tuple[dict[str, float], dict[str, Any]]:
    """Return what a LaserScan is, and its columns."""
    import numpy as np

    names = ("angle_min", "angle_max", "angle_increment", "range_min", "range_max")
    angles = message.angle_min + message.angle_increment * np.arange(len(message.ranges))
    about = {name: float(getattr(message, name)) for name in names}
    return about, {"angles": angles, "ranges": message.ranges, "intensities": message.intensities}


def _cloud(message: Any) -> tuple[dict[str, float], dict[str, Any]]:
    """Return what a PointCloud2 is, and its columns."""
    import numpy as np

    kinds = {1: "i1", 2: "u1", 3: "<i2", 4: "<u2", 5: "<i4", 6: "<u4", 7: "<f4", 8: "<f8"}
    row = np.dtype(
        {
            "names": [field.name for field in message.fields],
            "formats": [kinds[field.datatype] for field in message.fields],
            "offsets": [field.offset for field in message.fields],
            "itemsize": message.point_step,
        }
    )
    rows = np.frombuffer(message.data.tobytes(), dtype=row)
    columns: dict[str, Any] = {}
    for name in row.names or ():
        if name in ("rgb", "rgba") and rows[name].dtype.itemsize == 4:
            columns |= _colors(rows[name], name)
        else:
            columns[name] = rows[name]
    return {"width": message.width, "height": message.height}, columns


def _colors(packed: Any, names: str) -> dict[str, Any]:
    """Return a column of 0 to 255 for each of the colours that PCL packs into 32 bits, blue lowest."""
    import numpy as np

    bits = np.ascontiguousarray(packed).view("<u4")
    return {name: (bits >> shift) & 255 for name, shift in zip("rgba", (16, 8, 0, 24), strict=True) if name in names}


def _json(about: Mapping[str, Any], columns: Mapping[str, Any]) -> str:
    def finite(value: Any) -> Any:
        return value if not isinstance(value, float) or abs(value) < float("inf") else None

    numbers = {name: [finite(each) for each in _plain(values)] for name, values in columns.items()}
    return json.dumps({**{name: finite(value) for name, value in about.items()}, **numbers}) + "\n"


def _table(columns: Mapping[str, Any]) -> str:
    """Return comma-separated values with a line of names."""
    rows = zip(*(_plain(values) for values in columns.values()), strict=True)
    lines = [",".join(name.removesuffix("s") if name != "intensities" else "intensity" for name in columns)]
    return "\n".join([*lines, *(",".join(map(repr, row)) for row in rows)]) + "\n"


def _plain(values: Any) -> list[float]:
    """Return numbers of 32 bits by as many digits as they have."""
    import numpy as np

    found: list[float] = values.tolist()
    if values.dtype == np.float32:
        found = [float(str(each)) for each in values]
    return found
