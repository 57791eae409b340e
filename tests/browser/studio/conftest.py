"""A studio in a page of the browser."""

import shutil
import threading

import pytest

from shapeblend_cli.rows.project import Project
from shapeblend_cli.studio.process import Process
from shapeblend_cli.studio.server import Studio
from shapeblend_cli.studio.session import Session
from tests.support.drawings import BAR, LEAF, svg
from tests.support.studio_page import SAMPLES, SWAPPED, TWO


@pytest.fixture(scope="session")
def room(tmp_path_factory):
    """A folder for the studios of all tests, one after the other, and processes that stay warm in it."""
    warm = []
    yield tmp_path_factory.mktemp("studio"), warm
    for process in warm:
        process.close()


@pytest.fixture
def here(room, samples, monkeypatch):
    """The folder, which is the current one, with nothing but drawings to begin with."""
    folder, _ = room
    for path in folder.iterdir():
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    monkeypatch.chdir(folder)
    for name in SAMPLES:
        (folder / name).write_bytes((samples / name).read_bytes())
    for name, paths in {"two": TWO, "swapped": SWAPPED, "bar": [BAR], "leaf": [LEAF]}.items():
        (folder / f"{name}.svg").write_text(svg(*paths, attributes='fill="#222"'))
    return folder


@pytest.fixture
def studio(browser, room, here):
    """Open a studio in a page. Nothing may go wrong in it, and nothing may be asked for elsewhere."""
    _, warm = room
    running, wrong, asked = [], [], []

    def open_(*files, width=1280, height=900, scheme="light", touch=False, folder="", **given):
        session = Session(Project(files, given), folder)
        session._live, session._slow = (warm.pop() if warm else Process() for _ in range(2))
        server = Studio(session)
        session.start()
        threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True).start()
        context = browser.new_context(
            viewport={"width": width, "height": height},
            color_scheme=scheme,
            reduced_motion="reduce",
            has_touch=touch,
            accept_downloads=True,
        )
        running.append((server, session, context))
        page = context.new_page()
        page.on("console", lambda message: wrong.append(f"{message.type}: {message.text}"))
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        page.goto(server.address)
        page.wait_for_selector("html[data-ready]")
        return page

    yield open_
    own = tuple(f"http://{host}/" for server, *_ in running for host in server.hosts)
    for server, session, context in running:
        context.close()
        server.shutdown()
        server.server_close()
        for process in (session._live, session._slow):
            # One that still works on an order is ended.
            process.close() if process._turn.locked() else warm.append(process)
    assert [url for url in asked if not url.startswith((*own, "data:", "blob:"))] == []
    assert wrong == []
