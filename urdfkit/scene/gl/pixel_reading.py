"""Read the pixels of a framebuffer while other threads of Python run.

A driver that draws on the processor draws when pixels are read, which takes tens of milliseconds; moderngl keeps the
lock of Python meanwhile. A function called by ctypes does not.
"""

import ctypes
import sys
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

LIBRARIES = {"win32": "opengl32", "darwin": "/System/Library/Frameworks/OpenGL.framework/OpenGL"}
LINUX = "libGL.so.1"
PACK_ALIGNMENT, RED, RGB, UNSIGNED_BYTE, FLOAT = 0x0D05, 0x1903, 0x1907, 0x1401, 0x1406
"""Constants of OpenGL, see https://registry.khronos.org/OpenGL/api/GL/glcorearb.h."""


def read_pixels(framebuffer: Any, out: NDArray[Any]) -> None:
    """Read the first colour attachment of a framebuffer of the current context, which is used afterwards.

    Args:
        framebuffer: of moderngl.
        out: bytes of red, green and blue; shape (height, width, 3); or one float32 per pixel; shape (height, width).
    """
    read = _read_function()
    if read is None:
        framebuffer.read_into(out, components=3 if out.ndim == 3 else 1, alignment=1, dtype=out.dtype.str[1:])
        return
    framebuffer.use()
    format, kind = (RGB, UNSIGNED_BYTE) if out.dtype == np.uint8 else (RED, FLOAT)
    read(0, 0, out.shape[1], out.shape[0], format, kind, out.ctypes.data)


@cache
def _read_function() -> Any:
    """Return ``glReadPixels`` for rows without gaps; None if the library is not found under its usual name."""
    try:
        library = ctypes.CDLL(LIBRARIES.get(sys.platform, LINUX))
        read, store = library.glReadPixels, library.glPixelStorei
    except (AttributeError, OSError):
        return None
    read.restype = store.restype = None
    read.argtypes = [ctypes.c_int] * 4 + [ctypes.c_uint] * 2 + [ctypes.c_void_p]
    store.argtypes = [ctypes.c_uint, ctypes.c_int]

    def read_rows(*arguments: Any) -> None:
        store(PACK_ALIGNMENT, 1)
        read(*arguments)

    return read_rows
