"""Suggestions for files and folders that do not exist."""

from pathlib import Path

import pytest

from urdfkit.description.packages.similar_names import near_path


@pytest.mark.parametrize(
    ("path", "hint"),
    [
        ("car_diferential.urdf", "; did you mean `car_differential.urdf`?"),
        ("mesh/side.stl", "; did you mean `meshes`?"),
        ("meshes/sid.stl", "; did you mean `side.stl`?"),
        ("differential/side.stl", ""),  # a file does not stand for a folder
        ("arm_gazebo.xacro", "; did you mean `arm.gazebo.xacro`?"),
    ],
)
def test_the_nearest_name_of_the_same_kind_is_suggested(tmp_path: Path, path: str, hint: str) -> None:
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "side.stl").touch()
    (tmp_path / "car_differential.urdf").touch()
    (tmp_path / "arm.gazebo.xacro").touch()
    assert near_path(tmp_path / path) == hint


def test_a_file_is_not_suggested_to_itself(tmp_path: Path) -> None:
    (tmp_path / "cart.urdf.xacro").touch()
    assert near_path(tmp_path / "cart.xacro") == "; did you mean `cart.urdf.xacro`?"
    assert near_path(tmp_path / "cart.xacro", user=tmp_path / "cart.urdf.xacro") == ""
