"""``sim run --save-scan``: write the last scan or point cloud of a topic as JSON or CSV."""

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from urdfkit.app.simulation import save_options
from urdfkit.app.simulation.save_options import TopicFile
from urdfkit.errors import UsageError
from urdfkit.sim.simulator import Simulator

SCAN = "sensor_msgs/msg/LaserScan"
CLOUD = "sensor_msgs/msg/PointCloud2"


def find_topics(simulator: Simulator, wanted: Sequence[TopicFile]) -> list[tuple[str, Path]]:
    """Return topic and file of each ``--save-scan``; the default topic is the only scan, else the only point cloud.

    Raises:
        UsageError: the topic is unknown or has another type, or the default is ambiguous.
    """
    has_scan = any(topic.type == SCAN for topic in simulator.bus.topics)
    topics = []
    for each in wanted:
        types = (SCAN,) if has_scan and not each.topic else (SCAN, CLOUD)
        topics += save_options.find_topics(
            simulator, [each], option="--save-scan", types=types, what="scans", suffix=".json"
        )
    return topics


def contents(simulator: Simulator, wanted: Sequence[tuple[str, Path]]) -> Iterator[tuple[Path, bytes]]:
    """Yield each file and its content, the last scan of its topic; numbers that are not finite are null in JSON.

    Raises:
        UsageError: no scan has been published.
    """
    for topic, file in wanted:
        message = simulator.bus.latest(topic)
        if message is None:
            raise UsageError(f"--save-scan: no scan was published on {topic} in {simulator.t:g} s; increase --for")
        numbers, columns = _scan(message) if hasattr(message, "ranges") else _cloud(message)
        stamp = message.header.stamp
        time = stamp.sec + 1e-9 * stamp.nanosec
        about = {"topic": topic, "frame": message.header.frame_id, "time": time, **numbers}
        text = _table(columns) if file.suffix.lower() == ".csv" else _json(about, columns)
        yield file, text.encode()


def _scan(message: Any) -> tuple[dict[str, float], dict[str, Any]]:
    """Return the header fields of a LaserScan, and its columns."""
    import numpy as np

    names = ("angle_min", "angle_max", "angle_increment", "range_min", "range_max")
    angles = message.angle_min + message.angle_increment * np.arange(len(message.ranges))
    about = {name: float(getattr(message, name)) for name in names}
    return about, {"angles": angles, "ranges": message.ranges, "intensities": message.intensities}


def _cloud(message: Any) -> tuple[dict[str, float], dict[str, Any]]:
    """Return the size of a PointCloud2, and its columns."""
    from urdfkit.messages.point_cloud import read_points

    rows = read_points(message)
    columns: dict[str, Any] = {}
    for name in rows.dtype.names or ():
        if name in ("rgb", "rgba") and rows[name].dtype.itemsize == 4:
            columns |= _colors(rows[name], name)
        else:
            columns[name] = rows[name]
    return {"width": message.width, "height": message.height}, columns


def _colors(packed: Any, names: str) -> dict[str, Any]:
    """Return a column of 0 to 255 for each colour of PCL's packed 32-bit colours."""
    from urdfkit.messages.point_cloud import colors_of

    return {name: column for name, column in zip("rgba", colors_of(packed).T, strict=True) if name in names}


def _json(about: Mapping[str, Any], columns: Mapping[str, Any]) -> str:
    def finite(value: Any) -> Any:
        return value if not isinstance(value, float) or abs(value) < float("inf") else None

    numbers = {name: [finite(each) for each in _plain(values)] for name, values in columns.items()}
    return json.dumps({**{name: finite(value) for name, value in about.items()}, **numbers}) + "\n"


def _table(columns: Mapping[str, Any]) -> str:
    """Return comma-separated values with a header line."""
    rows = zip(*(_plain(values) for values in columns.values()), strict=True)
    lines = [",".join(name.removesuffix("s") if name != "intensities" else "intensity" for name in columns)]
    return "\n".join([*lines, *(",".join(map(repr, row)) for row in rows)]) + "\n"


def _plain(values: Any) -> list[float]:
    """Return numbers as floats; 32-bit numbers with their shortest decimal representation."""
    import numpy as np

    numbers: list[float] = values.tolist()
    if values.dtype == np.float32:
        numbers = [float(str(each)) for each in values]
    return numbers
