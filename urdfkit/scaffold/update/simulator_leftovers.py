"""Files that have no effect after a change of the simulator: added or edited files for the other Gazebo."""

import re
from collections.abc import Collection, Iterator
from pathlib import Path

_CLASSIC = re.compile(r"\blib(?:gazebo|hector_gazebo|velodyne_gazebo)_\w+\.so\b")
_GZ = re.compile(r"\b(?:gz::sim|ignition::gazebo)::|\b(?:gz|ignition)-(?:sim|gazebo)-")
_BRIDGED = re.compile(r"(?m)^\s*-?\s*(?:gz|ign)_topic_name\s*:")
_SENSOR = re.compile(r"<sensor\b")
_MODELS = (".xacro", ".urdf")
_TOO_LARGE = 2**20


def left_behind(folder: Path, tops: Collection[str], simulator: str) -> Iterator[str]:
    """Yield a line for each file that has no effect in a simulator, with the reason.

    Args:
        folder: the folder of the packages.
        tops: names of the packages' folders.
        simulator: the simulator used now, ``gz`` or ``classic``.
    """
    for path in sorted(path for top in tops for path in (folder / top).rglob("*")):
        if path.suffix not in (*_MODELS, ".yaml") or not path.is_file() or path.stat().st_size > _TOO_LARGE:
            continue
        reason = _reason(path.read_text("utf-8", "replace"), path.suffix in _MODELS, simulator)
        if reason:
            yield f"{path.relative_to(folder).as_posix()} was kept, but {reason}"


def _reason(text: str, is_model: bool, simulator: str) -> str:
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    classic = _CLASSIC.search(text) is not None
    if simulator == "gz":
        return "its plugins are for Gazebo Classic, and Gazebo Sim ignores them" if is_model and classic else ""
    if simulator != "classic":
        return ""
    if not is_model:
        return "it configures a bridge, which Gazebo Classic does not use" if _BRIDGED.search(text) else ""
    if _GZ.search(text):
        return "its plugins are for Gazebo Sim, and do not exist in Gazebo Classic"
    if _SENSOR.search(text) and not classic:
        return "its sensor has no plugin for Gazebo Classic and publishes nothing; `urdfkit new sensor` replaces it"
    return ""
