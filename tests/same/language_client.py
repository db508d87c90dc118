"""A client of `ncvet lsp`: sends messages, waits for answers and for published diagnostics."""
import json
import os
import select
import subprocess
import time


class NoAnswer(Exception):
    pass


class LanguageClient:
    def __init__(self, binary, root, options, pulls, patience):
        self._process = subprocess.Popen(
            [binary, "lsp"], cwd=root, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
        )
        self._patience, self._buffer, self._kept, self._last = patience, b"", [], 0
        document = {
            "publishDiagnostics": {"relatedInformation": True, "tagSupport": {"valueSet": [1]}},
            "documentSymbol": {"hierarchicalDocumentSymbolSupport": True},
            "hover": {"contentFormat": ["markdown"]},
        }
        if pulls:
            document["diagnostic"] = {"relatedInformation": True, "relatedDocumentSupport": True}
        capabilities = {"general": {"positionEncodings": ["utf-32"]}, "textDocument": document}
        self.request(
            "initialize",
            {
                "processId": None,
                "rootUri": None,
                "capabilities": capabilities,
                "initializationOptions": options,
            },
        )
        self.notify("initialized", {})

    def close(self):
        self._process.kill()
        self._process.wait()
        self._process.stdin.close()
        self._process.stdout.close()

    def notify(self, method, params):
        self._send({"method": method, "params": params})

    def request(self, method, params):
        """The result; an error as it is."""
        self._last += 1
        wanted = self._last
        self._send({"id": wanted, "method": method, "params": params})
        answer = self._next(lambda message: message.get("id") == wanted and "method" not in message)
        return answer["result"] if "result" in answer else {"error": answer.get("error", {}).get("code")}

    def published(self, uri, version):
        """The diagnostics of a document's version."""

        def is_it(message):
            params = message.get("params") or {}
            return (
                message.get("method") == "textDocument/publishDiagnostics"
                and params["uri"] == uri
                and params.get("version") == version
            )

        return self._next(is_it)["params"]["diagnostics"]

    def _send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        try:
            self._process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
            self._process.stdin.flush()
        except OSError:
            raise NoAnswer("the server has ended") from None

    def _next(self, wanted):
        for at, message in enumerate(self._kept):
            if wanted(message):
                # What came before it will not be asked for any more.
                del self._kept[: at + 1]
                return message
        end = time.monotonic() + self._patience
        while True:
            message = self._read(end)
            if wanted(message):
                return message
            self._kept.append(message)

    def _read(self, end):
        while True:
            header, found, rest = self._buffer.partition(b"\r\n\r\n")
            if found:
                length = int(header.split(b":")[1].split(b"\r")[0])
                if len(rest) >= length:
                    self._buffer = rest[length:]
                    return json.loads(rest[:length].decode("utf-8", "replace"))
            left = end - time.monotonic()
            if left <= 0 or not select.select([self._process.stdout], [], [], left)[0]:
                raise NoAnswer("no answer in time")
            piece = os.read(self._process.stdout.fileno(), 1 << 16)
            if not piece:
                raise NoAnswer("the server has ended")
            self._buffer += piece
