"""Fixed links that meet their parent links only with the opposite sign of a coordinate."""

import pytest

from urdfkit.lint import lint

BOX = '<link name="{}"><visual><origin xyz="{}"/><geometry><box size="{}"/></geometry></visual></link>\n'
ROBOT = f"""<robot name="tug">
{BOX.format("drawbar", "-0.25 0 0", "0.5 0.06 0.06")}{BOX.format("trailer", "0 0 0.12", "1.8 1 0.12")}
<joint name="trailer_joint" type="fixed"><parent link="drawbar"/><child link="trailer"/>
  <origin xyz="-1.4 0 0"/></joint>
</robot>"""


@pytest.mark.parametrize(
    ("xyz", "lines"),
    [("-1.4 0 0", []), ("1.4 0 0", [6]), ("1.3 0 0", []), ("0.95 0 0", []), ("1.4 2 0", [])],
    ids=["touching", "wrong sign", "apart with any sign", "near", "beside it"],
)
def test_a_lost_sign_is_reported_if_the_links_meet_with_it(xyz, lines, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tug.urdf").write_text(ROBOT.replace("-1.4 0 0", xyz))
    found = lint("tug.urdf", select=("J427",))
    assert [each.line for each in found] == lines
    if lines:
        assert found[0].message == (
            "link `trailer` is 0.5 m away from its parent link `drawbar`; "
            "with the opposite sign of x it starts where its parent ends"
        )
