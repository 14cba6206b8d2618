"""The services of simulation_interfaces, by a client of rosbridge that has never seen urdfkit."""

from __future__ import annotations

import json
from collections.abc import Iterator
from threading import Thread
from typing import Any

import numpy as np
import pytest
import websocket

from urdfkit.app.simulation.bridging.bridges import BridgeOptions, bridged
from urdfkit.app.simulation.bridging.real_time import RunControls, advance_in_real_time
from urdfkit.bridges.websocket.address import Address
from urdfkit.sim import Simulator

BOX = """<sdf version="1.6"><model name="box"><link name="body"><collision name="c"><geometry>
<box><size>0.2 0.2 0.2</size></box></geometry></collision></link></model></sdf>"""


class Client:
    """Calls services over a WebSocket and returns their responses."""

    def __init__(self, url: str) -> None:
        self._socket = websocket.create_connection(url, timeout=60.0)

    def call(self, service: str, **arguments: Any) -> Any:
        self._socket.send(json.dumps({"op": "call_service", "service": service, "args": arguments}))
        answer = json.loads(self._socket.recv())
        assert answer["result"], answer
        return answer["values"]

    def code(self, service: str, **arguments: Any) -> int:
        return int(self.call(service, **arguments)["result"]["result"])

    def close(self) -> None:
        self._socket.close()


@pytest.fixture
def running() -> Iterator[tuple[Simulator, Client]]:
    simulator, stopped = Simulator("simpleton"), list[bool]()
    options = BridgeOptions(rosbridge=Address("127.0.0.1", 0))
    with bridged(simulator, options, RunControls(simulator), pytest.fail) as bridges:
        (server,) = bridges._open
        thread = Thread(target=advance_in_real_time, args=(simulator, bridges, lambda: bool(stopped)))
        thread.start()
        client = Client(server.urls[0])  # type: ignore[attr-defined]
        try:
            yield simulator, client
        finally:
            client.close()
            stopped.append(True)
            thread.join()


@pytest.mark.slow
def test_steps_of_the_service_are_the_steps_of_the_simulator(running: tuple[Simulator, Client]) -> None:
    simulator, client = running
    assert client.code("/step_simulation", steps=1) == 4  # it plays
    assert client.code("/set_simulation_state", state={"state": 2}) == 1
    assert client.code("/set_simulation_state", state={"state": 2}) == 101
    assert client.call("/get_simulation_state")["state"] == {"state": 2}
    assert client.code("/reset_simulation", scope=255) == 1
    for _ in range(4):
        assert client.code("/step_simulation", steps=250) == 1
    expected = Simulator("simpleton")
    expected.step(1000)
    assert simulator.t == expected.t == 1.0
    assert np.asarray(simulator.state.q).tobytes() == np.asarray(expected.state.q).tobytes()
    assert np.asarray(simulator.state.v).tobytes() == np.asarray(expected.state.v).tobytes()
    assert client.code("/set_simulation_state", state={"state": 0}) == 1
    assert client.call("/get_simulation_state")["state"] == {"state": 0}
    assert client.code("/set_simulation_state", state={"state": 3}) == 0


@pytest.mark.slow
def test_entities_are_spawned_found_placed_and_deleted(running: tuple[Simulator, Client]) -> None:
    _, client = running
    features = client.call("/get_simulator_features")["features"]
    assert {0, 1, 10, 11, 20, 31, 32} <= set(features["features"])
    assert features["spawn_formats"] == ["urdf", "sdf"]
    spawned = client.call(
        "/spawn_entity",
        name="box",
        entity_resource={"resource_string": BOX},
        initial_pose={"header": {"frame_id": "simpleton"}, "pose": {"position": {"x": 2.0, "z": 1.0}}},
    )
    assert (spawned["result"]["result"], spawned["entity_name"]) == (1, "box")
    again = {"name": "box", "entity_resource": {"resource_string": BOX}}
    assert client.code("/spawn_entity", **again) == 101
    assert client.call("/spawn_entity", **again, allow_renaming=True)["entity_name"] == "box_1"
    assert client.code("/spawn_entity", name="other") == 104
    assert client.code("/spawn_entity", name="other", entity_resource={"resource_string": "<sdf"}) == 106
    found = client.call("/get_entities", filters={"filter": "^box"})
    assert found["entities"] == ["box", "box_1"]
    assert client.call("/get_entities", filters={"categories": [{"category": 2}]})["entities"] == ["simpleton"]
    assert client.call("/get_entity_info", entity="box")["info"]["category"] == {"category": 4}
    state = {"pose": {"position": {"x": 5.0, "z": 0.1}, "orientation": {"w": 1.0}}}
    assert client.code("/set_entity_state", entity="box", state=state, set_pose=True) == 1
    placed = client.call("/get_entity_state", entity="box")["state"]
    assert placed["pose"]["position"]["x"] == pytest.approx(5.0, abs=1e-3)
    assert placed["header"]["frame_id"] == "world"
    assert client.code("/delete_entity", entity="box") == 1
    assert client.code("/get_entity_state", entity="box") == 2
    assert client.code("/reset_simulation", scope=4) == 1
    assert client.call("/get_entities_states", filters={"filter": "box"})["entities"] == []
    assert client.call("/get_current_world")["world"]["name"] == "empty"
    assert "house" in {each["name"] for each in client.call("/get_available_worlds")["worlds"]}
