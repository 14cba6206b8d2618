"""Read robots and worlds: the parsers, without kinematics or dynamics.

Input: xacro, URDF and SDF; output: links, joints and models with source positions.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.loading import expand as expand
    from urdfkit.description.loading import load as load
    from urdfkit.description.urdf.robot import Robot as Robot

__all__ = ["Robot", "expand", "load"]


def __getattr__(name: str) -> Any:
    if name == "Robot":
        from urdfkit.description.urdf.robot import Robot

        return Robot
    if name in ("expand", "load"):
        from urdfkit.description import loading

        return getattr(loading, name)
    raise AttributeError(f"module 'urdfkit.description' has no attribute {name!r}")
