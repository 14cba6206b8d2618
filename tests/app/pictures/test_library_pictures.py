"""Pictures of the library on the page: ``python -m tests.app.pictures.test_library_pictures`` renders them again."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from urdfkit.description.sdf import model_names
from urdfkit.resources import robot_names
from urdfkit.view.server.http_handlers import APP

pytest.importorskip("pinocchio")
pytest.importorskip("numba")

FOLDER = APP / "library"
EDGE = 96
"""Width and height [px]; the page shows them at two thirds of that."""
FROM = (30.0, 20.0, 1.0)
"""Azimuth and elevation [degrees] and zoom of the camera."""
ABOVE_GROUND = ("sun", "ground_plane")
"""Models that the page does not offer."""


NAMES = [*(name for name in model_names() if name not in ABOVE_GROUND), *robot_names()]


def picture(name: str) -> NDArray[np.uint8]:
    """Render a model of the library, or a robot, alone."""
    from urdfkit.app.pictures.studio import Studio, camera_of
    from urdfkit.scene import Scene
    from urdfkit.sim import Simulator

    if name in robot_names():
        simulator = Simulator(name, world="void")
        scene, poses = simulator.scene, simulator.link_poses()
    else:
        world = Simulator("simpleton", world="void").world
        world.spawn(name, (50.0, 50.0, 0.0, 0.0, 0.0, 0.0))
        bodies = world.body_poses()
        scene, poses = Scene(tuple(bodies), tuple(world.body_shapes())), np.array(list(bodies.values()))
    studio = Studio(scene, poses)
    camera = camera_of(studio, [poses], (EDGE, EDGE), FROM)
    return studio.picture(poses, camera, EDGE, EDGE, is_transparent=True)


def test_each_entry_of_the_library_has_a_small_picture() -> None:
    files = {path.stem: path.stat().st_size for path in FOLDER.glob("*.webp")}
    assert sorted(files) == sorted(NAMES), "run python -m tests.app.pictures.test_library_pictures"
    assert sum(files.values()) < 120_000


@pytest.mark.parametrize("name", ["chair", "crate", "simpleton"])
def test_a_picture_shows_the_present_model(name: str) -> None:
    from PIL import Image

    seen = np.asarray(Image.open(FOLDER / f"{name}.webp").convert("RGBA"), dtype=float)
    now = picture(name).astype(float)
    assert np.abs(seen[..., 3] - now[..., 3]).mean() < 2.0
    opaque = (now[..., 3] > 250) & (seen[..., 3] > 250)
    assert opaque.mean() > 0.05
    assert np.abs(seen - now)[opaque].mean() < 6.0  # of 255; the files are compressed with losses


if __name__ == "__main__":
    from PIL import Image

    FOLDER.mkdir(exist_ok=True)
    for entry in NAMES:
        Image.fromarray(picture(entry)).save(FOLDER / f"{entry}.webp", quality=80, method=6)
