"""Every public class and function has an example in its docstring, and the example prints what it shows."""

from __future__ import annotations

import doctest
import inspect
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import urdfkit

MODULES = ("urdfkit", "urdfkit.sim", "urdfkit.sim.batch", "urdfkit.kinematics", "urdfkit.scene", "urdfkit.messages")
"""The modules of the pages of the Python interface."""

IMPOSSIBLE = """<robot name="arm">
  <link name="base">
    <inertial>
      <origin xyz="0 0 0"/>
      <mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>
    </inertial>
  </link>
</robot>
"""


def public() -> dict[str, Any]:
    """Return name → class or function."""
    found: dict[str, Any] = {}
    for name in MODULES:
        module = import_module(name)
        values = {each: getattr(module, each) for each in module.__all__}
        found |= {each: value for each, value in values.items() if inspect.isclass(value) or inspect.isfunction(value)}
    return found


PUBLIC = public()


def test_members_of_public_names_have_docstrings() -> None:
    for value in PUBLIC.values():
        members = vars(value).items() if inspect.isclass(value) else ()
        plain = {key: getattr(each, "fget", getattr(each, "__func__", each)) for key, each in members}
        functions = [each for key, each in plain.items() if not key.startswith("_") and inspect.isfunction(each)]
        assert [each.__qualname__ for each in (value, *functions) if not each.__doc__] == []


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(PUBLIC))
def test_the_example_prints_what_it_shows(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import numpy as np
    import rosbags.typesys
    import trimesh

    from urdfkit.description.sdf import load_world
    from urdfkit.kinematics.retiming import motion_limits

    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(IMPOSSIBLE)
    names = {
        "urdfkit": urdfkit,
        "np": np,
        "trimesh": trimesh,
        "rosbags": rosbags,
        "Path": Path,
        "load_world": load_world,
    }
    value = PUBLIC[name]
    test = doctest.DocTestParser().get_doctest(
        inspect.getdoc(value) or "", {**PUBLIC, **names, "motion_limits": motion_limits}, name, None, 0
    )
    assert test.examples, f"{name} has no example"
    printed: list[str] = []
    doctest.DocTestRunner().run(test, out=printed.append)
    assert "".join(printed) == ""
