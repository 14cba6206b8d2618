"""World objects: spawn, move, remove and save the objects of the world, and draw walls."""

from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from urdfkit.app.simulation.features.feature import Done, Feature, Takes
from urdfkit.app.simulation.features.wall_model import MOST, walls
from urdfkit.description.sdf import WorldRobot
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.sim.simulator import Simulator
from urdfkit.sim.state.quaternion import to_rpy
from urdfkit.sim.world.spawn_requests import SpawnRequest, spawn_request_of_text
from urdfkit.view.protocol.page_requests import Request, Schema, listing, number, numbers, record, text, whole
from urdfkit.view.server.server import Server

NAME = 80
"""Maximum length of a name [characters]."""
MAX_OBJECTS = 500
"""Maximum number of models and robots in a world that is built on the page."""
Copy = tuple[SpawnRequest, Sequence[float], bool]
"""Description and pose of an entity, and whether the base of a robot is fixed to the world."""


class WorldObjects(Feature):
    """The model library, and the entities of the world."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._removed: dict[str, Copy] = {}

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
            "restore": (Schema({"name": text()}), self._restore),
            "duplicate": (Schema({"name": text(), "pose": pose}), self._duplicate),
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
        self._require_room()
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
        name = request.values["name"]
        copies = {} if name == self.simulator.name else {name: self._copy(name)}
        self.simulator.world.remove(name)
        self._removed.update(copies)
        while len(self._removed) > MAX_OBJECTS:
            del self._removed[next(iter(self._removed))]
        return None

    def _restore(self, request: Request) -> Done:
        """Insert a removed entity again, where it was."""
        name = request.values["name"]
        if name not in self._removed:
            raise SimulationError(f"`{name}` was not removed from this world{did_you_mean(name, self._removed)}")
        return {"name": self._insert(*self._removed[name], name)}

    def _duplicate(self, request: Request) -> Done:
        name = request.values["name"]
        if name == self.simulator.name:
            raise SimulationError(f"`{name}` is the robot of this simulation; insert another one from the library")
        source, _, fixed = self._copy(name)
        return {"name": self._insert(source, request.values["pose"], fixed, self.simulator.world.free_name(name))}

    def _copy(self, name: str) -> Copy:
        world = self.simulator.world
        pose = world.pose(name)
        if name in world.spawned:
            source, _, fixed = world.spawned[name]
            return source, pose, fixed
        entity = world.builder.entity(name)
        assert entity.source is not None  # only the simulation's own robot has none
        robot = entity.robots[0].kinematics.robot if isinstance(entity.source, WorldRobot) and entity.robots else None
        return SpawnRequest(entity.source, robot), pose, False

    def _insert(self, source: SpawnRequest, pose: Sequence[float], fixed: bool, name: str) -> str:
        self._require_room()
        return self.simulator.world.spawn(source, pose, name=name, fixed_base=fixed)

    def _require_room(self) -> None:
        if len(self.simulator.world.names) >= MAX_OBJECTS:
            raise SimulationError(f"the world has {MAX_OBJECTS} objects, the maximum; remove one first")

    def _where(self, request: Request) -> Done:
        pose = self.simulator.world.pose(request.values["name"])
        return {"pose": [*pose[:3], *to_rpy(pose[3:])]}

    def _walls(self, request: Request) -> Done:
        values = request.values
        name = values.get("name") or self.simulator.world.free_name("walls")
        if not name.replace("_", "").replace("-", "").isalnum():
            raise SimulationError(f"`{name}` is not a valid name for walls: use letters, digits, _ and -")
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
