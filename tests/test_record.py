"""Records behave as frozen dataclasses do."""

from __future__ import annotations

import dataclasses
import subprocess
import sys
from functools import cached_property

import pytest

from urdfkit.record import field, record


@record(order=True)
class Point:
    x: int
    y: int = 2
    note: str = field(default="", repr=False)

    @cached_property
    def total(self) -> int:
        return self.x + self.y


@record
class Bag:
    label: str = "bag"
    items: list[int] = field(default_factory=list)


def test_annotations_need_not_be_text():
    kind = type("Pair", (), {"__annotations__": {"a": int, "b": str}})
    assert record(kind)(1, b="x").b == "x"


@record(eq=False)
class Node:
    name: str = field(repr=False)
    point: Point = field(repr=False)


def test_construction_and_defaults():
    assert Point(1) == Point(1, 2, "") == Point(x=1, note="", y=2)
    assert Point(1).y == 2
    assert Point(1, 3).total == 4


@pytest.mark.parametrize(
    ("make", "complaint"),
    [
        (lambda: Point(), "missing arguments: 'x'"),
        (lambda: Point(1, 2, "", 4), "takes 3 arguments but 4"),
        (lambda: Point(1, z=3), "unexpected keyword argument 'z'"),
        (lambda: Point(1, x=3), "multiple values for argument 'x'"),
        (lambda: Node("n"), "missing arguments: 'point'"),
    ],
)
def test_wrong_arguments_are_refused(make, complaint):
    with pytest.raises(TypeError, match=complaint):
        make()


def test_factories_make_a_new_value_each_time():
    first, second = Bag(), Bag(items=[1])
    first.items.append(3)
    assert (Bag().items, second.items) == ([], [1])
    assert dataclasses.replace(second, label="b") == Bag("b", [1])
    assert dataclasses.fields(Bag)[1].default_factory is list


def test_frozen():
    point = Point(1)
    with pytest.raises(dataclasses.FrozenInstanceError):
        point.x = 2
    with pytest.raises(dataclasses.FrozenInstanceError):
        del point.x
    assert point.x == 1


def test_equality_order_and_hash():
    assert Point(1) != Point(2)
    assert Point(1) != (1, 2, "")
    assert hash(Point(1)) == hash(Point(1, 2))
    assert sorted([Point(2, 1), Point(1, 9), Point(1, 3)]) == [Point(1, 3), Point(1, 9), Point(2, 1)]
    assert Point(1) <= Point(1) < Point(2)
    assert Point(2) >= Point(2) > Point(1)
    with pytest.raises(TypeError):
        assert Point(1) < 3
    assert Node("a", Point(1)) != Node("a", Point(1))


def test_repr_hides_what_it_is_told_to():
    assert repr(Point(1)) == "Point(x=1, y=2)"
    assert repr(Node("a", Point(1))) == "Node()"


def test_dataclasses_functions_work():
    point = Point(1, note="here")
    assert dataclasses.is_dataclass(Point)
    assert [f.name for f in dataclasses.fields(Point)] == ["x", "y", "note"]
    assert dataclasses.replace(point, y=5) == Point(1, 5, "here")
    assert dataclasses.asdict(point) == {"x": 1, "y": 2, "note": "here"}
    assert dataclasses.asdict(Node("a", point))["point"] == {"x": 1, "y": 2, "note": "here"}


def test_pattern_matching():
    match Point(1, 7):
        case Point(x, y):
            assert (x, y) == (1, 7)


def test_does_not_import_dataclasses():
    code = "import sys, urdfkit.record; sys.exit('dataclasses' in sys.modules or 'inspect' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
