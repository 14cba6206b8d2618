"""Commands of ``ros2 control`` that Python launch files execute: misspelt commands, options and states.

Sources: ros-controls/ros2_control (ros2controlcli/setup.py, verb/load_controller.py), Foxy to Rolling.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from urdfkit.defect_message import Suggestion
from urdfkit.description.launch.python_constants import LaunchReader
from urdfkit.errors import nearest

_OF_CONTROL = """
cleanup_controller configure_controller configure_start_controller list_controller_types list_controllers
list_hardware_components list_hardware_interfaces load_configure_controller load_controller load_start_controller
reload_controller_libraries set_controller_state set_hardware_component_state start_controller stop_controller
switch_controllers unload_controller view_controller_chains view_hardware_status
"""
"""Commands of ``ros2 control`` (ros2controlcli, Foxy to Rolling)."""

_OF_LOADING = ("--set-state", "--controller-manager", "-c", "--spin-time", "--use-sim-time", "--include-hidden-nodes")
_STATES = ("active", "inactive", "unconfigured", "configured", "configure", "start")


def control_command(words: list[ast.expr], reader: LaunchReader) -> Iterator[tuple[ast.expr, str]]:
    """Yield a misspelt command, option or state in a call of ``ros2 control``; other versions can have more of them."""
    texts = [reader.text(each) or "" for each in words]
    if texts[:2] != ["ros2", "control"] or len(texts) < 3:
        return
    if (near := _misspelt(texts[2], _OF_CONTROL.split())) is not None:
        yield words[2], f"`ros2 control` has no command `{texts[2]}`" + Suggestion(near, texts[2])
    end = texts.index("--ros-args") if "--ros-args" in texts else len(texts)
    before = texts[2]
    for word, text in zip(words[3:end], texts[3:end], strict=True):
        option, equals, value = text.partition("=")
        is_option = texts[2] == "load_controller" and option.startswith("--")
        if is_option and (near := _misspelt(option, _OF_LOADING)) is not None:
            yield word, f"`load_controller` has no option `{option}`" + Suggestion(near + equals + value, text)
        elif before == "--set-state" and (near := _misspelt(text, _STATES)) is not None:
            yield word, f"unknown state `{text}` of a controller" + Suggestion(near, text)
        before = text


def _misspelt(text: str, names: Sequence[str]) -> str | None:
    """Return the name that a text misspells; None for names, abbreviations of options and other texts."""
    is_name = text in names or (text.startswith("--") and any(name.startswith(text) for name in names))
    return nearest(text, names, cutoff=0.75) if text and not is_name else None
