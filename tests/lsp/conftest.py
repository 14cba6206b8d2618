"""A client of the Language Server Protocol over pipes, as an editor is one."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.processes import running
from tests.time_limit import PATIENCE


class Client:
    """Talks to ``urdfkit lsp``.

    Args:
        folder: the working folder of the server.
        process: the server.
    """

    def __init__(self, folder: Path, process: subprocess.Popen[bytes]) -> None:
        self.folder = folder
        self.process = process
        self._number = 0
        self._versions: dict[str, int] = {}
        self.diagnostics: dict[str, list[dict[str, Any]]] = {}
        self.looked_at: dict[str, int | None] = {}
        self.capabilities = self.ask("initialize", {"processId": None, "rootUri": folder.as_uri(), "capabilities": {}})[
            "capabilities"
        ]
        self.tell("initialized", {})

    def _send(self, message: dict[str, Any]) -> None:
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        assert self.process.stdin is not None
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def _receive(self) -> dict[str, Any]:
        assert self.process.stdout is not None
        length = 0
        while (line := self.process.stdout.readline().strip()) or not length:
            if line.lower().startswith(b"content-length:"):
                length = int(line.partition(b":")[2])
            elif not line and self.process.poll() is not None:
                assert self.process.stderr is not None
                raise AssertionError(self.process.stderr.read().decode())
        message = json.loads(self.process.stdout.read(length))
        if message.get("method") == "textDocument/publishDiagnostics":
            self.diagnostics[message["params"]["uri"]] = message["params"]["diagnostics"]
            self.looked_at[message["params"]["uri"]] = message["params"].get("version")
        return message

    def tell(self, method: str, params: dict[str, Any]) -> None:
        """Send a notification."""
        self._send({"method": method, "params": params})

    def ask(self, method: str, params: dict[str, Any]) -> Any:
        """Send a request and return its result; an error as an `AssertionError`."""
        self._number += 1
        self._send({"id": self._number, "method": method, "params": params})
        while True:
            message = self._receive()
            if message.get("id") == self._number:
                assert "error" not in message, message["error"]["message"]
                return message["result"]

    def uri(self, name: str) -> str:
        return (self.folder / name).as_uri()

    def open(self, name: str, text: str | None = None) -> None:
        """Open a document, by default as it is on disk."""
        text = (self.folder / name).read_text("utf-8") if text is None else text
        document = {"uri": self.uri(name), "languageId": "xml", "version": 1, "text": text}
        self._versions[name] = 1
        self.tell("textDocument/didOpen", {"textDocument": document})

    def change(self, name: str, text: str) -> None:
        """Replace the text of an open document, which is not saved."""
        self._versions[name] += 1
        document = {"uri": self.uri(name), "version": self._versions[name]}
        self.tell("textDocument/didChange", {"textDocument": document, "contentChanges": [{"text": text}]})

    def close_all(self) -> None:
        """Close every document, unsaved."""
        for name in self._versions:
            self.tell("textDocument/didClose", {"textDocument": {"uri": self.uri(name)}})
        self._versions.clear()
        self.tell("workspace/didChangeWatchedFiles", {"changes": []})
        self.ask("textDocument/hover", {"textDocument": {"uri": "untitled:0"}, "position": {"line": 0, "character": 0}})

    def published(self, name: str) -> list[dict[str, Any]]:
        """Wait until diagnostics of a document are published, and return them."""
        self.diagnostics.pop(self.uri(name), None)
        while self.uri(name) not in self.diagnostics:
            self._receive()
        return self.diagnostics[self.uri(name)]

    def at(self, name: str, text: str, mark: str) -> dict[str, Any]:
        """Return document and position of the first `mark` in a text; the place is where ``|`` is in it."""
        offset = text.index(mark.replace("|", "")) + mark.index("|")
        before = text[:offset]
        column = len(before[before.rfind("\n") + 1 :].encode("utf-16-le")) // 2
        position = {"line": before.count("\n"), "character": column}
        return {"textDocument": {"uri": self.uri(name)}, "position": position}

    def close(self) -> str:
        """End the server as an editor does; return what it has written to standard error."""
        self.ask("shutdown", {})
        self.tell("exit", {})
        assert self.process.wait(timeout=PATIENCE) == 0
        assert self.process.stderr is not None
        return self.process.stderr.read().decode()


@contextmanager
def connected(folder: Path, *words: str) -> Iterator[Client]:
    """Run ``urdfkit lsp`` with these arguments in a folder, and talk to it."""
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    with running([sys.executable, "-m", "urdfkit", "lsp", *words], cwd=folder, **pipes) as process:
        client = Client(folder, process)
        yield client
        if process.poll() is None:
            client.close()


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Client]:
    with connected(tmp_path_factory.mktemp("project"), "--target", "any") as found:
        yield found
