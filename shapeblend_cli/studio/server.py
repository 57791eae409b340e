"""The server of the studio: this machine alone, and no page but its own, reaches it.

It listens on the loopback interface. The address that is opened has a token, which becomes a cookie that no script sees
and no other site can have sent. Requests that name another host, or come from another origin, are refused; so are all
without the cookie. The page may load and ask for nothing elsewhere, and runs no script but its own files.
"""

from __future__ import annotations

import hmac
import io
import json
import secrets
import socket
import threading
import time
from collections.abc import Callable
from http import HTTPStatus
from http.cookies import CookieError, SimpleCookie
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from typing import Any, ClassVar
from urllib.parse import parse_qs, quote, urlsplit

from shapeblend_cli.errors import ShapeblendError, in_words
from shapeblend_cli.studio.session import Download, Session

HOST = "127.0.0.1"

MOST_JSON = 4 * 2**20
"""Maximum size of a request, in bytes."""

MOST_DRAWING = 64 * 2**20
"""Maximum size of a request with a drawing, in bytes: the reader takes no larger drawing."""

MOST_CONNECTIONS = 64
"""Maximum number of connections at once. A browser opens six for a page."""

IDLE = 60.0
"""Maximum time between two requests of the page on one connection, in seconds."""

HEADERS_TIME = 10.0
"""Maximum time for the headers of a request, in seconds, however steadily bytes arrive."""

BODY_TIME = 60.0
"""Maximum time for the body of a request, in seconds, however steadily bytes arrive."""

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)

HEADERS = {
    "Content-Security-Policy": POLICY,
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}

PAGE, SHARED = "studio/page", "preview"

KINDS = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
}

ASSETS = {
    **dict.fromkeys(
        "studio.css main.js asking.js drawings.js panel.js tools.js zoom.js stage.js".split(), PAGE
    ),
    **dict.fromkeys("easing.js timeline.js form.js others.js exporting.js".split(), PAGE),
    **dict.fromkeys("base.css values.js picture.js player.js parts.js".split(), SHARED),
}
"""Files of the page, and the folder of each."""

BUSY = b"HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"

REFUSED = "This is a studio of shapeblend. Open the whole address that the command printed, with its token."


class Studio(ThreadingHTTPServer):
    """A studio, listening."""

    daemon_threads = True
    block_on_close = False

    def __init__(self, session: Session, port: int = 0) -> None:
        super().__init__((HOST, port), _Handler)
        self.session = session
        self.token = secrets.token_urlsafe(32)
        self._free = threading.Semaphore(MOST_CONNECTIONS)
        self._heard = time.monotonic()

    @property
    def quiet_for(self) -> float:
        """The seconds since somebody asked for something."""
        return time.monotonic() - self._heard

    @property
    def hosts(self) -> tuple[str, ...]:
        """Host names that requests for the page may have."""
        return f"{HOST}:{self.server_port}", f"localhost:{self.server_port}"

    @property
    def cookie(self) -> str:
        """The name of the cookie, which differs from studio to studio: cookies do not tell ports apart."""
        return f"shapeblend-{self.server_port}"

    @property
    def address(self) -> str:
        """What a browser opens."""
        return f"http://{self.hosts[0]}/?token={self.token}"

    def hear(self) -> None:
        """Take note of a request."""
        self._heard = time.monotonic()

    def process_request(self, request: Any, client_address: Any) -> None:
        """Answer a connection, unless there are too many."""
        if self._free.acquire(blocking=False):
            super().process_request(request, client_address)
        else:
            request.sendall(BUSY)
            self.shutdown_request(request)

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        """Answer a connection until it is closed."""
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._free.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing of connections that break off."""


class _Refused(Exception):
    def __init__(self, status: HTTPStatus, message: str) -> None:
        super().__init__(message)
        self.status = status


class _Incoming(io.RawIOBase):
    """What a connection sends, up to a time."""

    def __init__(self, connection: socket.socket) -> None:
        self._connection = connection
        self._end = 0.0

    def allow(self, seconds: float) -> None:
        """Wait for a number of seconds from now on."""
        self._end = time.monotonic() + seconds

    def readable(self) -> bool:
        """Return that it can be read."""
        return True

    def readinto(self, buffer: Any) -> int:
        """Read what there is, or wait for it; raise TimeoutError when the time is over."""
        left = self._end - time.monotonic()
        if left <= 0.0:
            raise TimeoutError
        self._connection.settimeout(left)
        return self._connection.recv_into(buffer)


class _Handler(BaseHTTPRequestHandler):
    """One connection."""

    server: Studio
    rfile: io.BufferedReader
    protocol_version = "HTTP/1.1"
    server_version, sys_version = "shapeblend", ""
    wbufsize = -1  # headers and body in one piece, so that nothing waits for an acknowledgement
    _is_known = False  # whether a request has come from the page

    ASKED: ClassVar[dict[str, Callable[[Session, Any], Any]]] = {
        "begin": Session.begin,
        "look": Session.look,
        "others": Session.others,
        "size": Session.size,
        "write": Session.write,
        "download": Session.download,
        "save": Session.save,
        "keep": Session.keep,
        "halt": Session.halt,
        "here": Session.here,
    }
    TAKEN: ClassVar[dict[str, Callable[[Session, str, bytes], Any]]] = {
        "drawing": Session.take_drawing,
        "project": Session.take_project,
    }

    def setup(self) -> None:
        """Prepare to read and write."""
        super().setup()
        self._incoming = _Incoming(self.connection)
        self.rfile = io.BufferedReader(self._incoming)

    def handle_one_request(self) -> None:
        """Answer the next request, if it comes in time."""
        try:
            self._incoming.allow(IDLE if self._is_known else HEADERS_TIME)
            self.rfile.peek(1)
            self._incoming.allow(HEADERS_TIME)
            super().handle_one_request()
        except TimeoutError:
            self.close_connection = True

    def do_GET(self) -> None:
        """Answer with the page, or one of its files."""
        self._answer(self._get)

    def do_POST(self) -> None:
        """Answer a request of the page."""
        self._answer(self._post)

    def _answer(self, respond: Callable[[], None]) -> None:
        self.server.hear()
        try:
            respond()
        except _Refused as refused:
            self.close_connection = True
            self._send(refused.status, "text/plain; charset=utf-8", str(refused).encode())
        except (ConnectionError, TimeoutError):
            self.close_connection = True

    def _get(self) -> None:
        url = urlsplit(self.path)
        self._check_host()
        if url.path == "/":
            token = parse_qs(url.query).get("token", [""])[0]
            if token:
                if not self._is_token(token):
                    raise _Refused(HTTPStatus.FORBIDDEN, REFUSED)
                cookie = f"{self.server.cookie}={self.server.token}; HttpOnly; SameSite=Strict; Path=/"
                self._send_file(PAGE, "studio.html", {"Set-Cookie": cookie})
                return
            self._check_sender()
            self._send_file(PAGE, "studio.html")
            return
        self._check_sender()
        name = url.path[1:]
        if name not in ASSETS:
            raise _Refused(HTTPStatus.NOT_FOUND, "There is no such file.")
        self._send_file(ASSETS[name], name)

    def _post(self) -> None:
        self._check_host()
        self._check_sender(must_have_origin=True)
        url = urlsplit(self.path)
        _, _, what = url.path.partition("/api/")
        session = self.server.session
        try:
            if what in self.TAKEN:
                name = parse_qs(url.query).get("name", [""])[0]
                answer = self.TAKEN[what](session, name, self._body(MOST_DRAWING, "application/octet-stream"))
            elif what in self.ASKED:
                answer = self.ASKED[what](session, self._json())
            else:
                raise _Refused(HTTPStatus.NOT_FOUND, "There is no such request.")
        except ShapeblendError as error:
            answer = {"error": str(error)}
        except (OSError, MemoryError, ValueError, TypeError, KeyError) as error:
            answer = {"error": in_words(error)}
        if isinstance(answer, Download):
            name = quote(answer.name, safe="")
            headers = {"Content-Disposition": f"attachment; filename*=UTF-8''{name}"}
            self._send(HTTPStatus.OK, "application/octet-stream", answer.content, headers)
            return
        self._send(HTTPStatus.OK, "application/json", json.dumps(answer, allow_nan=False).encode())

    # ---- who asks

    def _check_host(self) -> None:
        """Refuse names that other machines may have given to this one."""
        if self.headers.get("Host", "").lower() not in self.server.hosts:
            raise _Refused(HTTPStatus.MISDIRECTED_REQUEST, "This address is not the studio's.")

    def _check_sender(self, *, must_have_origin: bool = False) -> None:
        """Refuse what comes from another page than the studio's, or without its cookie."""
        origin = self.headers.get("Origin")
        own = f"http://{self.headers.get('Host', '').lower()}"
        if origin != own and (origin is not None or must_have_origin):
            raise _Refused(HTTPStatus.FORBIDDEN, "Other pages may not use the studio.")
        if self.headers.get("Sec-Fetch-Site", "same-origin") not in ("same-origin", "none"):
            raise _Refused(HTTPStatus.FORBIDDEN, "Other pages may not use the studio.")
        try:
            cookies = SimpleCookie(self.headers.get("Cookie", ""))
        except CookieError:
            cookies = SimpleCookie()
        cookie = cookies.get(self.server.cookie)
        if cookie is None or not self._is_token(cookie.value):
            raise _Refused(HTTPStatus.FORBIDDEN, REFUSED)
        self._is_known = True

    def _is_token(self, text: str) -> bool:
        return hmac.compare_digest(text.encode("utf-8", "replace"), self.server.token.encode())

    # ---- what is sent and received

    def _body(self, most: int, kind: str) -> bytes:
        if self.headers.get("Content-Type", "").partition(";")[0].strip() != kind:
            raise _Refused(HTTPStatus.UNSUPPORTED_MEDIA_TYPE, f"This takes {kind}.")
        length = self.headers.get("Content-Length", "")
        if not length.isdecimal():
            raise _Refused(HTTPStatus.LENGTH_REQUIRED, "The length of the request is missing.")
        if int(length) > most:
            raise _Refused(
                HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"More than {most // 2**20} MB, the most that is taken."
            )
        self._incoming.allow(BODY_TIME)
        try:
            return self.rfile.read(int(length))
        except TimeoutError:
            raise _Refused(HTTPStatus.REQUEST_TIMEOUT, "The request took too long to arrive.") from None

    def _json(self) -> dict[str, Any]:
        try:
            value = json.loads(self._body(MOST_JSON, "application/json"))
        except (ValueError, RecursionError):
            value = None
        if not isinstance(value, dict):
            raise _Refused(HTTPStatus.BAD_REQUEST, "This is no JSON object.")
        return value

    def _send_file(self, folder: str, name: str, headers: dict[str, str] | None = None) -> None:
        kind = KINDS[name[name.rindex(".") :]]
        self._send(HTTPStatus.OK, kind, files("shapeblend_cli").joinpath(folder, name).read_bytes(), headers)

    def _send(
        self, status: HTTPStatus, kind: str, body: bytes, headers: dict[str, str] | None = None
    ) -> None:
        self.connection.settimeout(IDLE)
        self.send_response(status)
        for name, value in {
            **HEADERS,
            "Content-Type": kind,
            "Content-Length": str(len(body)),
            **(headers or {}),
        }.items():
            self.send_header(name, value)
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(body)
        self.wfile.flush()

    def log_message(self, format: str, *args: Any) -> None:
        """Print nothing of requests."""
