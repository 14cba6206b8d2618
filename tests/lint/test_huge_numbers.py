"""Numbers whose powers overflow: a finding at their place, and none of the rules fails."""

from __future__ import annotations

import random
import re
from pathlib import Path

import pytest

from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options

TENSOR = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
INERTIAL = f'<inertial><origin xyz="0 0 0"/><mass value="1"/>{TENSOR}</inertial>'
SPHERE = '<sphere radius="1"/>'
NUMBER = re.compile(r"(?<=[\"'\s>{(=])-?\d+\.?\d*(?:e-?\d+)?(?=[\"'\s<})])")
VALUES = ("1e103", "-1e103", "1e200", "1e300", "1e-200", "5e-324", "1e30", "inf", "nan", "9" * 400, "0")


def link(shape: str = SPHERE, inertial: str = INERTIAL) -> str:
    return f'<link name="a"><collision><geometry>{shape}</geometry></collision>{inertial}</link>'


def found(path: Path, text: str | None = None) -> list[tuple[str, str]]:
    """Return codes and messages; a rule that fails raises."""
    texts = {str(path.absolute()): text} if text is not None else {}
    return [(one.code, one.message) for one in run([Entry(path)], Options(texts=texts)).findings]


@pytest.mark.parametrize("with_inertial", [True, False])
@pytest.mark.parametrize(
    ("shape", "attribute"),
    [
        ('<sphere radius="1e103"/>', 'radius="1e103" of <sphere>'),
        ('<sphere radius="1e11"/>', 'radius="1e11" of <sphere>'),
        ('<box size="1e300 1 1"/>', 'size="1e300 1 1" of <box>'),
        ('<cylinder radius="1e200" length="1"/>', 'radius="1e200" of <cylinder>'),
        ('<cylinder radius="1" length="1e200"/>', 'length="1e200" of <cylinder>'),
        ('<capsule radius="1e155" length="1"/>', 'radius="1e155" of <capsule>'),
        ('<mesh filename="a.stl" scale="1e300 1 1"/>', 'scale="1e300 1 1" of <mesh>'),
    ],
)
def test_a_shape_beyond_all_measure_is_a_finding(write, shape, attribute, with_inertial):
    path = write("r.urdf", link(shape, INERTIAL if with_inertial else ""))
    (message,) = [message for code, message in found(path) if code == "E012"]
    assert attribute in message
    assert message.endswith(("too large", "has a value of magnitude above 1e10"))


@pytest.mark.parametrize(
    ("written", "huge", "attribute"),
    [
        ('xyz="0 0 0"', 'xyz="1e300 0 0"', "xyz"),
        ('value="1"', 'value="1e300"', "value"),
        ('ixx="1"', 'ixx="-1e300"', "ixx"),
    ],
)
def test_an_inertial_beyond_all_measure_is_a_finding(write, written, huge, attribute):
    path = write("r.urdf", link(inertial=INERTIAL.replace(written, huge)))
    assert [code for code, message in found(path) if code == "E012" and attribute in message] == ["E012"]


def test_infinite_limits_are_let_be(write):
    ends = '<parent link="a"/><child link="b"/><axis xyz="0 0 1"/>'
    limit = '<limit lower="-1e300" upper="1e300" effort="inf" velocity="1e308"/>'
    joint = f'<joint name="j" type="prismatic">{ends}{limit}</joint>'
    assert "E012" not in dict(found(write("r.urdf", f'<link name="a"/><link name="b"/>{joint}')))


@pytest.mark.slow
def test_no_rule_fails_by_numbers():
    """Each of half of the models of the rules, with huge and tiny numbers in the place of some of its own."""
    models = sorted(
        path
        for path in (Path(__file__).parent / "rules").glob("*/*")
        if path.suffix in (".urdf", ".xacro") and path.stat().st_size < 20_000
    )
    random_ = random.Random(7)
    for path in random_.sample(models, len(models) // 2):
        text = path.read_text(encoding="utf-8", errors="replace")
        for share in (0.1, 1.0):
            numbers = NUMBER.sub(lambda n, s=share: random_.choice(VALUES) if random_.random() < s else n[0], text)
            found(path, numbers)


@pytest.mark.parametrize("angle", ["inf", "nan", "1e308"])
def test_a_lidar_with_an_infinite_view_is_examined(write, angle):
    scan = f"<scan><horizontal><min_angle>-{angle}</min_angle><max_angle>{angle}</max_angle></horizontal></scan>"
    sensor = f'<gazebo reference="b"><sensor name="lidar" type="ray"><ray>{scan}</ray></sensor></gazebo>'
    joint = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="1.1 0 0"/></joint>'
    path = write("r.urdf", f'{link()}<link name="b"/>{joint}{sensor}')
    assert "Z823" in {code for code, _ in found(path)}
