from pathlib import Path

import pytest

from urdfkit.description import load
from urdfkit.description.urdf.massless_links import massless

MASS = '<inertial><mass value="{}"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'


def names(tmp_path: Path, *, floating: bool = True, **masses: str) -> list[tuple[str, str | None]]:
    """Build base -fixed- plate -elbow- arm -fixed- tool with these inertials; return what is found."""
    links = "".join(f'<link name="{link}">{masses.get(link, "")}</link>' for link in ("base", "plate", "arm", "tool"))
    path = tmp_path / "r.urdf"
    path.write_text(
        f"""<robot name="r">{links}
        <joint name="a" type="fixed"><parent link="base"/><child link="plate"/></joint>
        <joint name="elbow" type="continuous"><parent link="plate"/><child link="arm"/></joint>
        <joint name="b" type="fixed"><parent link="arm"/><child link="tool"/></joint></robot>"""
    )
    found = massless(load(path), floating=floating)
    return [(link.name, None if joint is None else joint.name) for link, joint in found]


def test_every_body_needs_a_mass(tmp_path: Path) -> None:
    assert names(tmp_path) == [("base", None), ("arm", "elbow")]
    assert names(tmp_path, floating=False) == [("arm", "elbow")]


@pytest.mark.parametrize("heavy", ["base", "plate"])
@pytest.mark.parametrize("moved", ["arm", "tool"])
def test_one_link_of_those_fixed_together_is_enough(tmp_path: Path, heavy: str, moved: str) -> None:
    assert names(tmp_path, **{heavy: MASS.format(1), moved: MASS.format(1)}) == []


@pytest.mark.parametrize("useless", [MASS.format(0), '<inertial><mass value="1"/></inertial>'])
def test_a_mass_of_zero_or_without_inertia_does_not_count(tmp_path: Path, useless: str) -> None:
    assert names(tmp_path, base=MASS.format(1), arm=useless) == [("arm", "elbow")]
