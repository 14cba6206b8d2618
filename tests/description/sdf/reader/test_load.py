"""Reading worlds: what is read, what is noted, and what is refused, each with its place."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from urdfkit.description.sdf import (
    Ellipsoid,
    Ground,
    Plane,
    Surface,
    World,
    WorldInertial,
    WorldModel,
    WorldShape,
    load_model,
    load_world,
    model_names,
    world_names,
)
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Mesh, Pose, Sphere
from urdfkit.errors import DescriptionError, ResourceError, UrdfkitError, XmlError

WORLDS = Path(__file__).parents[2] / "worlds"


def written(tmp_path: Path, text: str, version: str = "1.6") -> Path:
    path = tmp_path / "test.world"
    path.write_text(f'<sdf version="{version}">\n{text}\n</sdf>\n')
    return path


def world_of(tmp_path: Path, text: str, version: str = "1.6") -> World:
    return load_world(written(tmp_path, f'<world name="w">\n{text}\n</world>', version))


def link_of(tmp_path: Path, text: str, version: str = "1.6") -> WorldModel:
    return world_of(tmp_path, f'<model name="m"><link name="l">\n{text}\n</link></model>', version).models[0]


def geometry_of(tmp_path: Path, text: str) -> object:
    model = link_of(tmp_path, f'<collision name="c"><geometry>{text}</geometry></collision>')
    return [shape.geometry for shape in model.links[0].collisions]


# Worlds


def test_shipped_worlds() -> None:
    empty = load_world("empty")
    assert empty.gravity == (0.0, 0.0, -9.81)
    assert empty.ground == Ground("ground_plane", 0.0, 100.0)
    assert [light.name for light in empty.lights] == ["sun"]
    assert load_world("void") == World("void", (0.0, 0.0, -9.81))
    assert set(world_names()) >= {"cylinders", "empty", "house", "office", "two_buildings", "void"}


def test_the_reader_is_light() -> None:
    code = "import sys, json, urdfkit.description.sdf as w; w.load_world('house'); print(json.dumps(list(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert {"numpy", "pinocchio", "trimesh", "xacro"}.isdisjoint(json.loads(done.stdout))


def test_an_sdf_world_of_includes(tmp_path: Path) -> None:
    world = load_world(
        written(
            tmp_path,
            """<world name="moon"><gravity>0 0 -1.62</gravity>
            <include><uri>model://sun</uri></include>
            <include><uri>model://ground_plane</uri><name>regolith</name><pose>0 0 0.5 0 0 0</pose></include>
            </world>""",
        )
    )
    assert (world.name, world.gravity) == ("moon", (0.0, 0.0, -1.62))
    assert world.ground == Ground("regolith", 0.5, 100.0)
    assert world.notes == ()


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


@pytest.mark.parametrize("change", ["<static>false</static>", "<pose>0 0 0 0.1 0 0</pose>"])
def test_planes_that_are_no_ground(tmp_path: Path, change: str) -> None:
    text = """<model name="p"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>
    </collision></link></model>"""
    assert world_of(tmp_path, text).ground == Ground("p", 0.0, 1.0)
    changed = text.replace("<static>true</static>", change if "static" in change else change + "<static>true</static>")
    assert world_of(tmp_path, changed).ground is None


def test_physics_and_what_is_kept(tmp_path: Path) -> None:
    world = world_of(
        tmp_path,
        """<physics name="slow" type="ode"><max_step_size>0.01</max_step_size></physics>
        <physics name="fast" type="dart" default="1"><max_step_size>0.002</max_step_size>
        <real_time_factor>0</real_time_factor><real_time_update_rate>500</real_time_update_rate><dart/></physics>
        <magnetic_field>1e-5 0 0</magnetic_field><scene><shadows>1</shadows></scene>
        <plugin name="p" filename="gz-sim-physics-system"><a>1</a></plugin>""",
    )
    physics = world.physics
    assert (physics.name, physics.engine, physics.max_step_size) == ("fast", "dart", 0.002)
    assert (physics.real_time_factor, physics.real_time_update_rate) == (0.0, 500.0)
    assert [each.text for each in physics.kept] == ["<dart/>"]
    assert world.magnetic_field == (1e-5, 0.0, 0.0)
    assert world.kept[0].text == "<scene><shadows>1</shadows></scene>"
    assert [plugin.filename for plugin in world.plugins] == ["gz-sim-physics-system"]
    assert world.notes == ()


def test_gravity_inside_physics_of_old_worlds(tmp_path: Path) -> None:
    assert world_of(tmp_path, '<physics type="ode"><gravity>0 0 -3</gravity></physics>', "1.4").gravity == (0, 0, -3)


# Models


@pytest.mark.parametrize(
    ("text", "geometry"),
    [
        ("<box><size>1 2 3</size></box>", Box((1.0, 2.0, 3.0))),
        ("<sphere><radius>0.5</radius></sphere>", Sphere(0.5)),
        ("<cylinder><radius>0.5</radius><length>2</length></cylinder>", Cylinder(0.5, 2.0)),
        ("<capsule><radius>0.5</radius><length>2</length></capsule>", Capsule(0.5, 2.0)),
        ("<ellipsoid><radii>1 2 3</radii></ellipsoid>", Ellipsoid((1.0, 2.0, 3.0))),
        ("<plane><normal>0 3 4</normal><size>7 8</size></plane>", Plane((0.0, 0.6, 0.8), (7.0, 8.0))),
    ],
)
def test_primitives(tmp_path: Path, text: str, geometry: object) -> None:
    assert geometry_of(tmp_path, text) == [geometry]


def test_an_empty_geometry_is_no_shape(tmp_path: Path) -> None:
    assert geometry_of(tmp_path, "<empty/>") == []


def test_defaults_are_sdformats(tmp_path: Path) -> None:
    model = link_of(
        tmp_path, '<collision name="c"><geometry><sphere><radius>1</radius></sphere></geometry></collision>'
    )
    link = model.links[0]
    assert link.inertial == WorldInertial(1.0, Pose(), 1.0, 0.0, 0.0, 1.0, 0.0, 1.0)
    assert link.collisions[0] == WorldShape("c", Sphere(1.0))
    assert link.collisions[0].surface == Surface(1.0, 1.0, kp=1e12, kd=1.0, min_depth=0.0, max_vel=0.01)
    assert (link.gravity, link.self_collide, link.kinematic, model.static) == (True, None, False, False)


def test_a_surface(tmp_path: Path) -> None:
    model = link_of(
        tmp_path,
        """<collision name="c"><laser_retro>7</laser_retro><geometry><box/></geometry><surface>
        <bounce><restitution_coefficient>0.3</restitution_coefficient><threshold>0.1</threshold></bounce>
        <friction><ode><mu>0.2</mu><mu2>0.3</mu2><fdir1>1 0 0</fdir1><slip1>0.01</slip1></ode></friction>
        <contact><collide_bitmask>0x0f</collide_bitmask>
        <ode><kp>1e5</kp><kd>2</kd><min_depth>0.001</min_depth><max_vel>0</max_vel></ode></contact>
        </surface></collision>""",
    )
    shape = model.links[0].collisions[0]
    assert shape.laser_retro == 7.0
    assert shape.geometry == Box((1.0, 1.0, 1.0))
    assert shape.surface == Surface(0.2, 0.3, (1.0, 0.0, 0.0), 0.01, 0.0, 1e5, 2.0, 0.001, 0.0, 0.3, 0.1, 15)


def test_colours(tmp_path: Path) -> None:
    model = link_of(
        tmp_path,
        """<visual name="a"><geometry><box/></geometry><material><ambient>1 0 0 1</ambient></material></visual>
        <visual name="b"><geometry><box/></geometry><transparency>0.5</transparency><material>
        <ambient>1 0 0 1</ambient><diffuse>0 1 0</diffuse></material></visual>
        <visual name="c"><geometry><box/></geometry><material><script><name>Gazebo/Wood</name></script></material>
        </visual>
        <visual name="d"><geometry><box/></geometry></visual>""",
    )
    a, b, c, d = model.links[0].visuals
    assert (a.rgba, a.kept) == ((1.0, 0.0, 0.0, 1.0), ())
    assert (b.rgba, b.transparency) == ((0.0, 1.0, 0.0, 1.0), 0.5)
    assert [each.element.tag for each in b.kept] == ["material"]  # its ambient colour differs
    assert (c.rgba, c.material) == (None, "Gazebo/Wood")
    assert (d.rgba, d.material) == (None, "")


def test_what_hangs_on_a_link_is_kept(tmp_path: Path) -> None:
    model = link_of(
        tmp_path,
        """<sensor name="s" type="ray"><plugin name="p" filename="libgazebo_ros_laser.so"/></sensor>
        <velocity_decay><linear>0.1</linear><angular>0.2</angular></velocity_decay><gravity>0</gravity>
        <light name="lamp" type="spot"><pose>0 0 1 0 0 0</pose><spot><inner_angle>0.5</inner_angle></spot></light>""",
    )
    link = model.links[0]
    assert [each.element.get("type") for each in link.kept] == ["ray"]
    assert (link.damping, link.gravity) == ((0.1, 0.2), False)
    assert (link.lights[0].type, link.lights[0].pose.xyz, link.lights[0].spot[0]) == ("spot", (0.0, 0.0, 1.0), 0.5)


def test_nested_models_are_found(tmp_path: Path) -> None:
    world = world_of(
        tmp_path,
        """<model name="a"><link name="l"/><model name="b"><pose>1 0 0 0 0 0</pose><link name="l">
        <pose>0 2 0 0 0 0</pose></link><link name="m"/>
        <joint name="j" type="fixed"><parent>l</parent><child>m</child></joint></model></model>""",
    )
    (model,) = world.models
    assert [(name, pose.xyz) for name, pose, _ in model.all_links()] == [
        ("l", (0.0, 0.0, 0.0)),
        ("b::l", (1.0, 2.0, 0.0)),
        ("b::m", (1.0, 0.0, 0.0)),
    ]
    assert [prefix + joint.child for prefix, joint in model.all_joints()] == ["b::m"]


def test_automatic_inertia(tmp_path: Path) -> None:
    def body(text: str) -> WorldInertial:
        return link_of(tmp_path, text, "1.11").links[0].inertial

    cube = (
        '<collision name="{}"><pose>{} 0 0 0 0 0</pose><geometry><box><size>1 1 1</size></box></geometry>{}</collision>'
    )
    whole = body('<inertial auto="true"/>' + cube.format("a", 0, ""))
    assert whole == WorldInertial(1000.0, Pose(), *[pytest.approx(v) for v in (1000 / 6, 0, 0, 1000 / 6, 0, 1000 / 6)])
    pair = body(
        '<inertial auto="true"><density>6</density></inertial>'
        + cube.format("a", 0, "")
        + cube.format("b", 2, "<density>18</density>")
    )
    assert pair.mass == pytest.approx(24)
    assert pair.pose.xyz == pytest.approx((1.5, 0.0, 0.0))
    # Parallel axes: 1/6 m a² each, and m d² about the common centre, 1.5 m and 0.5 m away.
    assert pair.iyy == pytest.approx(24 / 6 + 6 * 1.5**2 + 18 * 0.5**2)
    assert pair.ixx == pytest.approx(24 / 6)
    turned = body(
        """<inertial auto="true"/><collision name="c"><pose>0 0 0 0 1.5707963267948966 0</pose><geometry><cylinder>
        <radius>0.1</radius><length>1</length></cylinder></geometry></collision>"""
    )
    assert turned.ixx == pytest.approx(turned.mass / 2 * 0.01)
    assert turned.izz == pytest.approx(turned.mass / 12 * (0.03 + 1))


def test_automatic_inertia_of_round_things(tmp_path: Path) -> None:
    def body(shape: str) -> WorldInertial:
        text = f'<inertial auto="true"/><collision name="c"><geometry>{shape}</geometry></collision>'
        return link_of(tmp_path, text, "1.11").links[0].inertial

    ball = body("<sphere><radius>0.2</radius></sphere>")
    egg = body("<ellipsoid><radii>0.2 0.2 0.2</radii></ellipsoid>")
    assert (egg.mass, egg.ixx, egg.izz) == pytest.approx((ball.mass, ball.ixx, ball.izz))
    assert ball.ixx == pytest.approx(0.4 * ball.mass * 0.04)
    # A capsule without a cylinder is a ball; one that is nearly all cylinder is a cylinder.
    pill = body("<capsule><radius>0.2</radius><length>1e-9</length></capsule>")
    assert (pill.mass, pill.ixx, pill.izz) == pytest.approx((ball.mass, ball.ixx, ball.izz))
    stick = body("<capsule><radius>0.001</radius><length>1</length></capsule>")
    assert stick.ixx == pytest.approx(stick.mass / 12, rel=0.01)


# Files


def test_a_model_alone_is_a_world(tmp_path: Path) -> None:
    world = load_world(written(tmp_path, '<model name="m"><pose>1 0 0 0 0 0</pose><link name="l"/></model>'))
    assert (world.name, world.ground, world.models[0].pose.xyz) == ("m", None, (1.0, 0.0, 0.0))


def test_models_of_the_user_come_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "elsewhere" / "table"
    folder.mkdir(parents=True)
    (folder / "model.config").write_text(
        """<model><sdf version="1.4">old.sdf</sdf><sdf version="1.9">new.sdf</sdf>
        <sdf version="2.0">far.sdf</sdf></model>"""
    )
    (folder / "new.sdf").write_text('<sdf version="1.9"><model name="mine"><link name="l"/></model></sdf>')
    text = "<include><uri>model://table</uri></include>"
    assert world_of(tmp_path, text).models[0].name == "table"
    for variable in ("GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH"):
        with monkeypatch.context() as patch:
            patch.setenv(variable, str(folder.parent))
            assert world_of(tmp_path, text).models[0].name == "mine"
            assert load_world("house").model_by_name["kitchen_table"].links[0].inertial.mass == 24.0
    assert (
        load_world(written(tmp_path, f"<world>{text}</world>"), package_path=[folder.parent]).models[0].name == "mine"
    )


def test_what_stands_in_is_noted(tmp_path: Path) -> None:
    world = world_of(
        tmp_path,
        "<include><uri>model://pine_tree</uri></include><include><uri>model://Coke</uri><name>c</name></include>"
        "<include><uri>model://coke_can/</uri></include><include><uri>model://box</uri></include>",
    )
    assert [model.name for model in world.models] == ["tree", "c", "coke_can", "box"]
    assert [note.partition(": ")[2] for note in world.notes] == [
        "model://pine_tree: the bundled model `tree` is used instead",
        "model://Coke: the bundled model `coke_can` is used instead",
        "model://coke_can/: the bundled model is used instead",
    ]
    assert world.notes[0].startswith(f"{tmp_path}/test.world:3:10: ")


def test_an_include_overrides(tmp_path: Path) -> None:
    world = world_of(
        tmp_path,
        """<include><uri>model://box</uri><name>b</name><static>1</static><pose>1 2 3 0 0 0</pose>
        <plugin name="p" filename="libx.so"/></include>""",
    )
    (model,) = world.models
    assert (model.name, model.static, model.pose.xyz) == ("b", True, (1.0, 2.0, 3.0))
    assert [plugin.filename for plugin in model.plugins] == ["libx.so"]


def test_robots_are_included_as_urdf(tmp_path: Path) -> None:
    world = world_of(
        tmp_path,
        f"""<include><uri>file://{WORLDS}/cart.urdf</uri><pose>1 0 0 0 0 0</pose></include>
        <include><uri>file://{WORLDS}/cart.urdf</uri><name>second</name></include>""",
    )
    assert [(robot.name, robot.pose.xyz[0]) for robot in world.robots] == [("cart", 1.0), ("second", 0.0)]
    assert world.robots[0].file == str(WORLDS / "cart.urdf")


def test_meshes(tmp_path: Path) -> None:
    (tmp_path / "rock.stl").write_text("solid rock\nendsolid rock\n")
    model = link_of(
        tmp_path,
        """<collision name="c"><geometry><mesh><uri>rock.stl</uri><scale>2 2 2</scale></mesh></geometry></collision>
        <visual name="v"><geometry><mesh><uri>rokc.stl</uri></mesh></geometry></visual>""",
    )
    (shape,) = model.links[0].collisions
    assert shape.geometry == Mesh(f"file://{tmp_path}/rock.stl", (2.0, 2.0, 2.0))
    assert shape.file == str(tmp_path / "rock.stl")
    assert model.links[0].visuals == ()
    assert (
        "visual `v` is not shown: no file rokc.stl; did you mean `rock.stl`?"
        in load_world(tmp_path / "test.world").notes[0]
    )


def test_a_mesh_beside_its_model(tmp_path: Path) -> None:
    folder = tmp_path / "models" / "rock"
    (folder / "meshes").mkdir(parents=True)
    (folder / "meshes" / "rock.stl").write_text("solid rock\nendsolid rock\n")
    (folder / "model.sdf").write_text(
        """<sdf version="1.6"><model name="rock"><link name="l"><collision name="c"><geometry><mesh>
        <uri>model://rock/meshes/rock.stl</uri></mesh></geometry></collision></link></model></sdf>"""
    )
    world = world_of(tmp_path, "<include><uri>model://rock</uri></include>")
    (shape,) = world.models[0].links[0].collisions
    assert shape.geometry == Mesh("model://rock/meshes/rock.stl")
    assert shape.file == str(folder / "meshes" / "rock.stl")
    assert [path.name for path in world.files] == ["test.world", "model.sdf"]


def test_load_model(tmp_path: Path) -> None:
    can = load_model("coke_can", name="mine", pose=Pose((1.0, 0.0, 0.0)))
    assert (can.name, can.pose.xyz[0], can.links[0].inertial.mass) == ("mine", 1.0, 0.39)
    path = tmp_path / "m.sdf"
    path.write_text('<sdf version="1.6"><model name="m"><link name="l"/></model></sdf>')
    assert load_model(path).name == "m"
    with pytest.raises(ResourceError, match=r"no model `coke_cam` .*; did you mean `coke_can`"):
        load_model("coke_cam")
    with pytest.raises(DescriptionError, match="an SDF model starts with <sdf>"):
        load_model("sun")


# The state that Gazebo Classic saves


def test_state(tmp_path: Path) -> None:
    world = world_of(
        tmp_path,
        """<model name="cart"><pose>0 0 1 0 0 0</pose><link name="a"/><link name="b"><pose>1 0 0 0 0 0</pose></link>
        </model><model name="gone"><link name="l"/></model><light name="lamp" type="point"/>
        <state world_name="w"><sim_time>1 0</sim_time><deletions><name>gone</name></deletions>
        <insertions><model name="new"><pose>9 0 0 0 0 0</pose><link name="l"/></model></insertions>
        <model name="cart"><pose>5 0 1 0 0 1.570796</pose><scale>1 1 1</scale>
        <link name="a"><pose>5 0 1 0 0 1.570796</pose></link><link name="b"><pose>5 1 2 0 0 1.570796</pose></link>
        </model>
        <model name="nwe"><pose>0 0 0 0 0 0</pose></model>
        <light name="lamp"><pose>0 0 7 0 0 0</pose></light></state>""",
    )
    assert [model.name for model in world.models] == ["cart", "new"]
    cart = world.model_by_name["cart"]
    assert cart.pose == Pose((5.0, 0.0, 1.0), (0.0, 0.0, 1.570796))
    assert cart.links[0].pose == Pose()
    assert cart.links[1].pose.xyz == pytest.approx((1.0, 0.0, 1.0), abs=1e-6)  # the state lifts it
    assert world.lights[0].pose.xyz == (0.0, 0.0, 7.0)
    assert "<state> places the unknown model `nwe`; did you mean `new`?" in world.notes[0]


def test_state_of_nested_models(tmp_path: Path) -> None:
    world = world_of(
        tmp_path,
        """<model name="a"><model name="b"><pose>1 0 0 0 0 0</pose><link name="l"/></model></model>
        <state world_name="w"><model name="a"><pose>0 0 3 0 0 0</pose><model name="b"><pose>1 0 4 0 0 0</pose>
        <link name="l"><pose>1 0 4 0 0 0</pose></link></model></model></state>""",
    )
    nested = world.models[0].models[0]
    assert (world.models[0].pose.xyz, nested.pose.xyz) == ((0.0, 0.0, 3.0), (1.0, 0.0, 1.0))
    assert nested.links[0].pose == Pose()


def test_state_scales_shapes(tmp_path: Path) -> None:
    shapes = {
        "<box><size>1 1 1</size></box>": Box((2.0, 3.0, 4.0)),
        "<sphere><radius>1</radius></sphere>": Sphere(4.0),
        "<cylinder><radius>1</radius><length>1</length></cylinder>": Cylinder(3.0, 4.0),
        "<capsule><radius>1</radius><length>1</length></capsule>": Capsule(3.0, 4.0),
        "<ellipsoid><radii>1 1 1</radii></ellipsoid>": Ellipsoid((2.0, 3.0, 4.0)),
        "<plane><size>1 1</size></plane>": Plane(size=(2.0, 3.0)),
    }
    text = "".join(f'<collision name="{n}"><geometry>{s}</geometry></collision>' for n, s in enumerate(shapes))
    world = world_of(
        tmp_path,
        f"""<model name="m"><link name="l"><pose>1 0 0 0 0 0</pose>{text}</link></model>
        <state world_name="w"><model name="m"><pose>0 0 0 0 0 0</pose><scale>2 3 4</scale></model></state>""",
    )
    (link,) = world.models[0].links
    assert [shape.geometry for shape in link.collisions] == list(shapes.values())
    assert link.pose.xyz == (1.0, 0.0, 0.0)


# What is noted


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("<lihgt/>", "unknown element <lihgt> in <world> is ignored; did you mean <light>?"),
        (
            '<model name="m"><link name="l"><colision/></link></model>',
            "unknown element <colision> in <link> is ignored",
        ),
        (
            '<plugin name="p" filename="libgazebo_ros_factroy.so"/>',
            "in the world is ignored; did you mean `gazebo_ros_f",
        ),
        (
            '<model name="m"><link name="l"/><plugin name="p" filename="libgazebo_ros_diff_driver.so"/></model>',
            "`libgazebo_ros_diff_driver.so` in model `m` is ignored; did you mean `gazebo_ros_diff_drive`?",
        ),
        ('<actor name="a"/>', "actors are not simulated"),
        ('<population name="p"/>', "populations are not simulated"),
    ],
)
def test_notes(tmp_path: Path, text: str, reported: str) -> None:
    (note,) = world_of(tmp_path, text).notes
    assert reported in note
    assert note.startswith(f"{tmp_path}/test.world:3:")


def test_prefixed_elements_and_known_plugins_are_no_remark(tmp_path: Path) -> None:
    text = """<experimental:x/><plugin filename="libgazebo_ros_init.so" name="i"/>
    <plugin name="gz::sim::systems::Physics" filename="ignition-gazebo-physics-system"/><model name="m"><link name="l"/>
    <plugin name="d" filename="libgazebo_ros_diff_drive.so"/></model>"""
    assert world_of(tmp_path, text).notes == ()


def test_a_newer_version_is_noted(tmp_path: Path) -> None:
    (note,) = world_of(tmp_path, "", "1.12").notes
    assert "SDF 1.12 is newer than 1.11" in note


# What is refused


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("<gravity>0 0</gravity>", "<gravity> is `0 0`; it must be 3 finite numbers"),
        ("<gravity>0 0 nan</gravity>", "<gravity> is `0 0 nan`"),
        ("<gravity>0,0,-9.8</gravity>", "<gravity> is `0,0,-9.8`; it must be 3 finite numbers (write a decimal point"),
        ("<physics><max_step_size>0</max_step_size></physics>", "<max_step_size> is 0 s; it must be greater than zero"),
        ("<include/>", "<include> has no <uri>"),
        ("<include><uri>model://taable</uri></include>", "or among the bundled models; did you mean `table`?"),
        ("<include><uri>http://x.org/a.sdf</uri></include>", "nothing is downloaded; download it"),
        (
            "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Coke</uri></include>",
            "nothing is downloaded; use the bundled model://coke_can",
        ),
        ("<include><uri>model://box</uri><placement_frame>l</placement_frame></include>", "requires a <pose>"),
        (
            '<include merge="true"><uri>model://box</uri></include>',
            'merge="true" is supported only for models inside models',
        ),
        ('<light name="l" type="sopt"/>', "unknown type `sopt` of light `l`; did you mean `spot`?"),
        ("<model/>", "<model> has no name"),
        ('<model name="m"/>', "model `m` has no link; add a link or make the model <static>"),
        ('<model name="m"><static>yes</static></model>', "<static> is `yes`; it must be true or false"),
        ('<model name="m"><pose>1 2 3</pose></model>', "<pose> is `1 2 3`; it must be 6 finite numbers"),
        (
            '<model name="m"><pose rotation_format="quat_xyzw">0 0 0 0 0 0 0</pose></model>',
            "quaternion of <pose> is zero",
        ),
        ('<model name="m"><pose rotation_format="q">0 0 0 0 0 0 0</pose></model>', "rotation_format is `q`"),
        (
            '<model name="m"><link name="l"><inertial><mass>0</mass></inertial></link></model>',
            "link `l` of model `m` cannot move: its mass is 0 kg",
        ),
        (
            '<model name="m"><link name="l"><inertial><inertia><ixy>2</ixy></inertia></inertial></link></model>',
            "its inertia tensor is not positive definite",
        ),
        (
            '<model name="m"><link name="l"><inertial auto="true"/></link></model>',
            "has no collision to compute its inertia",
        ),
        (
            '<model name="m"><link name="l"/><joint name="j" type="revolut"><parent>l</parent></joint></model>',
            "unknown type `revolut` of joint `j`; did you mean `revolute`?",
        ),
        (
            '<model name="m"><link name="l"/><joint name="j" type="fixed"><parent>world</parent></joint></model>',
            "joint `j` has no <child>",
        ),
        (
            """<model name="m"><link name="lid"/>
            <joint name="j" type="fixed"><parent>world</parent><child>lit</child></joint></model>""",
            "no frame `lit` in model `m`; did you mean `lid`?",
        ),
        (
            """<model name="m"><link name="l"/>
            <joint name="j" type="fixed"><parent>l</parent><child>l</child></joint></model>""",
            "joint `j` connects link `l` to itself",
        ),
        (
            """<model name="m"><link name="l"/>
            <joint name="j" type="revolute"><parent>world</parent><child>l</child></joint></model>""",
            "joint `j` has no <axis>",
        ),
        (
            """<model name="m"><link name="l"/></model>
            <state world_name="w"><model name="m"><scale>2 0 1</scale></model></state>""",
            "<scale> of model `m` must be greater than zero",
        ),
    ],
)
def test_what_is_refused_is_named_with_its_place(tmp_path: Path, text: str, reported: str) -> None:
    with pytest.raises(UrdfkitError) as caught:
        world_of(tmp_path, text)
    assert reported in str(caught.value)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith((f"{tmp_path}/test.world:3:", f"{tmp_path}/test.world:4:"))


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("<heightmap><uri>a.png</uri></heightmap>", "<heightmap> cannot be simulated; model the ground as boxes"),
        ("<polyline/>", "<polyline> cannot be simulated; extrude it"),
        ("<mesh><uri>a.stl</uri><submesh><name>s</name></submesh></mesh>", "<submesh> of a collision is not read"),
        ("<mesh/>", "<mesh> has no <uri>"),
        ("<sphere/>", "<sphere> has no <radius>"),
        ("<sphere><radius>-1</radius></sphere>", "<radius> is -1; it must be greater than zero"),
        ("<box><size>1 0 1</size></box>", "<size> is `1 0 1`; every edge must be longer than zero"),
        ("<plane><normal>0 0 0</normal></plane>", "<normal> of <plane> is zero"),
        ("<bxo/>", "unknown geometry <bxo>; did you mean `box`?"),
    ],
)
def test_shapes_that_are_refused(tmp_path: Path, text: str, reported: str) -> None:
    with pytest.raises(UrdfkitError) as caught:
        geometry_of(tmp_path, text)
    assert reported in str(caught.value)
    assert str(caught.value).startswith(f"{tmp_path}/test.world:4:")


def test_a_collision_whose_mesh_is_not_there_is_noted_with_its_place_and_names_no_file(tmp_path: Path) -> None:
    text = """<model name="m"><static>1</static><link name="l"><collision name="hull"><geometry><mesh>
    <uri>nowhere.stl</uri></mesh></geometry></collision></link></model>"""
    world = world_of(tmp_path, text)
    (note,) = world.notes
    assert note == (f"{tmp_path}/test.world:4:5: no file nowhere.stl; collision `hull` is ignored: it has no contacts")
    (shape,) = world.models[0].links[0].collisions
    assert isinstance(shape.geometry, Mesh)
    assert shape.file == ""


def test_static_things_need_no_mass(tmp_path: Path) -> None:
    text = """<model name="m"><static>1</static><model name="n"><link name="l"><inertial><mass>0</mass></inertial>
    </link></model></model>"""
    assert world_of(tmp_path, text).models[0].models[0].links[0].inertial.mass == 0.0


def test_files_that_include_each_other(tmp_path: Path) -> None:
    for name, other in (("a", "b"), ("b", "a")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "model.sdf").write_text(
            f'<sdf version="1.9"><model name="{name}"><include><uri>model://{other}</uri></include></model></sdf>'
        )
    with pytest.raises(DescriptionError, match=r"b/model\.sdf:1:\d+: .*a/model\.sdf includes itself"):
        world_of(tmp_path, "<include><uri>model://a</uri></include>")


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("<sdf><world", r"bad\.sdf:1:"),
        ('<!DOCTYPE sdf [<!ENTITY a "b">]><sdf version="1.6"/>', "declares the entity `a`"),
        ('<!DOCTYPE sdf SYSTEM "/etc/passwd"><sdf version="1.6"/>', "external entities are rejected"),
    ],
)
def test_hostile_and_broken_files(tmp_path: Path, text: str, reported: str) -> None:
    path = tmp_path / "bad.sdf"
    path.write_text(text)
    with pytest.raises(XmlError, match=reported):
        load_world(path)


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("<robot/>", "an SDF world starts with <sdf>"),
        ('<sdf version="1.6"/>', "an SDF world starts with <sdf>"),
        ('<sdf><world name="w"/></sdf>', "<sdf> has no version"),
        ('<sdf version="1.3"><world name="w"/></sdf>', "SDF 1.3 is not supported; supported versions are 1.4 to 1.11"),
        ('<sdf version="new"><world name="w"/></sdf>', "version `new` is not a version of SDF"),
    ],
)
def test_wrong_files(tmp_path: Path, text: str, reported: str) -> None:
    path = tmp_path / "bad.sdf"
    path.write_text(text)
    with pytest.raises(DescriptionError, match=reported):
        load_world(path)


def test_wrong_worlds(tmp_path: Path) -> None:
    with pytest.raises(ResourceError, match="no world `emty`; did you mean `empty`"):
        load_world("emty")
    with pytest.raises(ResourceError, match=r"no such file: .*nowhere\.sdf"):
        load_world(tmp_path / "nowhere.sdf")


# What we ship


def test_moving_models_weigh_what_their_bodies_can() -> None:
    assert len(model_names()) >= 40
    for name in set(model_names()) - {"sun"}:
        model = load_model(name)
        assert model.name == name
        if model.static:
            continue
        (link,) = model.links
        body = link.inertial
        assert 0 < body.mass < 200
        moments = sorted((body.ixx, body.iyy, body.izz))
        assert moments[0] + moments[1] > moments[2] * (1 - 1e-9), name
        # No moment of inertia about the centre of mass exceeds that of all mass at the edge of the shapes.
        assert moments[2] < body.mass * 1.5**2, name
        assert all(shape.surface.mu <= 1 for shape in link.collisions)


def test_the_pillars_stand_in_a_ring() -> None:
    pillars = [model for model in load_world("cylinders").models if model.name.startswith("pillar")]
    assert len(pillars) == 8
    for pillar in pillars:
        x, y, _ = pillar.pose.xyz
        assert x * x + y * y == pytest.approx(9.0)
        assert pillar.static
        assert pillar.links[0].collisions[0].geometry == Cylinder(0.25, 1.0)


@pytest.mark.parametrize("name", ["house", "office", "two_buildings"])
def test_there_is_room_for_a_robot_at_the_origin(name: str) -> None:
    for model in load_world(name).models:
        for _, pose, link in model.all_links():
            for shape in link.collisions:
                if isinstance(shape.geometry, Box):
                    x, y = (model.pose.xyz[i] + pose.xyz[i] + shape.pose.xyz[i] for i in range(2))
                    width, depth = shape.geometry.size[:2]
                    assert abs(x) > width / 2 + 0.5 or abs(y) > depth / 2 + 0.5, model.name


def test_two_buildings_and_ten_objects() -> None:
    names = [model.name for model in load_world("two_buildings").models]
    buildings = [name for name in names if name.startswith("building")]
    assert len(buildings) == 2
    assert len(names) - len(buildings) - 1 == 10


@pytest.mark.parametrize(
    ("name", "text", "reported"),
    [
        ("house.world", None, "house.world; did you mean the bundled world `house`?"),
        ("cart.urdf", "<robot/>", "is a robot, not a world; pass it as ROBOT"),
        ("cart.sdf", "<robot/>", "cart.sdf:1:1: this is a robot; an SDF world starts with <sdf>"),
        ("", None, "is a folder; a world is a .world or .sdf file"),
        ("large.sdf", "<sphere><radius>1e300</radius></sphere>", "<sphere> is 1e+300 m large; at most 1e+06 m"),
        (
            "flat.sdf",
            "<cone><radius>1</radius><length>0</length></cone>",
            "<length> is 0; it must be greater than zero",
        ),
    ],
)
def test_what_newcomers_take_for_a_world(tmp_path: Path, name: str, text: str | None, reported: str) -> None:
    path = tmp_path / name
    if text is not None:
        shape = f'<collision name="c"><geometry>{text}</geometry></collision>'
        model = f'<sdf version="1.9"><model name="m"><link name="l">{shape}</link></model></sdf>'
        path.write_text(text if text == "<robot/>" else model)
    with pytest.raises(UrdfkitError) as caught:
        load_world(path)
    assert reported in str(caught.value)
    assert "\n" not in str(caught.value)


def test_wind_and_pace_are_kept_with_a_remark(tmp_path: Path) -> None:
    path = tmp_path / "windy.sdf"
    inside = "<wind><linear_velocity>1 0 0</linear_velocity></wind><physics><real_time_factor>0.5</real_time_factor>"
    path.write_text(f'<sdf version="1.9"><world name="w">{inside}</physics></world></sdf>')
    world = load_world(path)
    assert [note.partition(": ")[2][:21] for note in world.notes] == ["wind is not simulated", "<real_time_factor> 0."]
    assert world.physics.real_time_factor == 0.5
