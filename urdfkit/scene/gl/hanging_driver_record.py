"""Record of drivers that hang, in the user's cache folder, because repeating the test would take as long.

It is believed for a day, while the libraries, the devices and the variables that choose a driver stay as they were.
"""

import hashlib
import os
import platform
import sys
import time
from importlib.util import find_spec
from pathlib import Path

from urdfkit.atomic import write_text
from urdfkit.errors import ResourceError

BELIEVED = 86_400.0
"""Seconds."""

PLACES = (
    "usr/lib*/lib*GL*.so*",
    "usr/lib*/*/lib*GL*.so*",
    "usr/lib*/*/lib*gallium*.so*",
    "usr/lib*/dri/*",
    "usr/lib*/*/dri/*",
    "usr/share/glvnd/egl_vendor.d/*",
    "etc/glvnd/egl_vendor.d/*",
    "dev/dri/*",
    "dev/nvidia*",
    "proc/driver/nvidia/version",
)
"""Folders of drivers and devices, relative to the root."""

VARIABLES = (
    "LD_LIBRARY_PATH", "LD_PRELOAD", "DISPLAY", "WAYLAND_DISPLAY", "XDG_SESSION_TYPE", "DRI_PRIME",
    "CUDA_VISIBLE_DEVICES",
)  # fmt: skip
BEGINNINGS = ("LIBGL_", "MESA_", "GALLIUM_", "EGL_", "__EGL_", "__GLX_", "__GL_", "NVIDIA_", "GLCONTEXT_")
"""Environment variables that select a driver."""


def folder() -> Path:
    """Return the file of the record."""
    from urdfkit.scene.rays.bvh_cache import cache_folder

    return cache_folder() / "drivers"


def recall() -> str | None:
    """Return the recorded hang; None if it is missing or too old, or the drivers have changed."""
    try:
        path = _place()
        if not 0.0 <= time.time() - path.stat().st_mtime < BELIEVED:
            return None
        return path.read_text(encoding="utf-8").strip() or None
    except (OSError, UnicodeDecodeError, RuntimeError):
        return None


def remember(hung: str | None) -> None:
    """Record a hang, or delete the record; do nothing if the folder is not writable."""
    try:
        path = _place()
        if hung is None:
            path.unlink(missing_ok=True)
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_text(path, f"{hung}\n")
    except (OSError, ResourceError, RuntimeError):  # RuntimeError: the home folder is unknown
        return


def _place() -> Path:
    digest = hashlib.sha256(repr(_around()).encode()).hexdigest()
    return folder() / f"{digest[:24]}.txt"


def _around() -> tuple[object, ...]:
    """Return a digest of the files and variables that the driver depends on."""
    chosen = sorted(
        (name, value) for name, value in os.environ.items() if name in VARIABLES or name.startswith(BEGINNINGS)
    )
    files = [(str(path), _stamp(path)) for place in PLACES for path in sorted(Path("/").glob(place))]
    spec = find_spec("moderngl")
    drawn_by = (sys.executable, spec and spec.origin, _version("moderngl"), _version("glcontext"))
    return *drawn_by, platform.uname(), chosen, files


def _stamp(path: Path) -> tuple[int, int]:
    """Return size and time of a file; without the times of devices, which change with use."""
    try:
        status = path.stat()
    except OSError:
        return 0, 0
    return (0, 0) if path.parts[1] in ("dev", "proc") else (status.st_size, status.st_mtime_ns)


def _version(package: str) -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(package)
    except PackageNotFoundError:
        return ""
