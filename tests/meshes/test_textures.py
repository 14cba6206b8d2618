"""Images that are invalid or too large, and names of images that no file can have."""

import struct
import zlib
from pathlib import Path

import pytest

from urdfkit.meshes.loader import MeshLoader
from urdfkit.meshes.textures import SideFiles, read_texture


def chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def png(width: int, height: int, *chunks: bytes) -> bytes:
    return (
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) + b"".join(chunks)
    )


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"no image",
        png(2**20, 1),
        png(2**17, 2**17),  # Pillow raises DecompressionBombError
        png(8, 8, chunk(b"IDAT", b"x")),
        png(8, 8, chunk(b"IDAT", zlib.compress(bytes(50))), b"\0\0\0\1\0I\0\0" + bytes(8)),  # Pillow raises SyntaxError
    ],
)
def test_an_invalid_image_is_one_documented_error(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(content)
    with pytest.raises((OSError, ValueError)):
        read_texture(path)


@pytest.mark.parametrize("name", ["a\0.png", "a\0.mtl", "x" * 300 + ".png", "x" * 300 + ".mtl"])
def test_a_name_that_no_file_has_is_missing(tmp_path: Path, name: str) -> None:
    with pytest.raises(KeyError):
        SideFiles(tmp_path / "a.obj", 100)[name]
    path = tmp_path / "a.obj"
    path.write_text(f"mtllib {name}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert len(MeshLoader().load(path).faces) == 1
