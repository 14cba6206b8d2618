"""Only meshes and pictures from around the description are copied into a package that somebody may publish."""

import json
import struct

import pytest

from urdfkit.cli import main
from urdfkit.scaffold.wrap.accepted_assets import rejection
from urdfkit.scaffold.wrap.mesh_assets import Meshes

STL = b"\0" * 80 + struct.pack("<I", 1) + b"\0" * 50


def urdf(mesh):
    visual = f'<visual><geometry><mesh filename="{mesh}"/></geometry></visual>'
    return f'<robot name="arm">\n  <link name="base">\n    {visual}\n  </link>\n</robot>\n'


@pytest.fixture
def download(tmp_path, monkeypatch):
    """A URDF in a folder of its own, and files of the user elsewhere."""
    (tmp_path / "private").mkdir()
    (tmp_path / "private/hostname").write_text("secret")
    (tmp_path / "private/key.stl").write_text("-----BEGIN KEY-----\nsolid\n")
    (tmp_path / "private/part.stl").write_bytes(STL)
    folder = tmp_path / "a/b/download"
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    return folder


@pytest.mark.parametrize(
    ("mesh", "says"),
    [
        ("../../../private/hostname", "outside the folders of the robot"),
        ("../../../private/part.stl", "outside the folders of the robot: copy the file there, or use --meshes DIR"),
        ("file://@/private/part.stl", "outside the folders of the robot"),
        ("@/private/part.stl", "outside the folders of the robot"),
        ("private/part.stl", "outside the folders of the robot"),
        ("package://private/part.stl", "outside the folders of the robot"),
        ("link.stl", "outside the folders of the robot"),
        ("notes", "has no suffix"),
        ("notes.txt", "has the unsupported suffix `.txt`"),
        ("key.stl", "is not an STL"),
        ("key.dae", "is not a DAE"),
        ("key.png", "is not a PNG"),
        ("key.bin", "is a text file"),
        ("pointer.stl", "is a Git LFS pointer: run `git lfs pull`"),
    ],
)
def test_what_is_no_mesh_of_the_robot_is_refused(download, capsys, mesh, says):
    home = download.parents[2]
    (download / "link.stl").symlink_to(home / "private/part.stl")
    for name in ("notes", "notes.txt", "key.stl", "key.dae", "key.png", "key.bin"):
        (download / name).write_text("-----BEGIN KEY-----\n" * 20)
    (download / "pointer.stl").write_text("version https://git-lfs.github.com/spec/v1\n")
    (download / "arm.urdf").write_text(urdf(mesh.replace("@", str(home))))
    assert main(["import", "arm.urdf", "--into", "src"]) == 2
    reported = capsys.readouterr()
    assert reported.err.startswith("urdfkit: arm.urdf:3: the mesh `")
    assert reported.err.endswith("; nothing was written\n")
    assert says in reported.err
    assert reported.err.count("\n") == 1
    assert not (download / "src").exists()


def test_a_folder_that_is_named_may_be_anywhere(download):
    (download / "arm.urdf").write_text(urdf("package://gone/part.stl"))
    assert main(["import", "arm.urdf", "--into", "src", "--meshes", "../../../private"]) == 0
    assert (download / "src/arm_description/meshes/part.stl").read_bytes() == STL


def test_packages_of_the_same_workspace_are_near(download):
    for package in ("one", "two"):
        (download / package / "urdf").mkdir(parents=True)
        (download / package / "meshes").mkdir()
        (download / package / "package.xml").write_text(f"<package><name>{package}</name></package>")
        (download / package / "meshes/part.stl").write_bytes(STL)
    for mesh in ("../../two/meshes/part.stl", "package://two/meshes/part.stl", "../meshes/part.stl"):
        meshes = Meshes(download / "one/urdf/arm.urdf")
        assert meshes.uri(mesh, "arm") == "package://arm/meshes/part.stl", meshes.refused


def test_what_a_mesh_names_is_held_to_the_same(download, capsys):
    private = download.parents[2] / "private"
    (download / "tex").mkdir()
    (download / "tex/a.png").symlink_to(private / "hostname")
    (download / "tex/b.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    (download / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (download / "a.mtl").write_text("newmtl m\nmap_Kd tex/a.png\nmap_Ks tex/b.png\n")
    (download / "arm.urdf").write_text(urdf("a.obj"))
    assert main(["import", "arm.urdf", "--into", "src"]) == 0
    reported = capsys.readouterr().out
    assert f"not copied: {private / 'hostname'}: outside the folders of the robot" in reported
    meshes = download / "src/arm_description/meshes"
    assert sorted(path.name for path in meshes.rglob("*") if path.is_file()) == ["a.mtl", "a.obj", "b.png"]


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.STL", STL),
        ("a.stl", b"solid x\nfacet normal 0 0 1\n"),
        ("a.stl", STL[:-10]),  # cut off: what lint states
        ("a.dae", b'<?xml version="1.0"?>\n<COLLADA xmlns="x">'),
        ("a.dae", '<?xml version="1.0" encoding="utf-16"?><COLLADA>'.encode("utf-16")),
        ("a.obj", b"# by hand\n" * 5000 + b"v 0 0 1\n"),
        ("a.glb", b"glTF\2\0\0\0"),
        ("a.gltf", json.dumps({"asset": {"version": "2.0"}}).encode()),
        ("a.ply", b"ply\nformat ascii 1.0\n"),
        ("a.jpg", b"\xff\xd8\xff\xe0"),
        ("a.bin", b"\0\0\x80\x3f"),
        ("a.mtl", b"# x\nnewmtl a\n"),
    ],
)
def test_meshes_are_known(tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    assert rejection(tmp_path / name) == ""
