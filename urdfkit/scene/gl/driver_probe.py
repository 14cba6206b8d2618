"""Whether OpenGL works here, tried in a process of its own: a broken driver may take its process down.

Run as a program, it tries one way to a context after the other, draws a triangle, looks at it and says what worked.
"""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from functools import lru_cache
from importlib.util import find_spec
from typing import Any

from urdfkit.scene.gl import hanging_drivers

SECONDS = 10.0
"""A driver that has not drawn a triangle by then does not work."""

HUNG = "did not draw a triangle"

BACKENDS = ("egl", "")
"""EGL draws without a display; else whatever the platform has."""

ON_PROCESSOR = ("llvmpipe", "softpipe", "swrast", "swiftshader", "software", "basic render", "gdi generic")
"""Parts of the names of drivers that draw on the processor: Mesa's, Google's, Apple's, Windows's."""

_VERTEX = "#version 330\nin vec2 in_at;\nvoid main() { gl_Position = vec4(in_at, 0.0, 1.0); }"
_FRAGMENT = "#version 330\nout vec4 o_color;\nvoid main() { o_color = vec4(0.2, 0.4, 0.8, 1.0); }"


@dataclass(frozen=True)
class Found:
    """What came of trying.

    Attributes:
        works: whether there is a device.
        backend: how it is reached.
        name: of the device; why there is none.
    """

    works: bool
    backend: str
    name: str


@lru_cache(maxsize=1)
def probe() -> Found:
    """Return whether OpenGL works here; tried once per process, and not at all where it hung the last time."""
    if (hung := hanging_drivers.recall()) is not None:
        return Found(False, "", f"{hung}, the last time; --renderer gl tries again")
    return probe_anew()


@lru_cache(maxsize=1)
def probe_anew() -> Found:
    """Return whether OpenGL works here; tried once per process. That it hangs is remembered."""
    if find_spec("moderngl") is None:
        return Found(False, "", "moderngl is not installed: pip install 'urdfkit[gl]'")
    found = ask([sys.executable, "-m", "urdfkit.scene.gl.driver_probe"])
    hanging_drivers.remember(found.name if HUNG in found.name else None)
    return found


def ask(command: list[str], *, seconds: float = SECONDS) -> Found:
    """Return what a program that tries says.

    Args:
        command: the program.
        seconds: how long it may take.
    """
    try:
        done = subprocess.run(command, capture_output=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return Found(False, "", f"the driver {HUNG} in {seconds:g} s")
    except OSError as error:
        return Found(False, "", f"no process could be started ({error.strerror})")
    if done.returncode < 0:
        return Found(False, "", f"the driver crashed (signal {-done.returncode})")
    try:
        said = json.loads(done.stdout.decode().strip().splitlines()[-1])
        return Found(bool(said["works"]), str(said["backend"]), str(said["name"]))
    except (ValueError, KeyError, IndexError, TypeError):
        return Found(False, "", f"the driver was tried without an answer (exit status {done.returncode})")


def on_processor(name: str) -> bool:
    """Whether a device of this name is no graphics card."""
    return any(each in name.lower() for each in ON_PROCESSOR)


def create(backend: str) -> Any:
    """Return a context of moderngl."""
    import moderngl

    options: dict[str, Any] = {"backend": backend} if backend else {}
    return moderngl.create_context(require=330, standalone=True, **options)


def draws(context: Any) -> bool:
    """Whether a triangle over the whole picture comes out in its colour, and its depth is kept."""
    import struct

    program = context.program(_VERTEX, _FRAGMENT)
    corners = context.buffer(struct.pack("6f", -1, -1, 3, -1, -1, 3))
    target = context.framebuffer([context.renderbuffer((8, 8), 4)], context.depth_texture((8, 8)))
    target.use()
    target.clear(0.0, 0.0, 0.0, 1.0)
    context.vertex_array(program, corners, "in_at").render()
    return bool(target.read(components=3) == bytes((51, 102, 204)) * 64)


def main() -> int:
    """Try, and print what came of it as one line of JSON."""
    reasons = []
    for backend in BACKENDS:
        try:
            context = create(backend)
            if draws(context):
                print(json.dumps({"works": True, "backend": backend, "name": str(context.info["GL_RENDERER"])}))
                return 0
            reasons.append("it draws wrong pictures")
        except Exception as error:  # whatever a driver, or what looks for it, raises
            lines = str(error).strip().splitlines()
            reasons.append(lines[0] if lines else type(error).__name__)
    print(json.dumps({"works": False, "backend": "", "name": reasons[0]}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
