"""Every public class and function has an example in its docstring, and the example prints what it shows."""

from __future__ import annotations

import doctest
import inspect
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

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
    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(IMPOSSIBLE)
    text = inspect.getdoc(PUBLIC[name]) or ""
    test = doctest.DocTestParser().get_doctest(text, {}, name, None, 0)  # in an empty namespace, as a reader types it
    assert test.examples, f"{name} has no example"
    printed: list[str] = []
    doctest.DocTestRunner().run(test, out=printed.append)
    assert "".join(printed) == ""
