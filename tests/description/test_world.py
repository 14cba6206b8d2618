from pathlib import Path

import pytest

from urdfkit.description.world import Ground, load_world, world_names
from urdfkit.errors import DescriptionError, ResourceError, XmlError


def written(tmp_path: Path, text: str, version: str = "1.6") -> Path:
    path = tmp_path / "test.world"
    path.write_text(f'<sdf version="{version}">\n{text}\n</sdf>\n')
    return path


def test_shipped_worlds() -> None:
    assert load_world("empty").gravity == (0.0, 0.0, -9.81)
    assert load_world("empty").ground == Ground("ground_plane", 0.0, 100.0)
    assert load_world("void").ground is None
    assert {"empty", "void"} <= set(world_names())


def test_an_sdf_world_of_includes(tmp_path: Path) -> None:
    world = load_world(
        written(
            tmp_path,
            """<world name="moon"><gravity>0 0 -1.62</gravity>
            <include><uri>model://sun</uri></include>
            <include><uri>model://ground_plane</uri><pose>0 0 0.5 0 0 0</pose></include></world>""",
        )
    )
    assert (world.name, world.gravity) == ("moon", (0.0, 0.0, -1.62))
    assert world.ground == Ground("ground_plane", 0.5, 100.0)


def test_an_sdf_world_with_its_own_plane(tmp_path: Path) -> None:
    world = load_world(
        written(
            tmp_path,
            """<world name="w"><physics type="ode"/><light name="sun" type="directional"/>
            <model name="floor"><static>true</static><pose>0 0 1 0 0 0</pose><link name="link"><collision name="c">
            <geometry><plane><normal>0 0 1</normal></plane></geometry>
            <surface><friction><ode><mu>0.4</mu></ode></friction></surface></collision></link></model></world>""",
        )
    )
    assert world.gravity == (0.0, 0.0, -9.8)
    assert world.ground == Ground("floor", 1.0, 0.4)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('<world name="w">\n<gravity>0 0</gravity></world>', "<gravity> is `0 0`; it must be 3 finite numbers"),
        ('<world name="w">\n<gravity>0 0 nan</gravity></world>', "<gravity> is `0 0 nan`"),
    ],
)
def test_what_cannot_be_simulated_is_named_with_its_place(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(DescriptionError) as caught:
        load_world(written(tmp_path, text))
    assert said in str(caught.value)
    assert "test.world:3:1: " in str(caught.value)


def test_wrong_worlds(tmp_path: Path) -> None:
    with pytest.raises(ResourceError, match="no world `emty`; did you mean `empty`"):
        load_world("emty")
    with pytest.raises(ResourceError, match=r"cannot read .*nowhere\.sdf"):
        load_world(tmp_path / "nowhere.sdf")
    path = tmp_path / "bad.sdf"
    path.write_text("<sdf><world")
    with pytest.raises(XmlError, match=r"bad\.sdf:1:"):
        load_world(path)
    path.write_text("<robot/>")
    with pytest.raises(DescriptionError, match="an SDF world starts with <sdf>"):
        load_world(path)
