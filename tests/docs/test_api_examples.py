"""Examples in docstrings show every public class, function, method and property, and print what they show."""

from __future__ import annotations

import ast
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

GRIPPER = """<robot name="gripper">
  <link name="world"/>
  <joint name="table_joint" type="planar"><parent link="world"/><child link="palm"/><axis xyz="0 0 1"/></joint>
  <link name="palm"/>
  <joint name="right_finger_joint" type="prismatic">
    <parent link="palm"/><child link="right_finger"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" effort="10" velocity="0.1"/>
  </joint>
  <link name="right_finger"/>
  <joint name="left_finger_joint" type="prismatic">
    <parent link="palm"/><child link="left_finger"/><axis xyz="0 1 0"/>
    <limit lower="-0.04" upper="0" effort="10" velocity="0.1"/><mimic joint="right_finger_joint" multiplier="-1"/>
  </joint>
  <link name="left_finger"/>
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


def members(value: Any) -> dict[str, Any]:
    """Return name → function of the public methods and properties that a class defines itself."""
    own = vars(value).items() if inspect.isclass(value) else ()
    plain = {key: getattr(each, "fget", None) or getattr(each, "func", None) or each for key, each in own}
    plain = {key: getattr(each, "__func__", each) for key, each in plain.items()}
    return {key: each for key, each in plain.items() if not key.startswith("_") and inspect.isfunction(each)}


MEMBERS = {f"{name}.{key}": each for name, value in PUBLIC.items() for key, each in members(value).items()}


def examples(value: Any) -> list[doctest.Example]:
    """Return the statements of the example in a docstring."""
    return doctest.DocTestParser().get_examples(inspect.getdoc(value) or "")


def shown(value: Any) -> set[str]:
    """Return the attributes that an example uses, or that its classes define."""
    trees = [ast.parse(example.source) for example in examples(value)]
    nodes = [node for tree in trees for node in ast.walk(tree)]
    used = {node.attr for node in nodes if isinstance(node, ast.Attribute)}
    bodies = [each for node in nodes if isinstance(node, ast.ClassDef) for each in node.body]
    assigned = {ast.unparse(target) for each in bodies if isinstance(each, ast.Assign) for target in each.targets}
    return used | assigned | {each.name for each in bodies if isinstance(each, ast.FunctionDef)}


def not_shown(value: Any) -> list[str]:
    """Return the members of a class that neither its example nor their own one shows."""
    return [key for key, each in members(value).items() if key not in shown(value) | shown(each)]


def test_members_of_public_names_have_docstrings() -> None:
    assert [name for name, each in {**PUBLIC, **MEMBERS}.items() if not each.__doc__] == []


def test_examples_show_every_member_of_public_names() -> None:
    assert {name: missing for name, value in PUBLIC.items() if (missing := not_shown(value))} == {}


class Planted:
    """A class.

    Examples:
        >>> Planted().called()
        >>> class Own(Planted):
        ...     def defined(self): ...
    """

    def called(self) -> None:
        """Appear in the example of the class."""

    def defined(self) -> None:
        """Appear in a class of the example."""

    def own(self) -> None:
        """Appear in an example of its own.

        Examples:
            >>> Planted().own()
        """

    @property
    def missing(self) -> None:
        """Appear in the example of another member, or as a name alone.

        Examples:
            >>> missing = Planted().called()
        """


def test_a_member_that_no_example_shows_is_found() -> None:
    assert not_shown(Planted) == ["missing"]


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(PUBLIC) + [name for name, each in MEMBERS.items() if examples(each)])
def test_the_example_prints_what_it_shows(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(IMPOSSIBLE)
    Path("gripper.urdf").write_text(GRIPPER)
    text = inspect.getdoc({**PUBLIC, **MEMBERS}[name]) or ""
    if name == "Chain.torch":
        pytest.importorskip("pytorch_kinematics")
    test = doctest.DocTestParser().get_doctest(text, {}, name, None, 0)  # in an empty namespace, as a reader types it
    assert test.examples, f"{name} has no example"
    printed: list[str] = []
    doctest.DocTestRunner().run(test, out=printed.append)
    assert "".join(printed) == ""
