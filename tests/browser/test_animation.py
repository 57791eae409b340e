"""The animated SVG in a real browser."""

import json
import os
import re
import shutil
import subprocess

import numpy as np
import pytest

from shapeblend_cli.cli import run

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
if CHROMIUM is None and os.environ.get("CI") == "true":
    raise RuntimeError("no Chromium here: make test installs it")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here: apt-get install chromium")

FLAGS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync"),
    *("--disable-background-networking", "--disable-component-update", "--virtual-time-budget=4000"),
)

# Stops the animation at each time and notes what the browser makes of the path then.
SCRIPT = """<script>
onload = async () => {
  const svg = document.querySelector("svg"), path = svg.querySelector("path"), seen = [];
  svg.pauseAnimations();
  for (const t of TIMES) {
    svg.setCurrentTime(t);
    await new Promise((done) => setTimeout(done, 100));
    const style = getComputedStyle(path);
    seen.push({d: style.d, fill: style.fill, length: path.getTotalLength()});
  }
  document.body.textContent = JSON.stringify(seen);
};
</script>"""


def seen_by_browser(folder, svg, times):
    page = folder / "page.html"
    page.write_text(
        f"<!doctype html><body>{svg}{SCRIPT.replace('TIMES', json.dumps(times))}", encoding="utf-8"
    )
    done = subprocess.run(
        [CHROMIUM, *FLAGS, f"--user-data-dir={folder / 'profile'}", "--dump-dom", page.as_uri()],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    text = re.search(r"<body>(.*)</body>", done.stdout, re.DOTALL).group(1)
    return json.loads(text.replace("&quot;", '"'))


def vertices(path_data):
    return np.array([float(v) for v in re.findall(r"-?[\d.]+(?:e-?\d+)?", path_data)]).reshape(-1, 2)


def test_it_moves_from_a_to_b_through_the_frames(tmp_path, samples, monkeypatch):
    monkeypatch.chdir(tmp_path)
    files = [str(samples / name) for name in ("bird-1.svg", "bird-2.svg")]
    assert run([*files, "-o", "moving.svg"]) == 0
    assert run([*files, "-n", "3", "--ends", "-o", "frames"]) == 0
    seen = seen_by_browser(tmp_path, (tmp_path / "moving.svg").read_text(), [0.0, 0.5, 1.0, 1.5, 1.9999999])

    frames = [(tmp_path / f"frames/frame-{k}.svg").read_text() for k in range(1, 6)]
    for moment, frame in zip(seen[1:-1], frames[1:-1], strict=True):
        expected = vertices(re.search(r' d="([^"]*)"', frame).group(1))
        np.testing.assert_allclose(vertices(moment["d"]), expected, atol=0.01)
    assert seen[0]["fill"] != seen[2]["fill"] != seen[4]["fill"]
    assert abs(seen[0]["length"] - seen[4]["length"]) > 1.0
