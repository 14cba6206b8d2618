"""Poses of the command line and of files."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from urdfkit.errors import ResourceError, UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.linear_algebra import Array


UNIT = 0.01
"""Difference of a quaternion's length from 1 beyond which it is taken for a mistake, not for rounded numbers."""


def numbers(text: str, count: int, option: str) -> list[float]:
    """Return the finite numbers of a word, separated by commas.

    Raises:
        UsageError: another number of numbers, or a word that is no finite number.
    """
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != count or not all(map(math.isfinite, values)):
        raise UsageError(f"ik: {option} expects {count} finite numbers separated by commas, got `{text}`")
    return values


def pose_of(arguments: argparse.Namespace) -> list[float] | None:
    """Return the pose of the command line: x y z and quaternion x y z w; None with --targets.

    Raises:
        UsageError: no pose, two, or numbers that are no pose.
    """
    if (arguments.xyz is None) == (arguments.targets is None):
        raise UsageError("ik: pass one of --xyz X,Y,Z and --targets FILE")
    if arguments.quat is not None and arguments.rpy is not None:
        raise UsageError("ik: pass one of --quat and --rpy")
    if arguments.xyz is None:
        if option := "--quat" if arguments.quat is not None else "--rpy" if arguments.rpy is not None else None:
            raise UsageError(f"ik: {option} requires --xyz; poses of a file have their own orientation")
        return None
    xyz = numbers(arguments.xyz, 3, "--xyz")
    if arguments.rpy is not None:
        return [*xyz, *quaternion_of(numbers(arguments.rpy, 3, "--rpy"))]
    quaternion = numbers(arguments.quat, 4, "--quat") if arguments.quat is not None else [0.0, 0.0, 0.0, 1.0]
    length = math.hypot(*quaternion)
    if abs(length - 1.0) > UNIT:
        unit = f", such as {','.join(f'{x / length:.6g}' for x in quaternion)}" if length > 1e-9 else ""
        raise UsageError(
            f"ik: --quat {arguments.quat}: the quaternion has the length {length:.4g}; use one of length 1{unit}"
        )
    return [*xyz, *quaternion]


def quaternion_of(rpy: list[float]) -> list[float]:
    """Return the quaternion x y z w of fixed-axis roll, pitch, yaw [rad]."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(0.5 * angle), math.cos(0.5 * angle)) for angle in rpy)
    return [
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    ]


def poses_of_file(path: Path, option: str = "ik: --targets") -> Array:
    """Return the poses of a file, named by an option; shape (N, 7) or (N, 4, 4).

    Raises:
        ResourceError: the file cannot be read.
        UsageError: the file has no poses.
    """
    import numpy as np

    suffix = path.suffix.lower()
    if suffix not in (".npy", ".npz", ".csv"):
        raise UsageError(f"{option} {path}: unsupported file type; use .npy, .npz or .csv")
    try:
        if suffix == ".csv":
            poses = _poses_of_csv(path)
        else:
            with path.open("rb") as file:
                loaded = np.load(file, allow_pickle=False)
                poses = _array_named_targets(f"{option} {path}", loaded) if suffix == ".npz" else loaded
    except OSError as error:
        raise ResourceError(f"{option} {path}: {error.strerror or error}") from error
    except (ValueError, EOFError) as error:
        raise UsageError(f"{option} {path}: not readable as {suffix}: {error}") from error
    if poses.dtype.kind not in "fiu" or (poses.shape[1:] not in ((7,), (4, 4))):
        raise UsageError(f"{option} {path}: expected an array of shape (N, 7) or (N, 4, 4), got {poses.shape}")
    if not len(poses):
        raise UsageError(f"{option} {path}: the file has no poses")
    poses = np.ascontiguousarray(poses, dtype=float)
    lengths = np.sqrt(np.einsum("ni,ni->n", poses[:, 3:], poses[:, 3:])) if poses.ndim == 2 else np.ones(1)
    if (wrong := np.flatnonzero(np.abs(lengths - 1.0) > UNIT)).size:
        raise UsageError(
            f"{option} {path}: the quaternion of pose {wrong[0]} has the length {lengths[wrong[0]]:.4g}; use one "
            "of length 1"
        )
    return poses


def _array_named_targets(place: str, loaded: object) -> Array:
    names = list(loaded.files)  # type: ignore[attr-defined]
    name = "targets" if "targets" in names or len(names) != 1 else names[0]
    if name not in names:
        raise UsageError(f"{place}: no array `targets`; its arrays: {', '.join(names) or 'none'}")
    return loaded[name]  # type: ignore[index, no-any-return]


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _poses_of_csv(path: Path) -> Array:
    """Read rows of numbers; the first line may be a header."""
    import csv

    import numpy as np

    with path.open(encoding="utf-8", newline="") as file:
        rows = [(number, row) for number, row in enumerate(csv.reader(file), 1) if any(cell.strip() for cell in row)]
    found = []
    for number, row in rows:
        try:
            found.append([float(cell) for cell in row])
        except ValueError:
            if number > 1 or any(map(_is_number, row)):
                raise UsageError(f"ik: {path}:{number}: `{','.join(row)}` are not numbers") from None
            continue
        if len(found[-1]) != 7:
            raise UsageError(f"ik: {path}:{number}: expected 7 numbers x,y,z,qx,qy,qz,qw, got {len(found[-1])}")
    return np.array(found, dtype=float).reshape(len(found), 7)
