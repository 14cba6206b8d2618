"""Families of inputs: for each, the files to start from, a mutation and the code that reads the result."""

from __future__ import annotations

import io
import random
from collections import Counter
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import SimpleNamespace

from tests.bench.fuzz import mutations
from tests.bench.fuzz.descriptions import description, world_file
from tests.bench.fuzz.frames import frames
from tests.bench.fuzz.hostile_values import HOSTILE
from tests.bench.fuzz.packages import workspace, workspaces
from tests.bench.fuzz.seed_files import seeds, text_of
from tests.bench.fuzz.simulations import prepare_kernels, sim
from tests.bench.fuzz.xml_mutations import xml

LIMIT = 10.0
"""CPU time that lint, expand and lsp may take for a file [s]."""


def lint(folder: Path, rng: random.Random) -> str:
    """Lint a description."""
    from urdfkit.lint.engine.run import run
    from urdfkit.lint.project.entry_files import Entry
    from urdfkit.lint.project.options import Options

    run([Entry(description(folder, rng))], Options(guess_target=True, time_limit=LIMIT))
    return "linted"


def packages(folder: Path, rng: random.Random) -> str:
    """Lint a workspace, with its launch, YAML, SRDF and build files."""
    from urdfkit.lint.engine.run import run
    from urdfkit.lint.project.entry_files import find_each
    from urdfkit.lint.project.options import Options

    entries, _ = find_each([workspace(folder, rng)])
    chosen = rng.sample(entries, min(len(entries), 3))
    run(chosen, Options(guess_target=True, time_limit=LIMIT))
    return "linted"


def expand(folder: Path, rng: random.Random) -> str:
    """Expand a description."""
    from urdfkit import expand as expanded
    from urdfkit.description.xml.cost_limit import CostLimit

    with CostLimit(LIMIT):
        expanded(description(folder, rng))
    return "expanded"


def lsp(folder: Path, rng: random.Random) -> str:
    """Open a description in an editor session and request everything at some positions."""
    from lsprotocol import types
    from pygls.exceptions import JsonRpcInvalidParams

    from urdfkit.cli.lsp.session import EditorSession
    from urdfkit.lint.editor.open_files import Project
    from urdfkit.lint.project.options import Options

    path = description(folder, rng)
    uri = path.as_uri()
    text = text_of(path)
    document = SimpleNamespace(source=text, version=1)
    server = SimpleNamespace(workspace=SimpleNamespace(text_documents={uri: document}))
    project = Project(Options(guess_target=True, time_limit=LIMIT))
    session = EditorSession(server, project)  # type: ignore[arg-type]  # the session needs the documents only
    lines = text.split("\n")
    for _ in range(2):
        line = rng.randrange(len(lines) + 2)
        column = rng.randrange(len(lines[line]) + 2) if line < len(lines) else 5
        at = types.Position(line, column)
        session.hover(uri, at)
        session.definition(uri, at)
        session.references(uri, at, with_definition=True)
        session.completion(uri, at)
        session.actions(uri, types.Range(types.Position(0, 0), types.Position(len(lines), 0)))
        try:
            if session.renamable(uri, at) is not None:
                session.rename(uri, at, rng.choice(HOSTILE))
        except JsonRpcInvalidParams:
            pass
        document.source = text = xml(text, rng) if rng.random() < 0.5 else text[: rng.randrange(len(text) + 1)]
        lines = text.split("\n")
    if failures := project.failures(path):
        raise AssertionError(failures[0])
    return "answered"


def sdf(folder: Path, rng: random.Random) -> str:
    """Read a world and write it again."""
    from urdfkit.description.sdf.reader.load import load_world
    from urdfkit.description.sdf.writer import to_sdf

    path, original = world_file(folder, rng)
    world = load_world(path, package_path=[original.parent])
    path.write_text(to_sdf(world), "utf-8")
    load_world(path, package_path=[original.parent])
    return "read"


@cache
def _meshes() -> dict[str, bytes]:
    """Return one small file of each format, with colours, normals and a texture where the format has them."""
    import trimesh
    from PIL import Image

    picture = Image.new("RGBA", (8, 8), (200, 100, 50, 128))
    images = {}
    for kind in ("png", "jpeg", "tiff", "bmp"):
        stream = io.BytesIO()
        (picture if kind == "png" else picture.convert("RGB")).save(stream, format=kind)
        images[f"image.{kind}"] = stream.getvalue()
    box = trimesh.creation.box()
    textured = box.copy()
    textured.visual = trimesh.visual.TextureVisuals(uv=box.vertices[:, :2], image=picture)
    found = {
        "binary.stl": box.export(file_type="stl"),
        "text.stl": box.export(file_type="stl_ascii").encode(),
        "plain.obj": box.export(file_type="obj").encode(),
        "plain.dae": box.export(file_type="dae"),
        "plain.ply": box.export(file_type="ply"),
        "plain.glb": trimesh.Scene([box, textured]).export(file_type="glb"),
        "textured.obj": b"mtllib a.mtl\nusemtl a\n" + textured.export(file_type="obj", include_texture=False).encode(),
        "textured.dae": textured.export(file_type="dae"),
    }
    found["a.mtl"] = b"newmtl a\nKd 0.1 0.2 0.3\nNs 10\nd 0.5\nmap_Kd image.png\n"
    return {**found, **images}


def mesh(folder: Path, rng: random.Random) -> str:
    """Read a mesh or an image and compute the moments of the mesh."""
    from urdfkit.meshes.loader import MeshLoader
    from urdfkit.meshes.mesh_moments import moments
    from urdfkit.meshes.textures import read_texture

    files = dict(_meshes())
    name = rng.choice(list(files))
    content = files[name]
    if name.endswith(".dae") and rng.random() < 0.7:
        content = xml(content.decode(), rng).encode("utf-8", "replace")
    elif name.endswith(".glb") and rng.random() < 0.7:
        content = mutations.glb(content, rng)
    elif name.startswith(("text", "plain.obj", "plain.ply", "a.")) and rng.random() < 0.7:
        content = mutations.words(content, rng)
    else:
        content = mutations.binary(content, rng)
    files[name] = content
    for each in ("a.mtl", *(each for each in files if each.startswith("image."))):
        (folder / each).write_bytes(files[each])
    path = folder / name
    path.write_bytes(content)
    if name.startswith("image."):
        try:
            read_texture(path)
        except (OSError, ValueError):  # documented; callers show a placeholder
            return "refused"
        return "read"
    if name == "a.mtl":
        path = folder / "textured.obj"
        path.write_bytes(files["textured.obj"])
    scale = rng.choice(((1.0, 1.0, 1.0), (0.001, 0.001, 0.001), (1.0, -1.0, 1.0)))
    moments(MeshLoader().load(path, scale, places=rng.random() < 0.3), name)
    return "read"


def parameters(folder: Path, rng: random.Random) -> str:
    """Read a file of parameters or a launch file."""
    from urdfkit.description.control.parameter_yaml import read_settings
    from urdfkit.description.control.ros1_launch import read_launch
    from urdfkit.description.launch.launch_file import read_launch_file
    from urdfkit.description.packages.resolver import Packages

    kind = rng.choice(((".yaml", ".yml"), (".yaml", ".yml"), (".launch", ".launch.xml"), (".launch.py",)))
    original = rng.choice(seeds(*kind))
    text = text_of(original)
    change = {".launch": xml, ".launch.py": mutations.python}.get(kind[0], mutations.yaml)
    path = folder / original.name
    path.write_text(change(text, rng), "utf-8", "replace")
    packages = Packages([original.parent], path)
    if kind[0] == ".yaml":
        launch = folder / "read.launch.yaml"
        launch.write_text("launch:\n" + path.read_text("utf-8"), "utf-8")
        read_launch_file(launch, packages)
        read_settings(path, separator=rng.choice("/."))
    else:
        read_launch_file(path, packages)
        if kind[0] == ".launch":
            read_launch(path, packages)
    return "read"


Case = Callable[[Path, random.Random], str | Counter[str]]
FAMILIES: dict[str, Case] = {
    each.__name__: each for each in (lint, packages, expand, lsp, sdf, mesh, parameters, sim, frames)
}
"""Name → case; it writes a changed file into a folder, reads it, and returns a word for success or several counts."""
PREPARATIONS: dict[str, Callable[[], object]] = {
    "packages": workspaces,
    "sim": prepare_kernels,
    "frames": prepare_kernels,
}
"""Name → function that a process calls before the first case, such as to load compiled code."""
