# SPDX-License-Identifier: BSD-3-Clause
"""The web server of a view. It serves the page, sends states of the run to the page as frames, and
handles the buttons of the page."""

from __future__ import annotations

import hmac
import http.server
import secrets
import select
import socket
import threading
import time
import weakref
from pathlib import Path
from typing import TYPE_CHECKING, Any, Sequence, cast

from . import _motion, drawings
from .live import FRAME, Frame, Live

if TYPE_CHECKING:
    from ._calls import Handle
    from ._motion import TraceLike
    from .mechanism import Mechanism

SHARE = 0.02  # a thread spends at most this fraction of its time on making frames
TIMEOUT = 10.0  # [s] a connection ends if its page has read no data for this time
SCRIPT = Path(__file__).with_name("live.js")


class Server(http.server.ThreadingHTTPServer):
    """Serves one view at 127.0.0.1. The server holds no reference to the simulation, so that Python
    can collect the simulation while the server is running."""

    daemon_threads = True
    timeout = 0.1  # [s] interval at which the server checks whether it must end

    def __init__(
        self,
        live: Live,
        owner: Handle,
        mechanism: Mechanism,
        title: str | None,
        traces: Sequence[TraceLike],
    ) -> None:
        self.live = live
        self._shown = mechanism, title, traces
        self.page()  # raises an exception if the traces are wrong
        super().__init__(("127.0.0.1", 0), _Handler)
        self.token = secrets.token_urlsafe(18)
        self.hosts = [f"{name}:{self.server_port}" for name in ("127.0.0.1", "localhost")]
        self.ended = threading.Event()
        self._owner = weakref.ref(owner)
        self._text: tuple[Frame | None, str] = (None, "")
        self.thread = threading.Thread(target=self._run, name="baum view", daemon=True)

    @property
    def url(self) -> str:
        return f"http://{self.hosts[0]}/{self.token}/"

    def _run(self) -> None:
        with self:
            while not self.ended.is_set():
                self.handle_request()

    def end(self) -> None:
        """End the view. Any thread may call this."""
        self.ended.set()
        if self in self.live.servers:
            self.live.servers.remove(self)

    def handle_error(self, request: Any, client_address: Any) -> None:
        pass  # the page was closed in the middle of an answer

    def page(self) -> str:
        """Return the page. It shows the newest frame until it receives other frames."""
        mechanism, title, traces = self._shown
        frame = self.live.frame
        motion = _motion.of_arrays(
            mechanism, [frame.t], frame.q.reshape(1, -1), title, traces, {}, ()
        )
        page = str(drawings.page(motion))
        before, policy, rest = page.partition("script-src 'unsafe-inline'")
        rest, body, foot = rest.rpartition("</body>")
        script = f"<script>\n{SCRIPT.read_text(encoding='utf-8')}</script>\n"
        return f"{before}{policy}; connect-src 'self'{rest}{script}{body}{foot}"

    def text(self) -> str:
        """Return the newest frame as JSON. If no call is advancing the run, the newest frame is the
        present state of the run."""
        owner = self._owner()
        if owner is not None:
            owner.glance(self.live.show)
        frame, text = self._text
        if frame is not self.live.frame:
            frame = self.live.frame
            q = ",".join(map(repr, frame.q.tolist()))
            text = f'"t":{frame.t!r},"q":[{q}]'
            self._text = (frame, text)
        return f'{{{text},"paused":{"true" if self.live.paused else "false"}}}'


class _Handler(http.server.BaseHTTPRequestHandler):
    timeout = TIMEOUT
    server_version = "baum"

    @property
    def _server(self) -> Server:
        return cast(Server, self.server)

    def do_GET(self) -> None:
        asked = self._asked()
        if asked == "":
            page = self._server.page().encode()
            self._begin(200, "text/html; charset=utf-8", len(page))
            self.wfile.write(page)
        elif asked == "events":
            self._stream()
        elif asked is not None:
            self.send_error(404)

    def do_POST(self) -> None:
        asked = self._asked()
        act = {name: getattr(self._server.live, name) for name in ("pause", "resume", "step")}
        if asked in act:
            act[asked]()
            self._begin(204)
        elif asked is not None:
            self.send_error(404)

    def _asked(self) -> str | None:
        """Return the part of the address after the secret token. Three checks make sure that only
        our own page receives an answer: the header Host must name this server, the header Origin
        must also name it unless the header is missing, and the address must contain the token. If a
        check fails, answer with an error and return None."""
        hosts = self._server.hosts
        origins = ["", *(f"http://{host}" for host in hosts)]
        if self.headers.get("Host") not in hosts or self.headers.get("Origin", "") not in origins:
            self.send_error(403)
            return None
        token, slash, asked = self.path[1:].partition("?")[0].partition("/")
        if not slash or not hmac.compare_digest(token.encode(), self._server.token.encode()):
            self.send_error(404)
            return None
        return asked

    def _begin(self, status: int, kind: str = "text/plain", size: int | None = 0) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Cache-Control", "no-store")
        self.send_header("Referrer-Policy", "no-referrer")
        self.send_header("X-Content-Type-Options", "nosniff")
        if size is not None:
            self.send_header("Content-Length", str(size))
        self.end_headers()

    def _stream(self) -> None:
        """Send the newest frame repeatedly, until the page or the view is closed."""
        self.connection.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 1 << 16)
        self._server.live.enter()
        try:
            self._begin(200, "text/event-stream", None)
            sent, rest = "", 0.0
            while not select.select([self.connection], [], [], rest)[0]:
                ended, begin = self._server.ended.is_set(), time.thread_time()
                text = self._server.text()
                if text != sent:
                    self.wfile.write(f"data: {text}\n\n".encode())
                    sent = text
                if ended:
                    self.wfile.write(b"event: end\ndata:\n\n")
                    return
                rest = max(FRAME, (time.thread_time() - begin) / SHARE)
        except OSError:
            pass  # the page is closed, or has not read for too long
        finally:
            self._server.live.leave()

    def log_message(self, format: str, *arguments: Any) -> None:
        pass
