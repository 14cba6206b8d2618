"""K968 spawn-argument-misspelt."""

from __future__ import annotations

import re

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.model import Model
    from urdfkit.lint.started import Started

_CREATE = "world file param string topic name allow_renaming x y z R P Y"
_SPAWN = "reference_frame gazebo_namespace robot_namespace unpause wait package_to_model x y z R P Y J b"
_OPTIONS: dict[str, tuple[str, ...]] = {
    "create": tuple(_CREATE.split()),
    "spawn_entity.py": tuple(f"{_SPAWN} file topic database stdin entity timeout spawn_service_timeout".split()),
    "spawn_model": tuple(f"{_SPAWN} file param database stdin model urdf sdf trimesh gazebo".split()),
}
"""Program → its options (ros_gz_sim Jazzy; gazebo_ros Humble and Noetic)."""

_PACKAGES = ("ros_gz_sim", "ros_ign_gazebo", "gazebo_ros")
_ELSEWHERE = {
    "create": {"entity": "name", "model": "name", "robot": "name", "yaw": "Y", "pitch": "P", "roll": "R"},
    "spawn_entity.py": {"name": "entity", "model": "entity", "param": "topic", "yaw": "Y", "pitch": "P", "roll": "R"},
    "spawn_model": {"name": "model", "entity": "model", "topic": "param", "yaw": "Y", "pitch": "P", "roll": "R"},
}
"""Program → what the others, and people, call an option."""

_DESCRIPTION = "robot_description"


class SpawnArgumentMisspelt(RobotRule):
    """A launch file hands an option to a spawner of Gazebo that it does not have.

    ## What it does
    Looks at the arguments of ``create`` (ros_gz_sim), ``spawn_entity.py`` and ``spawn_model`` (gazebo_ros): for options
    that are nearly one of theirs, or one of another of the three, and for a topic or parameter that is nearly
    ``robot_description``. Launch files in Python are read, not run.

    ## Why is this bad?
    The program stops, or waits for a description that never comes: the world is there, the robot is not.

    ## Example
    ```xml
    <launch>
      <node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -name cart"/>
    </launch>
    ```

    ## Use instead
    ```xml
    <launch>
      <node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model cart"/>
    </launch>
    ```
    """

    code = "K968"
    name = "spawn-argument-misspelt"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each such argument."""
        from urdfkit.lint.started import launches, started

        for source in launches(model):
            if not any(package in source.text for package in _PACKAGES):
                continue
            for node in started(source):
                if node.package in _PACKAGES and node.program in _OPTIONS:
                    for start, written, message in _wrong(node):
                        span = source.span(start, start + len(written))
                        yield Finding(self.code, self.name, self.severity, message, span)


def _wrong(node: Started) -> Iterator[tuple[int, str, str]]:
    """Yield the arguments that are wrong: where, what is written, and what to say."""
    from urdfkit.lint.edits import nearest

    options, before = _OPTIONS[node.program], ""
    for word in node.arguments:
        text = word.name if word is not None else ""
        option = re.fullmatch(r"--?([A-Za-z_]\w*)(?:=.*)?", text)
        if text == "--ros-args":
            return
        if word is not None and option is not None and option[1] not in options:
            meant = _ELSEWHERE[node.program].get(option[1]) or _near(option[1], options)
            if meant is not None:
                yield word.start, text, f"`{node.program}` has no option `{text}`; did you mean `-{meant}`?"
        elif word is not None and before in ("topic", "param"):
            name = text.strip("/").rpartition("/")[2]
            if name != _DESCRIPTION and nearest(name, [_DESCRIPTION], likeness=0.88) is not None:
                yield word.start, text, f"nobody publishes `{text}`; did you mean `{_DESCRIPTION}`?"
        before = option[1] if option is not None else ""


def _near(option: str, options: tuple[str, ...]) -> str | None:
    from urdfkit.lint.edits import nearest

    return nearest(option, [one for one in options if len(one) > 1], likeness=0.7) if len(option) > 2 else None
