"""World objects: spawn, move, remove and save the objects of the world, and draw walls."""

from pathlib import Path
from tempfile import TemporaryDirectory

from urdfkit.app.simulation.features.feature import Done, Feature, Takes
from urdfkit.app.simulation.features.wall_model import MOST, walls
from urdfkit.errors import SimulationError
from urdfkit.sim.state.quaternion import to_rpy
from urdfkit.view.protocol.page_requests import Request, Schema, listing, number, numbers, record, text, whole

NAME = 80
"""Maximum length of a name [characters]."""
MAX_OBJECTS = 500
"""Maximum number of models and robots in a world that is built on the page."""


class WorldObjects(Feature):
    """The model library, and the entities of the world."""

    @property
    def takes(self) -> Takes:
        """The supported requests."""
        pose = numbers(3, 7, bound=1e4)
        door = record(segment=whole(0, 200), at=number(0, MOST, unit="m"), width=number(0.2, 20, unit="m"))
        corners = listing(numbers(2, bound=MOST, unit="m"), 2, 200, "corners")
        sizes = {"name": text(NAME), "height": number(0.05, 20, unit="m"), "thickness": number(0.02, 2, unit="m")}
        return {
            "spawn": (Schema({"model": text(NAME)}, {"pose": pose, "name": text(NAME)}), self._spawn),
            "place": (Schema({"name": text(), "pose": pose}), self._place),
            "remove": (Schema({"name": text()}), self._remove),
            "get_pose": (Schema({"name": text()}, changes=False), self._where),
            "walls": (Schema({"corners": corners}, {**sizes, "doors": listing(door, 0, 50, "doors")}), self._walls),
            "save": (Schema({}, {"name": text(NAME)}, changes=False), self._save),
        }

    def show(self) -> None:
        """Publish the entities of the world and the library."""
        from urdfkit.description.sdf import model_names
        from urdfkit.resources import robot_names

        world = self.simulator.world
        rows = []
        for name in world.names:
            first = name == self.simulator.name
            robot = first or any(each.has_plugins for each in world.builder.entity(name).robots)
            rows.append({"name": name, "robot": robot, "first": first, "static": world.is_static(name)})
        self.server.publish_latched(
            "objects",
            objects=rows,
            models=[name for name in model_names() if name not in ("sun", "ground_plane")],
            robots=robot_names(),
            world=world.name,
        )

    def _spawn(self, request: Request) -> Done:
        name, model = request.values.get("name") or None, request.values["model"]
        self._require_plain(model)  # by name only: a page must not read files of this machine
        if len(self.simulator.world.names) >= MAX_OBJECTS:
            raise SimulationError(f"the world has {MAX_OBJECTS} objects, the maximum; remove one first")
        pose = request.values.get("pose")
        from urdfkit.resources import robot_names
        from urdfkit.sim import Spawn

        if pose is not None and model in robot_names():
            # On the ground at this position.
            found = self.simulator.world.spawn(
                model, Spawn(x=pose[0], y=pose[1], yaw=pose[-1] if len(pose) in (4, 6) else 0.0), name=name
            )
        else:
            found = self.simulator.world.spawn(model, pose, name=name)
        return {"name": found}

    def _require_plain(self, model: str) -> None:
        if "/" in model or "\\" in model or "." in model or ":" in model:
            raise SimulationError(f"unknown model or robot `{model}`")

    def _place(self, request: Request) -> Done:
        name, pose = request.values["name"], request.values["pose"]
        world = self.simulator.world
        if name == world.names[0] and not self.simulator.kinematics.floating_base:
            raise SimulationError(f"`{name}` has a fixed base and cannot be moved")
        self.simulator.world.place(name, pose)
        return None

    def _remove(self, request: Request) -> Done:
        self.simulator.world.remove(request.values["name"])
        return None

    def _where(self, request: Request) -> Done:
        pose = self.simulator.world.pose(request.values["name"])
        return {"pose": [*pose[:3], *to_rpy(pose[3:])]}

    def _walls(self, request: Request) -> Done:
        from urdfkit.sim.world.spawn_requests import spawn_request_of_text

        values = request.values
        name = values.get("name") or self.simulator.world.free_name("walls")
        if not name.replace("_", "").replace("-", "").isalnum():
            raise SimulationError(f"`{name}` is not a name for walls: use letters, digits, _ and -")
        document = walls(
            name,
            values["corners"],
            values.get("doors", ()),
            height=values.get("height", 2.5),
            thickness=values.get("thickness", 0.15),
        )
        return {"name": self.simulator.world.spawn(spawn_request_of_text(document))}

    def _save(self, request: Request) -> Done:
        name = request.values.get("name") or self.simulator.world.name or "world"
        safe = "".join(each if each.isalnum() or each in "-_" else "_" for each in name) or "world"
        with TemporaryDirectory() as folder:
            file = Path(folder) / f"{safe}.sdf"
            self.simulator.world.save(file)
            content = file.read_bytes()
        self.server.send_file(request, file.name, content)
        return {"bytes": len(content)}
