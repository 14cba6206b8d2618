"""Poses of the command line and of files."""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path

from urdfkit.errors import ResourceError, UsageError
from urdfkit.missing_files import missing_path

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.linear_algebra import Array


UNIT = 0.01
"""Difference of a quaternion's length from 1 beyond which it is taken for a mistake, not for rounded numbers."""


IK = "ik: --targets"
MAGIC = {".npy": b"\x93NUMPY", ".npz": b"PK"}
"""File type → the first bytes of its files (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html)."""
TURN = 2.0 * math.pi


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
        rpy = numbers(arguments.rpy, 3, "--rpy")
        if abs(largest := max(rpy, key=abs)) > TURN:
            message = f"urdfkit: warning: --rpy {arguments.rpy}: {largest:g} rad is more than one full turn; "
            message += f"if it is in degrees, use {','.join(f'{math.radians(angle):.6g}' for angle in rpy)}"
            print(message, file=sys.stderr)
        return [*xyz, *quaternion_of(rpy)]
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


def poses_of_file(path: Path, option: str = IK, *, position_only: bool = False) -> Array:
    """Return the poses of a file, named by an option; shape (N, 7) or (N, 4, 4).

    Args:
        path: the file.
        option: the option, for messages.
        position_only: accept rows of x y z too, to which the orientation of the base is added.

    Raises:
        ResourceError: the file cannot be read.
        UsageError: the file has no poses.
    """
    import numpy as np

    suffix = path.suffix.lower()
    if suffix not in (".npy", ".npz", ".csv"):
        raise UsageError(f"{option} {path}: unsupported file type; use .npy, .npz or .csv")
    try:
        poses = _poses_of_csv(path, option, position_only) if suffix == ".csv" else _array_of(path, option)
    except FileNotFoundError as error:
        raise ResourceError(f"{option}: {missing_path(path)}") from error
    except OSError as error:
        raise ResourceError(f"{option} {path}: {error.strerror or error}") from error
    except (ValueError, EOFError) as error:
        raise UsageError(f"{option} {path}: not readable as {suffix}: {error}") from error
    if position_only and poses.shape[1:] == (3,):
        poses = np.hstack([poses, np.tile([0.0, 0.0, 0.0, 1.0], (len(poses), 1))])
    if poses.dtype.kind not in "fiu" or (poses.shape[1:] not in ((7,), (4, 4))):
        hint = "; use --position-only for positions" if option == IK and poses.shape[1:] == (3,) else ""
        raise UsageError(f"{option} {path}: expected an array of shape (N, 7) or (N, 4, 4), got {poses.shape}{hint}")
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


def _array_of(path: Path, option: str) -> Array:
    """Read the array of a .npy or .npz file.

    Raises:
        OSError: the file cannot be read.
        ValueError: it is damaged.
        UsageError: it is a file of another type, or has no array of numbers.
    """
    import numpy as np

    suffix = path.suffix.lower()
    with path.open("rb") as file:
        start = file.read(16)
        if not start.startswith(MAGIC[suffix]):
            raise UsageError(f"{option} {path}: {_other_file(start, suffix)}")
        file.seek(0)
        try:
            loaded = np.load(file, allow_pickle=False)
            return _array_named_targets(f"{option} {path}", loaded) if suffix == ".npz" else loaded
        except ValueError as error:
            if "llow_pickle" in str(error):
                raise UsageError(f"{option} {path}: the array has Python objects, not numbers") from None
            raise


def _other_file(start: bytes, suffix: str) -> str:
    """Return the defect of a file whose first bytes are not those of its type, and what to do."""
    if not start:
        return "the file is empty"
    if other := next((kind for kind, magic in MAGIC.items() if start.startswith(magic)), None):
        return f"the file is a {other} file; rename it to {other}"
    line = next(iter(start.decode("utf-8", "replace").split("\n")), "").strip()
    found = f"; it starts with `{line}`" if line and line.isprintable() and "\ufffd" not in line else ""
    made = "numpy.save" if suffix == ".npy" else "numpy.savez"
    return f"not an array written by {made}{found}; rename a file of comma-separated numbers to .csv"


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


def _poses_of_csv(path: Path, option: str, position_only: bool) -> Array:
    """Read rows of numbers; the first line may be a header."""
    import csv

    import numpy as np

    with path.open(encoding="utf-8", newline="") as file:
        rows = [(number, row) for number, row in enumerate(csv.reader(file), 1) if any(cell.strip() for cell in row)]
    found: list[list[float]] = []
    for number, row in rows:
        try:
            values = [float(cell) for cell in row]
        except ValueError:
            if number > 1 or any(map(_is_number, row)):
                raise UsageError(f"{option} {path}:{number}: `{','.join(row)}` are not numbers") from None
            continue
        expected = {len(found[0])} if found else {7, 3} if position_only else {7}
        if len(values) not in expected:
            wanted = "7 numbers x,y,z,qx,qy,qz,qw" + (" or 3 numbers x,y,z" if position_only else "")
            wanted = f"{len(found[0])} numbers as before" if found and position_only else wanted
            hint = "; use --position-only for positions" if option == IK and len(values) == 3 and not found else ""
            raise UsageError(f"{option} {path}:{number}: expected {wanted}, got {len(values)}{hint}")
        found.append(values)
    return np.array(found, dtype=float).reshape(len(found), len(found[0]) if found else 7)
