import base64
import gzip
import hashlib
import json
import re

import numpy as np
import pytest
import trimesh
import umsgpack

from urdfkit.description.urdf.robot import Box, Mesh
from urdfkit.scene import Scene, Shape, TriMesh
from urdfkit.view.content.meshcat_objects import draw, link_path
from urdfkit.view.html_export import Recording
from urdfkit.view.server.http_handlers import APP


@pytest.fixture
def page() -> str:
    box = trimesh.creation.box()
    mesh = TriMesh(np.asarray(box.vertices, dtype=np.float32), np.asarray(box.faces, dtype=np.int32))
    scene = Scene(
        ("base", "</script>"),
        (
            Shape("base/visual/0", "base", "visual", Box((1, 1, 1)), np.eye(4)),
            Shape("x/visual/0", "</script>", "visual", Mesh("m.stl"), np.eye(4), mesh=mesh),
        ),
    )
    recording = Recording()
    recording.show(
        name="toy", nodes=[link_path(body) for body in scene.bodies], draw=lambda r: draw(scene, r, r.geometries)
    )
    recording.publish(0.0, np.zeros((2, 7)))
    recording.publish_latched("fault", message="an end: </script><script>alert(1)</script>")
    return recording.html()


def recorded(page: str) -> dict:
    found = re.search(r'<script type="application/json" id="recording">(.*?)</script>', page, re.S)
    assert found is not None
    return json.loads(found[1])


def test_the_page_asks_for_nothing(page: str) -> None:
    text = re.sub(r"<script\b.*?</script>", "", page, flags=re.S)  # meshcat's own text names addresses it does not ask
    assert not re.search(r'(?:src|href)="(?!data:|#)', text)
    assert "/app/" not in text


def test_every_import_is_answered(page: str) -> None:
    found = re.search(r'<script type="importmap">(.*?)</script>', page, re.S)
    assert found is not None
    imports = json.loads(found[1])["imports"]
    assert set(imports) == {f"urdfkit/{path.relative_to(APP).as_posix()}" for path in APP.rglob("*.js")}
    for address in imports.values():
        text = base64.b64decode(address.partition(",")[2]).decode()
        wanted = re.findall(r'^(?:import|export|\}).*?\sfrom\s*"([^"]+)"|^import\s*"([^"]+)"', text, re.M)
        assert {name for pair in wanted for name in pair if name} <= set(imports)


def test_the_policy_lets_these_scripts_run_and_no_others(page: str) -> None:
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', page)
    assert policy is not None
    allowed = set(re.findall(r"'(sha256-[^']+)'", policy[1]))
    scripts = re.findall(r"<script[^>]*>(.*?)</script>", page, re.S)
    assert len(scripts) == 4
    assert {f"sha256-{base64.b64encode(hashlib.sha256(s.encode()).digest()).decode()}" for s in scripts} == allowed
    assert "default-src 'none'" in policy[1]
    assert "unsafe-eval" not in policy[1]
    assert "script-src 'unsafe-inline'" not in policy[1]


def test_what_was_shown_is_in_it(page: str) -> None:
    recording = recorded(page)
    texts = {message["type"]: message for message in map(json.loads, recording["texts"])}
    assert texts["hello"]["mode"] == "view"
    assert texts["model"]["name"] == "toy"
    assert texts["fault"]["message"].endswith("</script>")
    assert len(recording["commands"]) == 4  # an object and a transform for each shape
    assert len(base64.b64decode(recording["poses"])) == 16 + 2 * 28
    (packed,) = recording["meshes"].values()
    assert b'"vertices": 24' in gzip.decompress(base64.b64decode(packed))


def test_showing_again_forgets_what_was_there() -> None:
    recording = Recording()
    for edge in (1.0, 2.0):
        scene = Scene(("base",), (Shape("n", "base", "visual", Box((edge, 1, 1)), np.eye(4)),))
        recording.show(name="toy", nodes=[link_path("base")], draw=lambda r, scene=scene: draw(scene, r, r.geometries))
    assert len(recorded(recording.html())["commands"]) == 2


def test_the_same_scene_is_the_same_bytes_and_names_no_machine() -> None:
    def commands() -> list[bytes]:
        recording = Recording()
        shapes = [
            Shape(f"x/visual/{number}", "x", "visual", geometry, np.eye(4))
            for number, geometry in enumerate((Box((1, 1, 1)), Box((1, 1, 2))))
        ]
        draw(Scene(("x",), tuple(shapes)), recording, recording.geometries)
        return [base64.b64decode(command) for command in recorded(recording.html())["commands"]]

    first = commands()
    assert first == commands()
    assert not any(re.search(rb"[0-9a-f]{8}-[0-9a-f]{4}-1", command) for command in first)  # UUIDs of version 1
    objects = [content for content in map(umsgpack.unpackb, first) if content["type"] == "set_object"]
    assert len(objects) == 2
    for content in (each["object"] for each in objects):
        assert content["object"]["geometry"] == content["geometries"][0]["uuid"]
        assert content["object"]["material"] == content["materials"][0]["uuid"]
