"""A client of yaml-language-server, the program by which VS Code, Neovim and others read JSON Schemas of YAML files."""

import json
import subprocess
from pathlib import Path
from typing import Any


class LanguageServer:
    """The server as a process; `of(text)` gives what it says of a file with that text."""

    def __init__(self, program: str, folder: Path, settings: dict[str, Any]):
        self.folder, self.settings, self.number = folder, settings, 0
        self.process = subprocess.Popen([program, "--stdio"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.diagnostics: dict[str, list] = {}
        capabilities = {
            "textDocument": {"hover": {"contentFormat": ["plaintext"]}, "completion": {}},
            "workspace": {"configuration": True},
        }
        self.ask("initialize", {"processId": None, "rootUri": folder.as_uri(), "capabilities": capabilities})
        self.tell("initialized", {})
        self.tell("workspace/didChangeConfiguration", {"settings": {"yaml": settings}})

    def __enter__(self) -> "LanguageServer":
        return self

    def __exit__(self, *error: object) -> None:
        self.process.kill()
        self.process.communicate()

    def open(self, name: str, text: str) -> str:
        """The address of a file that the server was told of."""
        uri = (self.folder / name).as_uri()
        document = {"uri": uri, "languageId": "yaml", "version": 1, "text": text}
        self.tell("textDocument/didOpen", {"textDocument": document})
        return uri

    def complaints(self, uri: str) -> list[dict[str, Any]]:
        """What the server finds wrong with a file."""
        while uri not in self.diagnostics:
            self._take()
        return self.diagnostics.pop(uri)

    def at(self, what: str, uri: str, line: int, character: int) -> Any:
        """Completion or hover at a place, counted from 0."""
        place = {"textDocument": {"uri": uri}, "position": {"line": line, "character": character}}
        return self.ask(f"textDocument/{what}", place)

    def ask(self, method: str, params: dict[str, Any]) -> Any:
        """The answer to a request."""
        self.number += 1
        number = self.number
        self._send({"id": number, "method": method, "params": params})
        while True:
            message = self._take()
            if message.get("id") == number and "method" not in message:
                assert "error" not in message, message
                return message["result"]

    def tell(self, method: str, params: dict[str, Any]) -> None:
        """A notice, which has no answer."""
        self._send({"method": method, "params": params})

    def _send(self, message: dict[str, Any]) -> None:
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%b" % (len(body), body))
        self.process.stdin.flush()

    def _take(self) -> dict[str, Any]:
        """The next message; what the server asks is answered."""
        length = 0
        while line := self.process.stdout.readline().strip():
            name, _, value = line.partition(b":")
            length = int(value) if name.lower() == b"content-length" else length
        assert length, "the server has ended"
        message = json.loads(self.process.stdout.read(length))
        if message.get("method") == "textDocument/publishDiagnostics":
            self.diagnostics[message["params"]["uri"]] = message["params"]["diagnostics"]
        elif "method" in message and "id" in message:
            asked = message["params"].get("items", []) if isinstance(message.get("params"), dict) else []
            result = [self.settings if each.get("section") == "yaml" else None for each in asked]
            self._send({"id": message["id"], "result": result or None})
        return message
