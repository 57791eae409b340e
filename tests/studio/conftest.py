"""A studio that listens."""

import http.client
import json
import threading
from urllib.parse import urlsplit

import pytest

from shapeblend_cli.rows.project import Project
from shapeblend_cli.studio.server import Studio
from shapeblend_cli.studio.session import Session
from tests.support.drawings import BAR, LEAF, svg


class Client:
    """Asks a studio as its page does, unless told otherwise."""

    def __init__(self, studio):
        self.studio = studio
        self.port = urlsplit(studio.address).port
        self.own = {
            "Host": f"127.0.0.1:{self.port}",
            "Origin": f"http://127.0.0.1:{self.port}",
            "Sec-Fetch-Site": "same-origin",
            "Cookie": f"{studio.cookie}={studio.token}",
        }

    def request(self, method, path, body=None, **headers):
        """Send a request; a header that is None is left out."""
        names = {name.replace("_", "-"): value for name, value in headers.items()}
        sent = {name: value for name, value in {**self.own, **names}.items() if value is not None}
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        try:
            connection.request(method, path, body, sent)
            response = connection.getresponse()
            return response, response.read()
        finally:
            connection.close()

    def ask(self, what, **asked):
        """Ask for something, and return the answer."""
        response, body = self.request(
            "POST", f"/api/{what}", json.dumps(asked), Content_Type="application/json"
        )
        assert response.status == 200, body
        if response.headers["Content-Type"] == "application/json":
            return json.loads(body)
        return body

    def give(self, name, content, what="drawing"):
        """Give a file."""
        response, body = self.request(
            "POST", f"/api/{what}?name={name}", content, Content_Type="application/octet-stream"
        )
        assert response.status == 200, body
        return json.loads(body)


@pytest.fixture
def opened(here):
    """Open a studio, of two drawings that lie in the current folder, or of others."""
    (here / "a.svg").write_text(svg(BAR, attributes='fill="#804000"'))
    (here / "b.svg").write_text(svg(LEAF, attributes='fill="#206080"'))
    running = []

    def open_(*files, folder="", **given):
        session = Session(Project(files or ("a.svg", "b.svg"), given), folder)
        studio = Studio(session)
        threading.Thread(target=studio.serve_forever, args=(0.02,), daemon=True).start()
        running.append((studio, session))
        return Client(studio)

    yield open_
    for studio, session in running:
        studio.shutdown()
        studio.server_close()
        session.stop()


@pytest.fixture
def client(opened):
    """A studio of two drawings."""
    return opened()
