"""What a change of the simulator leaves behind: files that were added or edited, and speak to the other Gazebo."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from pathlib import Path

_OF_CLASSIC = re.compile(r"\blib(?:gazebo|hector_gazebo|velodyne_gazebo)_\w+\.so\b")
_OF_GZ = re.compile(r"\b(?:gz::sim|ignition::gazebo)::|\b(?:gz|ignition)-(?:sim|gazebo)-")
_BRIDGED = re.compile(r"(?m)^\s*-?\s*(?:gz|ign)_topic_name\s*:")
_SENSOR = re.compile(r"<sensor\b")
_MODELS = (".xacro", ".urdf")
_TOO_LARGE = 2**20


def left_behind(folder: Path, tops: Collection[str], simulator: str) -> Iterator[str]:
    """Yield the files of packages that say nothing to a simulator, and why, a line each.

    Args:
        folder: of the packages.
        tops: the packages' folders.
        simulator: the one that is used now, `gz` or `classic`.
    """
    for path in sorted(path for top in tops for path in (folder / top).rglob("*")):
        if path.suffix not in (*_MODELS, ".yaml") or not path.is_file() or path.stat().st_size > _TOO_LARGE:
            continue
        why = _wrong(path.read_text("utf-8", "replace"), path.suffix in _MODELS, simulator)
        if why:
            yield f"{path.relative_to(folder).as_posix()} stays, {why}"


def _wrong(text: str, is_model: bool, simulator: str) -> str:
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    classic = _OF_CLASSIC.search(text) is not None
    if simulator == "gz":
        return "and its plugins are of Gazebo Classic: the new Gazebo passes over them" if is_model and classic else ""
    if simulator != "classic":
        return ""
    if not is_model:
        return "and nothing reads it: in Gazebo Classic there is no bridge" if _BRIDGED.search(text) else ""
    if _OF_GZ.search(text):
        return "and its plugins are of the new Gazebo: Gazebo Classic has none of them"
    if _SENSOR.search(text) and not classic:
        return "and its sensor publishes nothing in Gazebo Classic, for want of a plugin: `new sensor` writes it anew"
    return ""
