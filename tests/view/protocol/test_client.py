"""A program's line to the server: let in by the key, told what it wants, answered what it orders."""

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

import pytest

from tests.time_limit import PATIENCE
from urdfkit.errors import ResourceError, UsageError
from urdfkit.view.protocol.client import Client, connect
from urdfkit.view.protocol.page_requests import Schema, text
from urdfkit.view.server.server import Server


def talk(url: str, work: Callable[[Client], Awaitable[Any]]) -> Any:
    async def all_of_it() -> Any:
        async with await connect(url) as client:
            return await asyncio.wait_for(work(client), PATIENCE)

    return asyncio.run(all_of_it())


def test_what_is_wanted_comes_and_what_is_not_does_not(server: Server) -> None:
    async def work(client: Client) -> dict[str, Any]:
        await client.subscribe("field:a")
        while "field:a" not in server.hub.subscribed_keys:
            await asyncio.sleep(0.005)
        server.send_chunk("field:b", "samples", of="b")
        server.send_chunk("field:a", "samples", of="a")
        while (found := await client.text(PATIENCE)) is not None and found["type"] != "samples":
            pass
        assert found is not None
        return found

    assert talk(server.url, work) == {"type": "samples", "of": "a"}


def test_an_order_is_answered_and_what_came_meanwhile_is_not_lost(server: Server) -> None:
    server.requests["greet"] = Schema({"name": text()}, changes=False)

    async def work(client: Client) -> tuple[dict[str, Any], list[str]]:
        order = asyncio.ensure_future(client.request("greet", name="you"))
        while not (found := server.inbox.take().requests):
            await asyncio.sleep(0.005)
        server.broadcast("status", time=1.0)
        server.answer(found[0], hello="you")
        values = await order
        seen = []
        while "status" not in seen and (message := await client.text(PATIENCE)) is not None:
            seen.append(message["type"])
        return values, seen

    values, seen = talk(server.url, work)
    assert values == {"hello": "you"}
    assert seen[:2] == ["you", "hello"]


def test_an_order_that_is_refused_says_why(server: Server) -> None:
    with pytest.raises(UsageError, match="unknown request `gret`"):
        talk(server.url, lambda client: client.request("gret"))
    with pytest.raises(UsageError, match="at most 65536 are accepted"):
        talk(server.url, lambda client: client.request("gret", text="x" * 70_000))


def test_who_is_no_server_or_has_another_key_is_reported(server: Server) -> None:
    wrong = server.url[:-4] + "nope"
    with pytest.raises(ResourceError, match="wrong token"):
        talk(wrong, lambda client: client.text())
    server.stop()
    with pytest.raises(ResourceError, match="cannot connect"):
        talk(server.url, lambda client: client.text())


def test_the_end_of_the_server_is_noticed(server: Server) -> None:
    async def work(client: Client) -> None:
        while (found := await client.text(PATIENCE)) is not None:
            if found["type"] == "model":
                await asyncio.to_thread(server.stop)

    with pytest.raises(ResourceError, match="the simulation has ended"):
        talk(server.url, work)
