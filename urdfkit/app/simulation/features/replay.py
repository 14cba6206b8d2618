"""Replay: record all poses in memory, show them again at any time and speed; record topics as MCAP."""

from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.app.simulation.features.feature import Done, Feature, Takes
from urdfkit.bridges.recorder import Recorder
from urdfkit.bus import Bus, Topic
from urdfkit.errors import SimulationError
from urdfkit.sim.simulator import Simulator
from urdfkit.view.protocol.page_requests import Request, Schema, choice, flag, number
from urdfkit.view.server.server import Server

MOST_BYTES = 96 * 1024 * 1024
"""Maximum size of the recorded poses; the recording stops there."""
MOST_HANDED = 48 * 1024 * 1024
"""Maximum size of a recording that is sent to the page; a larger one is saved in the working directory."""
LARGE = ("sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/PointCloud")
"""Types of messages that are recorded only on request."""
FRAME_RATE = 60.0
"""Recorded frames per simulated second [Hz]."""


class Replay(Feature):
    """Recording and replay.

    Attributes:
        playing: whether the page shows the recording.
    """

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._times: list[float] = []
        self._frames: list[NDArray[np.float32]] = []
        self._bytes = 0
        self._recording = False
        self._revision = -1
        self._at = 0.0
        self._since: tuple[float, float] | None = None
        self._speed = 1.0
        self.playing = False
        self._recorder: Recorder | None = None
        self._folder = ExitStack()

    @property
    def takes(self) -> Takes:
        """The supported requests."""
        replay = {"at": number(0), "speed": number(0.05, 200)}
        return {
            "record": (Schema({"on": flag}, {"topics": flag, "pictures": flag}), self._record),
            "replay": (Schema({"action": choice("show", "play", "pause", "end")}, replay), self._replay),
        }

    def show(self) -> None:
        """Publish the state of the recording."""
        self.server.publish_latched("recorder", **self._state())

    def _state(self) -> dict[str, Any]:
        begin, end = (self._times[0], self._times[-1]) if self._times else (0.0, 0.0)
        return {
            "recording": self._recording,
            "topics": self._recorder is not None,
            "begin": begin,
            "end": end,
            "frames": len(self._times),
            "playing": self.playing,
            "running": self.playing and self._since is not None,
            "at": self._at,
        }

    # Recording

    def keep(self, t: float, poses: NDArray[np.float64], revision: int) -> None:
        """Record the poses, while recording."""
        if not self._recording or self.playing:
            return
        if revision != self._revision or (self._times and t < self._times[-1]):
            self._stop("an entity was spawned or removed" if revision != self._revision else "the simulation was reset")
            return
        if self._times and t - self._times[-1] < 0.9 / FRAME_RATE:
            return
        frame = poses.astype(np.float32)
        self._times.append(t)
        self._frames.append(frame)
        self._bytes += frame.nbytes + 64
        if self._bytes > MOST_BYTES:
            self._stop(f"the memory limit was reached after {self._times[-1] - self._times[0]:.0f} s")

    def _record(self, request: Request) -> Done:
        if not request.values["on"]:
            if not self._recording:
                raise SimulationError("nothing is being recorded")
            response = self._end_topics(request)
            self._recording = False
            self.show()
            return response
        if self._recording:
            raise SimulationError("a recording is running already")
        self._times, self._frames, self._bytes = [], [], 0
        self.playing, self._revision = False, self.simulator.world.revision
        if request.values.get("topics"):
            from urdfkit.app.simulation.bridging.description_text import publish_description

            publish_description(self.simulator)  # `replay` then needs no robot
            folder = self._folder.enter_context(TemporaryDirectory())
            bus: Any = self.simulator.bus if request.values.get("pictures") else WithoutPictures(self.simulator.bus)
            self._recorder = Recorder(bus, Path(folder) / "recording.mcap", lambda: self.simulator.t)
        self._recording = True
        self.show()
        return None

    def _stop(self, reason: str) -> None:
        self._recording = False
        self.server.broadcast("notice", text=f"the recording was stopped: {reason}", tone="")
        if self._recorder is not None:
            self._leave(self._recorder, f"recording-{self.simulator.name}.mcap")
        self.show()

    def _end_topics(self, request: Request) -> Done:
        recorder = self._recorder
        if recorder is None:
            return None
        name = f"{self.simulator.name}.mcap"
        recorder.subscribe_new_topics()
        recorder.close()
        size = recorder.path.stat().st_size
        if size > MOST_HANDED:
            return {"file": self._leave(recorder, name), "messages": recorder.count}
        self.server.send_file(request, name, recorder.path.read_bytes())
        self._recorder = None
        self._folder.close()
        return {"messages": recorder.count, "bytes": size}

    def _leave(self, recorder: Recorder, name: str) -> str:
        """Move a recording to the working directory under an unused name; return the name."""
        import shutil

        recorder.subscribe_new_topics()
        recorder.close()
        stem, k = Path(name).stem, 1
        while Path(name).exists():
            name, k = f"{stem}-{k}.mcap", k + 1
        shutil.move(recorder.path, name)
        text = f"the recording was saved as {name} in the folder in which urdfkit was started"
        self.server.broadcast("notice", text=text, tone="good")
        self._recorder = None
        self._folder.close()
        return name

    # Replay

    def _replay(self, request: Request) -> Done:
        action, values = request.values["action"], request.values
        if action == "end":
            self.playing, self._since = False, None
            self.show()
            return None
        if self._recording:
            raise SimulationError("stop the recording first")
        if not self._times:
            raise SimulationError("nothing has been recorded yet")
        if self.simulator.world.revision != self._revision:
            raise SimulationError("the recording cannot be shown: entities were spawned or removed after it was made")
        if not self.playing:
            self._at = self._times[0]
        if self._since is not None:
            self._advance()
        if "at" in values:
            self._at = min(max(values["at"], self._times[0]), self._times[-1])
        self._speed = values.get("speed", self._speed)
        if action == "play" and self._at >= self._times[-1]:
            self._at = self._times[0]
        self._since = (self.clock(), self._at) if action == "play" else None
        self.playing = True
        self.show()
        return None

    def picture(self) -> tuple[float, NDArray[np.float32]]:
        """Return the time [s] and the frame of the recording to show now."""
        if self._since is not None:
            self._advance()
        index = int(np.searchsorted(self._times, self._at, side="right")) - 1
        if self.is_due(0.2):
            self.server.broadcast("recorder", **self._state())
        return self._at, self._frames[max(0, index)]

    def _advance(self) -> None:
        assert self._since is not None
        begun, at = self._since
        self._at = at + (self.clock() - begun) * self._speed
        if self._at >= self._times[-1]:
            self._at, self._since = self._times[-1], None
            self.show()

    def tick(self) -> None:
        """Subscribe to new topics, and publish the state of the recording."""
        if self._recorder is not None:
            self._recorder.subscribe_new_topics()
        if self._recording and self.is_due(0.5):
            self.server.broadcast("recorder", **self._state())

    def forget(self) -> None:
        """Show the simulation again."""
        self.playing, self._since = False, None

    def close(self) -> None:
        """Save a running recording, and clean up."""
        if self._recorder is not None:
            self._leave(self._recorder, f"{self.simulator.name}.mcap")
        self._folder.close()


class WithoutPictures:
    """View of a bus for a recorder, without topics of large messages.

    Args:
        bus: the bus.
    """

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self.subscribe = bus.subscribe

    @property
    def topics(self) -> tuple[Topic, ...]:
        """The topics without large messages."""
        return tuple(topic for topic in self._bus.topics if topic.type not in LARGE)
