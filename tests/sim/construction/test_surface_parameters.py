"""How links rub, as their descriptions say."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit import Simulator, lint
from urdfkit.description.loading import load_repaired
from urdfkit.errors import SimulationError, UrdfkitError
from urdfkit.sim.construction.surface_parameters import surfaces_of
from urdfkit.sim.engine import Surface


def surfaces(folder: Path, *blocks: str) -> dict[str, Surface]:
    links = '<link name="chassis"/><link name="wheel"/>'
    joint = '<joint name="j" type="continuous"><parent link="chassis"/><child link="wheel"/></joint>'
    path = folder / "robot.urdf"
    path.write_text(f'<robot name="r" xmlns:gz="http://gazebosim.org/schema">{links}{joint}{"".join(blocks)}</robot>')
    return surfaces_of(load_repaired(path))


def block(inside: str, link: str = "wheel") -> str:
    return f'<gazebo reference="{link}">{inside}</gazebo>'


def test_both_coefficients_and_the_direction_are_read(tmp_path: Path) -> None:
    found = surfaces(tmp_path, block('<mu1 value="0.2"/><mu2>0.8</mu2><fdir1>0 1 0</fdir1>'))
    assert found == {"wheel": Surface(0.2, 0.8, (0.0, 1.0, 0.0))}


def test_one_coefficient_is_both(tmp_path: Path) -> None:
    assert surfaces(tmp_path, block("<mu1>0.3</mu1>")) == {"wheel": Surface(0.3, 0.3)}
    assert surfaces(tmp_path, block("<mu2>0.3</mu2>")) == {"wheel": Surface(1.0, 0.3)}


def test_blocks_of_one_link_add_up(tmp_path: Path) -> None:
    assert surfaces(tmp_path, block("<mu2>0.3</mu2>"), block("<mu1>0.1</mu1>")) == {"wheel": Surface(0.1, 0.3)}


def test_a_direction_may_be_another_links(tmp_path: Path) -> None:
    found = surfaces(tmp_path, block('<mu1>1</mu1><mu2>0</mu2><fdir1 gz:expressed_in="chassis">1 -1 0</fdir1>'))
    assert found == {"wheel": Surface(1.0, 0.0, (1.0, -1.0, 0.0), "chassis")}
    with pytest.raises(SimulationError, match="`chasis`, which is not a link; did you mean `chassis`"):
        surfaces(tmp_path, block('<fdir1 gz:expressed_in="chasis">1 -1 0</fdir1>'))


@pytest.mark.parametrize("text", ["-1", "much", "1 2", "nan"])
def test_an_invalid_coefficient_is_ignored_and_reported(tmp_path: Path, text: str) -> None:
    assert surfaces(tmp_path, block(f"<mu1>{text}</mu1>\n<mu2>0.3</mu2>")) == {"wheel": Surface(1.0, 0.3)}
    (finding,) = [each for each in lint(tmp_path / "robot.urdf") if each.code == "E010"]
    assert finding.message == f"<mu1>: `{text}` is not a number, zero or greater"
    (repair,) = Simulator(tmp_path / "robot.urdf", fixed_base=True, note=lambda _: None).repairs[:1]
    assert repair.code == "E010"
    with pytest.raises(UrdfkitError, match="<mu1>"):
        Simulator(tmp_path / "robot.urdf", strict=True)


@pytest.mark.parametrize("text", ["1 0", "a b c", "1 0 inf"])
def test_an_invalid_direction_is_ignored_and_reported(tmp_path: Path, text: str) -> None:
    assert surfaces(tmp_path, block(f"<mu1>0.2</mu1>\n<fdir1>{text}</fdir1>")) == {"wheel": Surface(0.2, 0.2)}
    assert f"<fdir1>: `{text}` is not 3 numbers" in [each.message for each in lint(tmp_path / "robot.urdf")]
