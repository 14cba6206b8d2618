"""The picture of a robot: it shows what is there, where it is, and is the same each time."""

from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image, ImageDraw

from urdfkit.description import load
from urdfkit.scaffold.wrap.readme_picture import HEIGHT, WIDTH, drawing_of, faces_of

GROUND = (242, 244, 246)


def robot(tmp_path, *shapes, more=""):
    visuals = "".join(
        f'<visual><origin xyz="{xyz}"/><geometry>{shape}</geometry>'
        f'<material name="{k}"><color rgba="{rgba} 1"/></material></visual>'
        for k, (shape, xyz, rgba) in enumerate(shapes)
    )
    path = tmp_path / "r.urdf"
    path.write_text(f'<robot name="r"><link name="a">{visuals}</link>{more}</robot>')
    return load(path)


def picture(described):
    drawing = drawing_of(described)
    assert drawing == drawing_of(described)
    background, *paths = ElementTree.fromstring(drawing)
    image = Image.new("RGB", (WIDTH, HEIGHT), background.get("fill"))
    for path in paths:
        points = [tuple(map(float, point.split(","))) for point in path.get("d")[1:-1].split()]
        ImageDraw.Draw(image).polygon(points, fill=path.get("fill"), outline=path.get("stroke"))
    return np.asarray(image).astype(int)


def is_of(image, channel):
    """Return where a pixel has much of one channel only."""
    others = [k for k in range(3) if k != channel]
    return (image[..., channel] > 60) & (image[..., others].max(axis=-1) < 20)


@pytest.mark.slow
@pytest.mark.parametrize(
    "shape", ['<box size="1 1 1"/>', '<sphere radius="0.5"/>', '<cylinder radius="0.5" length="1"/>']
)
def test_a_solid_is_as_large_as_it_is(tmp_path, shape):
    image = picture(robot(tmp_path, (shape, "0 0 0", "1 0 0")))
    red = is_of(image, 0)
    rows, columns = np.nonzero(red)
    width, height = np.ptp(columns) + 1, np.ptp(rows) + 1
    if "sphere" in shape:
        assert abs(width - height) <= 2
        assert red.sum() == pytest.approx(np.pi / 4 * width * height, rel=0.02)
    assert (image[0] == image[0, 0]).all()
    assert tuple(image[0, 0]) == pytest.approx(GROUND, abs=1)
    shadow = (np.ptp(image, axis=-1) < 12) & (image.mean(axis=-1) < 220)
    assert shadow.sum() > 500


@pytest.mark.slow
def test_what_is_before_hides_what_is_behind(tmp_path):
    box = '<box size="0.2 0.6 0.6"/>'
    front = picture(robot(tmp_path, (box, "0.3 0 0", "0 1 0"), (box, "0 0 0", "1 0 0")))
    assert is_of(front, 1).sum() > 2 * is_of(front, 0).sum() > 0


@pytest.mark.slow
def test_left_is_right_of_the_middle_and_up_is_up(tmp_path):
    ball = '<sphere radius="0.1"/>'
    image = picture(
        robot(tmp_path, (ball, "0 0.5 0", "1 0 0"), (ball, "0 -0.5 0", "0 1 0"), (ball, "0 0 0.5", "0 0 1"))
    )
    centre = [np.argwhere(is_of(image, channel)).mean(axis=0) for channel in range(3)]
    assert centre[0][1] > centre[2][1] > centre[1][1]  # from the front, what is on the robot's left is on the right
    assert centre[2][0] < min(centre[0][0], centre[1][0])


def test_links_are_where_their_joints_put_them(tmp_path):
    more = (
        '<link name="b"><visual><geometry><box size="1 2 3"/></geometry></visual></link><joint name="j" type="fixed">'
        '<parent link="a"/><child link="b"/><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/></joint>'
    )
    corners = np.array([corner for _, face, _ in faces_of(robot(tmp_path, more=more)) for corner in face])
    assert corners.mean(axis=0) == pytest.approx([1, 0, 0])
    assert np.ptp(corners, axis=0) == pytest.approx([2, 1, 3])


def test_what_is_inside_of_a_solid_is_hidden(tmp_path):
    box, ball = ('<box size="1 1 1"/>', "0 0 0", "1 0 0"), ('<sphere radius="0.49"/>', "0 0 0", "0 1 0")
    assert is_of(picture(robot(tmp_path, ball, box)), 1).sum() == 0
    sunk = picture(robot(tmp_path, box, ('<box size="0.5 0.5 1"/>', "0 0 0.25", "0 1 0")))
    shown = picture(robot(tmp_path, box, ('<box size="0.5 0.5 0.25"/>', "0 0 0.625", "0 1 0")))
    assert is_of(shown, 1).sum() > 3000
    assert np.count_nonzero(is_of(sunk, 1) != is_of(shown, 1)) < 30  # rounding at edges


def test_meshes_are_not_drawn(tmp_path):
    assert drawing_of(robot(tmp_path, ('<mesh filename="a.stl"/>', "0 0 0", "1 0 0"))) is None
