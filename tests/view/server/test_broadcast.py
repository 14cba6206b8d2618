import asyncio

import umsgpack

from urdfkit.view.server.broadcast import Hub, pack
from urdfkit.view.server.send_queue import MAX_WAITING, Channel


class Command:
    """Like a meshcat command."""

    def __init__(self, **values) -> None:
        self.values = values

    def lower(self) -> dict:
        return self.values


def taken(channel: Channel) -> list:
    frames = []
    while (frame := channel._next()) is not None:
        frames.append(frame)
    return frames


def test_who_comes_late_gets_the_scene_as_it_stands() -> None:
    async def run() -> None:
        hub, early, late = Hub(), Channel(), Channel()
        hub.join(early)
        hub.latch("hello", "hello")
        hub.command("/robot/a", "set_object", b"a1")
        hub.command("/robot/a", "set_transform", b"t1")
        hub.command("/robot/a", "set_object", b"a2")
        hub.command("/robot/ab", "set_object", b"ab")
        hub.command("/robot/a", None, b"delete")
        hub.command("/robot/b", "set_object", b"b")
        hub.update("status", "s1")
        hub.update("status", "s2")
        hub.poses(1, b"p1")
        hub.poses(2, b"p2")
        hub.join(late)
        assert taken(late) == [b"ab", b"b", "hello", "s2", b"p2"]
        assert taken(early) == ["hello", b"a1", b"t1", b"a2", b"ab", b"delete", b"b", "s2", b"p2"]

    asyncio.run(run())


def test_poses_of_another_scene_are_forgotten() -> None:
    async def run() -> None:
        hub, late = Hub(), Channel()
        hub.poses(1, b"p1")
        hub.forget_poses()
        hub.join(late)
        assert taken(late) == []

    asyncio.run(run())


def test_a_full_channel_is_cut_and_the_others_go_on() -> None:
    async def run() -> None:
        hub, stalled, well = Hub(), Channel(), Channel()
        hub.join(stalled)
        hub.join(well)
        for number in range(40):
            hub.command(f"/robot/{number}", "set_object", bytes(MAX_WAITING // 32))
            assert len(taken(well)) == 1
        assert hub.watchers == 1
        await asyncio.wait_for(stalled.run(lambda frame: None), 5)

    asyncio.run(run())


def test_history_of_properties_does_not_grow() -> None:
    async def run() -> None:
        hub = Hub()
        for number in range(100):
            hub.command(
                *pack(Command(type="set_property", path="/robot/a", property="visible", value=bool(number % 2)))
            )
            hub.command(*pack(Command(type="set_property", path="/robot/a", property="color", value=[number, 0, 0, 1])))
        assert len(list(hub.snapshot())) == 2

    asyncio.run(run())


def test_commands_travel_as_msgpack_and_are_never_taken_for_poses() -> None:
    path, slot, packed = pack(Command(type="set_object", path="/robot/a", object={"x": 1}))
    assert (path, slot) == ("/robot/a", "set_object")
    assert umsgpack.unpackb(packed)["object"] == {"x": 1}
    assert packed[0] != 0x01
    assert pack(Command(type="delete", path="/robot"))[1] is None
