import asyncio

from urdfkit.bridges.published_message import PublishedMessage
from urdfkit.bridges.websocket.send_queue import MAX_BYTES, MAX_REPLIES, SendQueue, SubscriptionQueue
from urdfkit.messages import from_fields


def sample(number: int) -> PublishedMessage:
    return PublishedMessage("/count", "std_msgs/msg/Int32", from_fields("std_msgs/msg/Int32", {"data": number}), 0.0)


def numbers(queue: SubscriptionQueue) -> list[int]:
    return [queue.take().message.data for _ in range(len(queue))]


def test_a_subscription_keeps_the_newest_messages() -> None:
    queue = SubscriptionQueue(lambda _: [], length=3)
    for number in range(1000):
        queue.put(sample(number))
    assert numbers(queue) == [997, 998, 999]


def test_large_messages_are_bounded_in_bytes_and_the_newest_is_kept() -> None:
    queue = SubscriptionQueue(lambda _: [])
    for number in range(10):
        large = sample(number)
        large.size = MAX_BYTES // 2
        queue.put(large)
    assert numbers(queue) == [8, 9]
    huge = sample(7)
    huge.size = 10 * MAX_BYTES
    queue.put(huge)
    assert numbers(queue) == [7]


async def collected(queue: SendQueue, seconds: float) -> list[str | bytes]:
    frames: list[str | bytes] = []

    async def write(frame: str | bytes) -> None:
        frames.append(frame)

    task = asyncio.ensure_future(queue.run(write))
    await asyncio.sleep(seconds)
    task.cancel()
    await asyncio.gather(task, return_exceptions=True)
    return frames


def test_subscriptions_take_turns_and_replies_come_first() -> None:
    async def run() -> list[str | bytes]:
        queue = SendQueue()
        one, two = (SubscriptionQueue(lambda it, n=name: [f"{n}{it.message.data}"]) for name in "ab")
        queue.add(one)
        queue.add(two)
        for number in range(3):
            queue.put(one, sample(number))
        queue.put(two, sample(0))
        queue.reply("reply")
        return await collected(queue, 0.05)

    assert asyncio.run(run()) == ["reply", "a0", "b0", "a1", "a2"]


def test_throttled_messages_wait_and_the_newest_is_sent() -> None:
    async def run() -> list[str | bytes]:
        queue = SendQueue()
        slow = SubscriptionQueue(lambda it: [str(it.message.data)], length=1, period=0.3)
        queue.add(slow)
        queue.put(slow, sample(0))
        task = asyncio.ensure_future(collected(queue, 0.6))
        for number in range(1, 10):
            await asyncio.sleep(0.01)
            queue.put(slow, sample(number))
        return await task

    assert asyncio.run(run()) == ["0", "9"]


def test_too_many_replies_end_the_connection() -> None:
    async def run() -> None:
        queue = SendQueue()
        for _ in range(20):
            queue.reply("x" * (MAX_REPLIES // 10))
        assert queue.full
        await asyncio.wait_for(queue.run(lambda _: asyncio.sleep(0)), 1.0)

    asyncio.run(run())
