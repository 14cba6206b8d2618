import asyncio

import pytest

from urdfkit.view.server.send_queue import MAX_IN_FLIGHT, MAX_STREAM_BYTES, MAX_WAITING, Channel, ChannelFullError


class Browser:
    """Takes frames when it is told to."""

    def __init__(self) -> None:
        self.frames: list[str | bytes] = []
        self.reads = asyncio.Semaphore(0)

    async def write(self, frame: str | bytes) -> None:
        await self.reads.acquire()
        self.frames.append(frame)

    def read(self, frames: int) -> None:
        for _ in range(frames):
            self.reads.release()


def play(scenario) -> None:
    """Run a scenario against a channel and a browser."""

    async def run() -> None:
        channel, browser = Channel(), Browser()
        sender = asyncio.ensure_future(channel.run(browser.write))

        async def settle() -> None:
            for _ in range(50):
                await asyncio.sleep(0)

        try:
            await scenario(channel, browser, settle)
        finally:
            sender.cancel()
            await asyncio.gather(sender, return_exceptions=True)

    asyncio.run(run())


def test_lines_all_arrive_in_order() -> None:
    async def scenario(channel, browser, settle) -> None:
        for number in range(100):
            channel.line(str(number))
        browser.read(100)
        await asyncio.sleep(0)
        for _ in range(4):
            await settle()
        assert browser.frames == [str(number) for number in range(100)]

    play(scenario)


def test_at_most_three_pose_frames_are_unacknowledged_and_the_newest_comes_next() -> None:
    async def scenario(channel, browser, settle) -> None:
        browser.read(1000)
        for number in range(20):
            channel.poses(number, b"%d" % number)
            await settle()
        assert browser.frames == [b"0", b"1", b"2"]
        assert channel.in_flight == MAX_IN_FLIGHT
        channel.acknowledge(1)  # so 0 arrived too
        await settle()
        assert browser.frames[3:] == [b"19"]
        channel.poses(20, b"20")
        await settle()
        channel.poses(21, b"21")
        await settle()
        assert browser.frames[4:] == [b"20"]

    play(scenario)


def test_a_browser_that_reads_nothing_costs_one_frame_of_each_kind() -> None:
    async def scenario(channel, browser, settle) -> None:
        for number in range(1000):
            channel.poses(number, b"p%d" % number)
            channel.update("status", f"s{number}")
            await settle()
        browser.read(10)
        for _ in range(3):
            await settle()
        assert set(browser.frames) == {"s0", b"p999", "s999"}  # s0 was already on its way

    play(scenario)


@pytest.mark.parametrize("sequence", [5, 2**32 - 1])
def test_acknowledging_what_was_never_sent_changes_nothing(sequence: int) -> None:
    async def scenario(channel, browser, settle) -> None:
        browser.read(100)
        for number in range(3):
            channel.poses(number, b"x")
            await settle()
        channel.acknowledge(sequence)
        assert channel.in_flight == 3

    play(scenario)


def test_lines_overtake_news_and_news_overtake_poses() -> None:
    async def scenario(channel, browser, settle) -> None:
        channel.poses(1, b"poses")
        channel.update("status", "news")
        channel.line("line")
        browser.read(3)
        await settle()
        assert browser.frames == ["line", "news", b"poses"]

    play(scenario)


def test_a_browser_that_does_not_read_the_scene_is_given_up() -> None:
    async def scenario(channel, browser, settle) -> None:
        big = bytes(MAX_WAITING // 2 + 1)
        channel.line(big)
        with pytest.raises(ChannelFullError):
            channel.line(big)

    play(scenario)


def test_one_frame_of_any_size_passes() -> None:
    async def scenario(channel, browser, settle) -> None:
        channel.line(bytes(MAX_WAITING + 1))
        browser.read(1)
        await settle()
        assert len(browser.frames) == 1

    play(scenario)


def test_cut_ends_the_sender() -> None:
    async def run() -> None:
        channel, browser = Channel(), Browser()
        sender = asyncio.ensure_future(channel.run(browser.write))
        await asyncio.sleep(0)
        channel.cut()
        await asyncio.wait_for(sender, 5)

    asyncio.run(run())


def test_of_a_stream_of_large_frames_few_wait_and_the_newest_always_does() -> None:
    async def scenario(channel, browser, settle) -> None:
        channel.subscribe(frozenset({"full_messages:/image"}))
        for name in "abcd":
            channel.send_chunk("full_messages:/image", name * (MAX_STREAM_BYTES // 3))
        channel.send_chunk("full_messages:/image", "e" * (MAX_STREAM_BYTES // 4))
        browser.read(10)
        await settle()
        assert [frame[0] for frame in browser.frames] == ["c", "d", "e"]
        browser.frames.clear()
        channel.send_chunk("full_messages:/image", "f")
        channel.send_chunk("full_messages:/image", "g" * (MAX_STREAM_BYTES + 1))
        await settle()
        assert [frame[0] for frame in browser.frames] == ["g"]

    play(scenario)
