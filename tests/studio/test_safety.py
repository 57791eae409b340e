"""Nobody but the page of a studio uses it, and nothing that is dropped into it does harm."""

import json
import re
import socket
import time
from xml.etree import ElementTree

import pytest

from shapeblend_cli.studio import server
from shapeblend_cli.studio.server import ASSETS, POLICY
from tests.support.commands import wait_until
from tests.support.drawings import BAR, LEAF, svg

pytestmark = pytest.mark.usefixtures("forked")

PROJECT = {"files": ["a.svg", "b.svg"]}
LOOK = json.dumps({"project": PROJECT})
TYPE = {"Content_Type": "application/json"}


def test_it_listens_on_this_machine_alone(client):
    assert client.studio.server_address[0] == "127.0.0.1"
    assert client.studio.socket.family == socket.AF_INET
    assert len(client.studio.token) >= 32


def test_two_studios_have_their_own_ports_and_tokens(opened):
    one, other = opened(), opened()
    assert one.port != other.port
    assert one.studio.token != other.studio.token
    response, _ = other.request("POST", "/api/look", LOOK, **TYPE, Cookie=one.own["Cookie"])
    assert response.status == 403


def test_the_token_becomes_a_cookie_that_scripts_and_other_sites_do_not_get(client):
    path = client.studio.address.partition(str(client.port))[2]
    response, body = client.request("GET", path, Cookie=None, Origin=None, Sec_Fetch_Site="none")
    assert response.status == 200
    cookie = response.headers["Set-Cookie"]
    assert {"HttpOnly", "SameSite=Strict", "Path=/"} <= set(cookie.split("; "))
    assert client.studio.token.encode() not in body


@pytest.mark.parametrize("path", ["/", "/main.js", "/studio.css", "/?token=wrong", "/?token="])
def test_without_the_cookie_there_is_no_page(client, path):
    response, body = client.request("GET", path, Cookie=None, Origin=None, Sec_Fetch_Site="none")
    assert response.status == 403
    assert b"<script" not in body


WRONG = {
    "no cookie": {"Cookie": None},
    "another token": {"Cookie": "shapeblend-1=x; a=b"},
    "another origin": {"Origin": "https://example.org"},
    "the same machine, another port": {"Origin": "http://127.0.0.1:1"},
    "no origin": {"Origin": None},
    "an origin without a name": {"Origin": "null"},
    "another site": {"Sec_Fetch_Site": "cross-site"},
    "the same site, another origin": {"Sec_Fetch_Site": "same-site"},
    "another host": {"Host": "example.org"},
    "another host at this port": {"Host": "example.org:{port}"},
    "no type": {"Content_Type": None},
    "the type of a form": {"Content_Type": "text/plain"},
}


@pytest.mark.parametrize("wrong", WRONG)
def test_requests_from_elsewhere_are_refused(client, here, wrong):
    headers = {
        name: value and value.format(port=client.port) for name, value in (TYPE | WRONG[wrong]).items()
    }
    for what in ("look", "write", "begin"):
        response, body = client.request("POST", f"/api/{what}", LOOK, **headers)
        assert 400 <= response.status < 500, what
        assert b"a.svg" not in body
    assert sorted(path.name for path in here.iterdir()) == ["a.svg", "b.svg"]


def test_the_page_may_load_and_ask_for_nothing_elsewhere(client):
    for path in ("/", *(f"/{name}" for name in ASSETS)):
        response, body = client.request("GET", path)
        assert response.status == 200, path
        assert response.headers["Content-Security-Policy"] == POLICY
        assert response.headers["X-Content-Type-Options"] == "nosniff"
        text = body.decode()
        assert not re.search(
            r"\beval\(|new Function|innerHTML|outerHTML|insertAdjacentHTML|document\.write", text
        )
        addresses = set(re.findall(r"https?://[^\s\"'`]+", text))
        assert addresses <= {"http://www.w3.org/2000/svg"}
        if path == "/":
            assert not re.search(r"<style|style=|\son\w+=|<script(?![^>]* src=)", text)
    assert "unsafe" not in POLICY
    assert "default-src 'none'" in POLICY


@pytest.mark.parametrize(
    "path", ["/../secret", "/..%2fsecret", "/server.py", "/answers.py", "/api/look", "//x", "/%00"]
)
def test_nothing_but_its_own_files_is_served(client, path):
    assert client.request("GET", path)[0].status in (403, 404, 421)


@pytest.mark.parametrize("name", ["/etc/passwd", "../a.svg", "c.svg"])
def test_files_that_nobody_opened_are_not_read(client, here, name):
    (here / "c.svg").write_text(svg(BAR))
    answer = client.ask("look", project={"files": ["a.svg", name]})
    if name == "../a.svg":  # the page knows no folders: that is the drawing of this name
        assert "error" not in answer
    else:
        assert "not open here" in answer["error"]


BOMB = (
    '<?xml version="1.0"?><!DOCTYPE svg [<!ENTITY a "aaaaaaaaaaaaaaaa">'
    + "".join(f'<!ENTITY {q} "{f"&{p};" * 12}">' for p, q in zip("abcdefgh", "bcdefghi", strict=True))
    + ']><svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H9V9Z" id="&i;"/></svg>'
)
OUTSIDE = (
    '<?xml version="1.0"?><!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]>'
    '<svg xmlns="http://www.w3.org/2000/svg"><title>&x;</title><path d="M0 0H9V9Z"/></svg>'
)
HOSTILE = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 24 24" '
    'onload="alert(1)"><script>alert(2)</script><style>@import url(https://example.org/x.css); '
    "path { fill: url(https://example.org/x.svg#p) }</style>"
    '<foreignObject width="9" height="9"><iframe xmlns="http://www.w3.org/1999/xhtml" src="javascript:alert(3)"/>'
    '</foreignObject><image href="https://example.org/x.png" width="9" height="9"/>'
    '<use xlink:href="https://example.org/x.svg#y"/><a href="javascript:alert(4)">'
    f'<path d="{LEAF}" id="&quot;&gt;&lt;script&gt;alert(5)&lt;/script&gt;" onclick="alert(6)" '
    'style="fill:#123456;background:url(https://example.org/z)"/></a>'
    '<animate attributeName="href" values="javascript:alert(7)"/><set attributeName="onmouseover" to="alert(8)"/></svg>'
)


def test_of_a_hostile_drawing_only_outlines_and_plain_paint_get_into_the_page(client):
    name = client.give("evil.svg", HOSTILE.encode())["name"]
    answer = client.ask("look", project={"files": ["a.svg", name]})
    drawing = answer["drawings"][1]
    text = json.dumps([drawing["paths"], drawing["contours"], answer["pairs"]])
    assert "M3,14" in text
    assert not re.search(r"alert|script|example\.org|javascript|foreignObject|onload|onclick|url\(", text)
    allowed = {
        "d",
        "fill",
        "stroke",
        "fill-rule",
        "fill-opacity",
        "stroke-width",
        "stroke-opacity",
        "opacity",
    }
    for path in drawing["paths"]:
        assert set(path) == {"path"}
        assert set(path["path"]) <= allowed | {"stroke-linecap", "stroke-linejoin", "stroke-miterlimit"}
    others = client.ask("others", project={"files": ["a.svg", name]})["others"]
    assert others
    for picture in (picture for other in others for picture in other["pictures"]):
        for element in ElementTree.fromstring(picture).iter():
            assert element.tag.rpartition("}")[2] in ("svg", "g", "path", "defs", "title", "desc")
            for name, value in element.attrib.items():
                assert not name.startswith("on")
                assert "href" not in name
                assert name in ("id", "class") or not re.search(r"alert|example\.org|javascript|url\(", value)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (BOMB, "evil.svg"),
        (OUTSIDE, "evil.svg"),
        (svg("<g>" * 2000 + "</g>" * 2000), "evil.svg"),
        ("no drawing", "evil.svg"),
        ("", "empty"),
        (svg(BAR)[:40], "well-formed"),
    ],
)
def test_bombs_and_what_is_no_drawing_are_refused_in_a_line_and_the_studio_goes_on(client, content, said):
    name = client.give("evil.svg", content.encode())["name"]
    answer = client.ask("look", project={"files": ["a.svg", name]})
    if "error" in answer:  # an entity outside is left out, as the command does
        assert said in answer["error"]
        assert "\n" not in answer["error"]
    assert "root:" not in json.dumps(answer)
    assert "error" not in client.ask("look", project=PROJECT)


@pytest.mark.parametrize(
    "name", ["../../x.svg", "/etc/x.svg", "..%2F..%2Fx.svg", "-o.svg", "a%00b.svg", "C:%5Cx.svg", ".."]
)
def test_names_of_dropped_files_are_names_alone(client, name):
    taken = client.give(name, svg(BAR).encode())["name"]
    assert not re.search(r"[/\\\0]|^-|^\.\.", taken)
    assert "error" not in client.ask("look", project={"files": [taken, "b.svg"]})


def test_too_much_is_refused_before_it_is_read(client):
    for path, kind, length in (
        ("/api/look", "application/json", 2**23),
        ("/api/drawing?name=a.svg", "application/octet-stream", 2**27),
    ):
        response, _ = client.request("POST", path, b"", Content_Type=kind, Content_Length=str(length))
        assert response.status == 413
    response, _ = client.request("POST", "/api/look", "[" * 100_000, **TYPE)
    assert response.status == 400


BODIES = {"headers": b"GET / HTTP/1.1\r\nA: ", "body": b"POST /api/look HTTP/1.1\r\nContent-Length: 1000\r\n"}


@pytest.mark.parametrize("part", BODIES)
def test_a_request_that_trickles_in_is_cut_off(client, monkeypatch, part):
    monkeypatch.setattr(server, f"{part.upper()}_TIME", 0.5)
    begun = BODIES[part]
    if part == "body":
        sent = client.own | {"Content-Type": "application/json"}
        begun += "".join(f"{name}: {value}\r\n" for name, value in sent.items()).encode() + b"\r\n"
    with socket.create_connection(("127.0.0.1", client.port)) as connection:
        connection.sendall(begun)
        connection.settimeout(0.05)
        said, end = None, time.monotonic() + 20
        while not said and time.monotonic() < end:
            try:
                said = connection.recv(1000) or b"closed"
            except TimeoutError:
                connection.sendall(b"x")
            except ConnectionError:
                said = b"closed"
    assert said is not None
    assert said == b"closed" if part == "headers" else said.startswith(b"HTTP/1.1 408 ")


def test_of_too_many_connections_the_last_are_turned_away(opened, monkeypatch):
    monkeypatch.setattr(server, "MOST_CONNECTIONS", 3)
    client = opened()
    held = [socket.create_connection(("127.0.0.1", client.port)) for _ in range(3)]
    assert client.request("GET", "/")[0].status == 503
    for connection in held:
        connection.close()
    wait_until(lambda: client.request("GET", "/")[0].status == 200)


def test_a_blend_that_hangs_is_stopped_and_the_studio_goes_on(opened, here):
    jagged = "M" + " ".join(f"{k % 97} {(k * 37) % 89}" for k in range(1500)) + "Z"
    (here / "slow.svg").write_text(svg(jagged, viewbox="0 0 100 100"))
    client = opened("slow.svg", "b.svg", "a.svg", timeout=0.7)
    answer = client.ask(
        "look", project={"files": ["slow.svg", "slow.svg"], "effort": "exact", "vertices": 4000}
    )
    assert "took more than 0.7 s, and was stopped" in answer["error"]
    assert answer["command"].startswith("shapeblend slow.svg slow.svg")
    client.studio.session._seconds = 30.0
    assert "error" not in client.ask("look", project=PROJECT)


def test_nothing_is_written_unless_it_is_asked_for(client, here):
    client.ask("begin")
    client.ask(
        "look", project=PROJECT | {"output": "moving.svg", "report": "report.json", "preview": "page.html"}
    )
    client.ask("others", project=PROJECT)
    client.ask("download", project=PROJECT | {"output": "moving.svg"})
    client.ask("keep", project=PROJECT)
    client.give("c.svg", svg(BAR).encode())
    assert sorted(path.name for path in here.iterdir()) == ["a.svg", "b.svg"]
