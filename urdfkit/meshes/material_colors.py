"""Colours of materials as trimesh reads them: factors of textures, opacity, and conversion between linear and sRGB."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray


def factor_of(material: Any) -> NDArray[np.float64] | None:
    """Return the colour and opacity that multiply a texture, 0..1, shape (4,); None without any."""
    factor = getattr(material, "baseColorFactor", None)
    if factor is None and (written := getattr(material, "kwargs", None)) and "kd" in written:
        factor = [*written["kd"][:3], obj_opacity(written)]
    if factor is None:
        return None
    scale = np.ravel(np.asarray(factor, dtype=float)) / (255.0 if np.asarray(factor).dtype.kind in "ui" else 1.0)
    return np.clip(np.append(scale, 1.0)[:4], 0.0, 1.0) if len(scale) in (3, 4) else None


def srgb_bytes(color: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Return linear colours, 0..1, as sRGB bytes; a fourth channel is opacity (IEC 61966-2-1)."""
    encoded = np.where(color <= 0.0031308, 12.92 * color, 1.055 * np.maximum(color, 1e-9) ** (1 / 2.4) - 0.055)
    encoded[..., 3:] = color[..., 3:]
    return to_bytes(encoded)


def linear_of(color: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return sRGB colours, 0..1, as linear colours (IEC 61966-2-1)."""
    found: NDArray[np.float64] = np.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4)
    return found


def to_bytes(values: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Return values of 0..1 as bytes."""
    return np.rint(255.0 * np.clip(values, 0.0, 1.0)).astype(np.uint8)


def obj_opacity(written: Mapping[str, Any]) -> float:
    """Return the opacity of a material of an OBJ file: ``d``, else 1 - ``Tr``.

    An opacity of zero counts as one: no robot has invisible parts, and some programs write the transparency as ``d``.
    """
    for name, sign in (("d", 1.0), ("tr", -1.0)):
        try:
            number = float(np.ravel(written[name])[-1])
        except (KeyError, IndexError, ValueError):
            continue
        opacity = number if sign > 0 else 1.0 - number
        return opacity if 0.0 < opacity < 1.0 else 1.0
    return 1.0
