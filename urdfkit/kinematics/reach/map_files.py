"""Files of reach maps: arrays (.npz), JSON, and coloured points (.ply)."""

import io
import json
from pathlib import Path

import numpy as np

from urdfkit.atomic import write_bytes
from urdfkit.errors import UsageError, did_you_mean
from urdfkit.kinematics.reach.reach_map import ReachMap
from urdfkit.linear_algebra import Array

FILES = (".npz", ".json", ".ply")
COLOURS = np.array([(68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37)], dtype=float)
"""Colours of the scores 0, ¼, ½, ¾ and 1: five of the colour map viridis."""


def check_file(path: Path) -> None:
    """Check the type of a file.

    Raises:
        UsageError: it is not supported.
    """
    if path.suffix.lower() not in FILES:
        hint = did_you_mean(path.suffix, FILES)
        raise UsageError(f"{path}: unsupported file type; use {', '.join(FILES)}{hint}")


def write_map(path: Path, found: ReachMap) -> None:
    """Write a reach map.

    Raises:
        UsageError: the type of the file is not supported.
        ResourceError: the file cannot be written.
    """
    check_file(path)
    content = {".npz": _npz, ".json": _json, ".ply": _ply}[path.suffix.lower()](found)
    write_bytes(path, content)


def colours(scores: Array) -> Array:
    """Return red, green and blue from 0 to 255 for scores from 0 to 1; shape (K, 3)."""
    ends = np.linspace(0.0, 1.0, len(COLOURS))
    return np.asarray(np.stack([np.interp(scores, ends, channel) for channel in COLOURS.T], axis=-1).round())


def _npz(found: ReachMap) -> bytes:
    content = io.BytesIO()
    np.savez_compressed(
        content,
        base=found.base,
        tip=found.tip,
        origin=found.origin,
        resolution=found.resolution,
        orientations=found.orientations,
        score=found.score,
        manipulability=found.manipulability,
    )
    return content.getvalue()


def _json(found: ReachMap) -> bytes:
    values = {
        "base": found.base,
        "tip": found.tip,
        "origin": found.origin.tolist(),
        "resolution": found.resolution,
        "shape": list(found.score.shape),
        "orientations": found.orientations.tolist(),
        "score": found.score.tolist(),
        "manipulability": found.manipulability.tolist(),
    }
    return (json.dumps(values) + "\n").encode()


def _ply(found: ReachMap) -> bytes:
    """Return the centres of the cells that are reached as coloured points, by score."""
    cells = found.score > 0.0
    kinds = [("x", "f4"), ("y", "f4"), ("z", "f4"), ("red", "u1"), ("green", "u1"), ("blue", "u1")]
    names = {"f4": "float", "u1": "uchar"}
    kinds += [("score", "f4"), ("manipulability", "f4")]
    points = np.zeros(int(cells.sum()), dtype=[(name, f"<{kind}" if kind == "f4" else kind) for name, kind in kinds])
    points["x"], points["y"], points["z"] = found.centres()[cells].T
    points["red"], points["green"], points["blue"] = colours(found.score[cells]).T
    points["score"], points["manipulability"] = found.score[cells], found.manipulability[cells]
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}"]
    lines += [f"property {names[kind]} {name}" for name, kind in kinds]
    return ("\n".join([*lines, "end_header"]) + "\n").encode() + points.tobytes()
