"""Test of OpenGL in a separate process, because a broken driver may crash its process.

Run as a program, it tries the backends in turn, draws a triangle, checks the image and prints the result.
"""

import json
import subprocess
import sys
from dataclasses import dataclass
from functools import lru_cache
from importlib.util import find_spec
from typing import Any

from urdfkit.scene.gl import hanging_driver_record

SECONDS = 10.0
"""Time limit for a driver to draw a triangle [s]."""

HUNG = "did not draw a triangle"

BACKENDS = ("egl", "")
"""Backends in the order of the tests: EGL needs no display; then the default of the platform."""

ON_PROCESSOR = ("llvmpipe", "softpipe", "swrast", "swiftshader", "software", "basic render", "gdi generic")
"""Parts of the names of software drivers: Mesa's, Google's, Apple's, Windows's."""

_VERTEX = "#version 330\nin vec2 in_at;\nvoid main() { gl_Position = vec4(in_at, 0.0, 1.0); }"
_FRAGMENT = "#version 330\nout vec4 o_color;\nvoid main() { o_color = vec4(0.2, 0.4, 0.8, 1.0); }"


@dataclass(frozen=True)
class Found:
    """Result of the probe.

    Attributes:
        works: whether OpenGL works.
        backend: backend of the context.
        name: name of the device, or the reason why OpenGL does not work.
    """

    works: bool
    backend: str
    name: str


@lru_cache(maxsize=1)
def probe() -> Found:
    """Test OpenGL once per process; skip the test if the driver hung the last time."""
    if (hung := hanging_driver_record.recall()) is not None:
        return Found(False, "", f"{hung} in the last test; --renderer gl repeats the test")
    return probe_again()


@lru_cache(maxsize=1)
def probe_again() -> Found:
    """Test OpenGL once per process, even if the driver hung the last time; store whether it hangs."""
    if find_spec("moderngl") is None:
        return Found(False, "", "moderngl is not installed: pip install 'urdfkit[gl]'")
    found = run_probe([sys.executable, "-m", "urdfkit.scene.gl.driver_probe"])
    hanging_driver_record.remember(found.name if HUNG in found.name else None)
    return found


def run_probe(command: list[str], *, seconds: float = SECONDS) -> Found:
    """Run the probe program and return its result.

    Args:
        command: the program.
        seconds: its time limit.
    """
    try:
        done = subprocess.run(command, capture_output=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return Found(False, "", f"the driver {HUNG} in {seconds:g} s")
    except OSError as error:
        return Found(False, "", f"cannot start a process ({error.strerror})")
    if done.returncode < 0:
        return Found(False, "", f"the driver crashed (signal {-done.returncode})")
    try:
        result = json.loads(done.stdout.decode().strip().splitlines()[-1])
        return Found(bool(result["works"]), str(result["backend"]), str(result["name"]))
    except (ValueError, KeyError, IndexError, TypeError):
        return Found(False, "", f"the driver test printed no result (exit status {done.returncode})")


def on_processor(name: str) -> bool:
    """Whether a device is a software driver, by its name."""
    return any(each in name.lower() for each in ON_PROCESSOR)


def create(backend: str) -> Any:
    """Return a context of moderngl."""
    import moderngl

    options: dict[str, Any] = {"backend": backend} if backend else {}
    return moderngl.create_context(require=330, standalone=True, **options)


def draws(context: Any) -> bool:
    """Whether a triangle that covers the image is drawn with its colour and depth."""
    import struct

    program = context.program(_VERTEX, _FRAGMENT)
    corners = context.buffer(struct.pack("6f", -1, -1, 3, -1, -1, 3))
    target = context.framebuffer([context.renderbuffer((8, 8), 4)], context.depth_texture((8, 8)))
    target.use()
    target.clear(0.0, 0.0, 0.0, 1.0)
    context.vertex_array(program, corners, "in_at").render()
    return bool(target.read(components=3) == bytes((51, 102, 204)) * 64)


def main() -> int:
    """Run the probe and print its result as one line of JSON."""
    reasons = []
    for backend in BACKENDS:
        try:
            context = create(backend)
            if draws(context):
                print(json.dumps({"works": True, "backend": backend, "name": str(context.info["GL_RENDERER"])}))
                return 0
            reasons.append("it draws incorrect images")
        except Exception as error:  # any error of a driver or its loader
            lines = str(error).strip().splitlines()
            reasons.append(lines[0] if lines else type(error).__name__)
    print(json.dumps({"works": False, "backend": "", "name": reasons[0]}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
