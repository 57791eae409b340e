"""Every command and every block of code that the documents and the help show, run as it stands there.

Commands of shapeblend run in this process, each in a folder of its own that has what it names. `NOT_RUN` lists what is
not run here, and why.
"""

import io
import itertools
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import webbrowser
from importlib.util import find_spec
from pathlib import Path
from urllib.request import HTTPCookieProcessor, build_opener

import pytest
import yaml

from shapeblend_cli.cli import run
from tests.support.documents import ROOT, blocks, commands, furnish
from tests.support.drawings import svg

pytestmark = pytest.mark.usefixtures("blended_once")

PLACEHOLDERS = {"FILE": "a.svg", "KIND": "graph", "COMMAND": "plot"}

NOT_RUN = {
    "uv tool install": "takes packages from the network; tests/wheels installs what is built",
    "pipx install": "the same",
    "pip install": "the same",
    "gh attestation verify": "asks GitHub",
    "man shapeblend": "shows what is installed; tests/test_docs.py draws the page",
    "dask": "runs until it is stopped; tests/cluster starts a cluster",
    "shapeblend batch jobs.csv --cluster": "needs that cluster; tests/cluster runs it",
    "parallel": "not on every machine; tests/batch/test_recipes.py runs it where it is",
    "inkscape": "not on every machine; tests/inkscape runs it where it is",
    "python -m tools": "measures for minutes; the module and its options are looked for here",
    "sbatch": "needs Slurm; tests/batch/test_recipes.py does what it does",
    "make": "sets up, tests or measures for minutes; its targets are looked for here",
}
"""How a command begins that is not run here, and why."""

SHOWN = commands()
RUN = [shown for shown in SHOWN if not shown.line.startswith(tuple(NOT_RUN))]
OF_MAKE, OF_TOOLS = (
    [shown for shown in SHOWN if shown.line.startswith(start)] for start in ("make ", "python -m tools")
)
OUTPUTS = {"-o", "--sheet", "--results", "--preview", "--summary", "--log-file"}


@pytest.fixture
def kitchen(here, forked, monkeypatch):
    """A working folder with all that commands name, and no one's settings."""
    furnish()
    variables = {"ARRAY_TASK_ID": "1", "ARRAY_TASK_COUNT": "2", "CPUS_PER_TASK": "1"}
    for name, value in variables.items():
        monkeypatch.setenv(f"SLURM_{name}", value)
    monkeypatch.setenv("HOME", str(here))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(here / "config"))
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(webbrowser, "open", look_and_leave)
    return here


def written_at():
    """All files in the working folder, and when they were written."""
    return {path: path.stat().st_mtime_ns for path in Path().rglob("*")}


def look_and_leave(address):
    """A browser that takes the page of the studio, after which Ctrl-C is pressed."""
    with build_opener(HTTPCookieProcessor()).open(address, timeout=30) as page:
        assert b"<title>" in page.read()
    os.kill(os.getpid(), signal.SIGINT)


def ours(words, given, monkeypatch):
    """What shapeblend prints for these words, with what it is given as standard input."""
    words = [PLACEHOLDERS.get(word, os.path.expandvars(word)) for word in words]
    written = [name for flag, name in itertools.pairwise(words) if flag in OUTPUTS]
    for name in written:
        if Path(name).is_file():
            Path(name).unlink()  # a drawing of another command
    printed = io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True)
    with monkeypatch.context() as streams:
        streams.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(given or b"")))
        streams.setattr(sys, "stdout", printed)
        assert run(words) == 0
    for name in written:
        assert list(Path().glob(re.sub(r"{\w}", "*", name))), f"{name} was not written"
    return printed.buffer.getvalue()


def what_it_does(shown, monkeypatch):
    """What a line of a shell prints."""
    printed = b""
    for program, *words in shown.stages:
        if program == "shapeblend":
            printed = ours(words, printed, monkeypatch)
        elif program == "curl":
            (address,) = words
            printed = Path(address.rpartition("/")[2]).read_bytes()
        elif program == "eval":
            (inner,) = re.findall(r"^\$\(shapeblend (.*)\)$", *words)
            printed = ours(inner.split(), b"", monkeypatch)
            if shell := shutil.which(inner.split()[-1]):
                subprocess.run([shell, "-n"], input=printed, check=True)
        else:
            command = ["sh", "-c", shown.line] if program == "echo" else [program, *words]
            command[:1] = [sys.executable] if program == "python" else command[:1]
            printed = subprocess.run(command, input=printed, stdout=subprocess.PIPE, check=True).stdout
    return printed


@pytest.mark.parametrize("shown", RUN, ids=lambda shown: f"{shown.page}: {shown.line}")
def test_a_command_that_is_shown_works(shown, kitchen, monkeypatch):
    if re.search(r"\.(mp4|webm)\b", " ".join(shown.stages[0])) and shutil.which("ffmpeg") is None:
        pytest.skip("needs ffmpeg")
    before = written_at()
    printed = what_it_does(shown, monkeypatch)
    assert printed or written_at() != before or "import" in shown.line


def test_what_is_not_run_is_still_shown():
    for start, reason in NOT_RUN.items():
        assert any(shown.line.startswith(start) for shown in SHOWN), start
        for path in re.findall(r"tests/[\w/.]+", reason):
            assert (ROOT / path).exists()


def test_most_commands_are_run():
    assert len(RUN) >= 80
    assert len({shown.page for shown in RUN}) >= 15


def test_a_target_that_is_shown_is_there():
    rules = "".join(found.text for found in blocks() if found.language == "make")
    makefile = (ROOT / "Makefile").read_text("utf-8")
    for shown in OF_MAKE:
        _, target, *settings = shown.stages[0]
        is_ours = re.search(rf"^{target}:.*##", makefile, re.MULTILINE)
        assert is_ours or f"{target.partition('/')[0]}/%.svg:" in rules, shown
        for name in (setting.partition("=")[0] for setting in settings):
            assert f"$({name})" in makefile or f"$(if $({name})," in makefile, shown


def test_a_tool_that_is_shown_is_there():
    for shown in OF_TOOLS:
        _, _, module, *words = shown.stages[0]
        origin = Path(find_spec(module).origin)
        sources = [source for source in (origin, origin.with_name("__main__.py")) if source.exists()]
        text = "".join(source.read_text("utf-8") for source in sources)
        assert all(word in text for word in words if not word.isupper()), shown


def of(language, page):
    """The blocks of a language in a page, as one text."""
    return "\n".join(found.text for found in blocks() if (found.language, found.page) == (language, page))


def test_python_that_is_shown_runs(kitchen):
    names = {}
    for found in blocks():
        if (found.language, found.page) == ("python", "docs/guide.md"):
            exec(found.text, names)
    assert len(list(Path("frames").iterdir())) == 11
    assert "<animate" in Path("moving.svg").read_text("utf-8")
    assert 0.0 < names["match"].lower_bound < names["match"].work


def test_manifests_that_are_shown_work(kitchen):
    """Each is read, and says the same of the jobs that they have in common."""
    others = [
        found
        for found in blocks()
        if found.page == "docs/batch.md" and found.language in ("jsonl", "csv", "toml")
    ]
    *manifests, result = others
    assert [found.language for found in manifests] == ["jsonl", "csv", "toml"]
    for found in manifests:
        Path(f"shown.{found.language}").write_text(found.text, "utf-8")
        assert (
            run(["batch", f"shown.{found.language}", "--results", "results.jsonl", "--force", "-j", "1"]) == 0
        )
        rows = [json.loads(line) for line in Path("results.jsonl").read_text("utf-8").splitlines()]
        assert {row["status"] for row in rows} == {"done"}
    assert json.loads(result.text).keys() <= rows[0].keys()


@pytest.mark.skipif(shutil.which("make") is None, reason="needs make")
def test_the_rule_for_make_works(kitchen):
    Path("Makefile").write_text(of("make", "docs/cookbook.md"), "utf-8")
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    again = [
        subprocess.run(
            ["make", "moving/wifi.svg"], env={**os.environ, "PATH": path}, capture_output=True, text=True
        )
        for _ in range(2)
    ]
    assert [done.returncode for done in again] == [0, 0], again[0].stderr
    assert Path("moving/wifi.svg").exists()
    assert "up to date" in again[1].stdout


def test_the_command_in_continuous_integration_works(kitchen):
    (job,) = yaml.safe_load(of("yaml", "docs/cookbook.md"))["jobs"].values()
    (line,) = [step["run"] for step in job["steps"] if "run" in step]
    program, *words = shlex.split(line)
    assert (program, words[0]) == ("uvx", "shapeblend")
    assert run(words[1:]) == 0
    assert Path("moving/wifi.svg").exists()


@pytest.mark.parametrize("page", ["docs/cookbook.md", "docs/guide.md"])
def test_both_files_of_a_pair_have_the_ids_that_are_named(page, kitchen):
    assert run("play.svg pause.svg --emit pair -o pair".split()) == 0
    (name,) = {*re.findall(r"#(shape-\d+)", of("css", page))}
    assert all(f'id="{name}"' in Path(f"pair/{side}.svg").read_text("utf-8") for side in "ab")


def test_what_scripts_and_pages_say_to_states_is_there(kitchen):
    ((name, value),) = re.findall(r"dataset\.(\w+) = \"(\w+)\"", of("js", "docs/states.md"))
    assert run("states play.svg pause.svg stop.svg -o player.svg".split()) == 0
    text = Path("player.svg").read_text("utf-8")
    assert f'[data-{name}="{value}"]' in text
    assert run("states play.svg pause.svg stop.svg -o player.js".split()) == 0
    (file,), ((element, attributes),) = (
        re.findall(pattern, of("html", "docs/states.md"))
        for pattern in (r'src="([^"]+)"', r"<(player-[\w-]+) (.*?)>")
    )
    module = Path(file).read_text("utf-8")
    for word in (element, *re.findall(r"(\w+)=", attributes)):
        assert f'"{word}"' in module


def test_the_timetable_of_the_guide_is_taken(here):
    for name, y in {"a": 2, "b": 12}.items():
        shapes = (f'<path id="{id}" d="M{x} {y}h6v6h-6z"/>' for id, x in {"sun": 2, "moon": 12}.items())
        Path(f"{name}.svg").write_text(svg(*shapes), "utf-8")
    Path("timing.json").write_text(of("json", "docs/guide.md"), "utf-8")
    assert run("a.svg b.svg --timing timing.json -o moving.svg".split()) == 0
    assert re.findall('keyTimes="(.*?)"', Path("moving.svg").read_text("utf-8")) == ["0;0.5;1"] * 2


def test_every_block_is_of_a_language_that_is_run():
    """Those of `docs/api.md` are from docstrings, which are run as tests.

    tests/batch has the other rule for make, and tests/browser opens the pages of the cookbook.
    """
    others = {(found.language, found.page) for found in blocks() if found.language != "sh"}
    assert others == {
        ("pycon", "docs/api.md"),
        ("python", "docs/api.md"),
        ("python", "docs/guide.md"),
        *((language, "docs/batch.md") for language in ("csv", "jsonl", "toml", "make")),
        ("make", "docs/cookbook.md"),
        ("yaml", "docs/cookbook.md"),
        ("css", "docs/cookbook.md"),
        ("html", "docs/cookbook.md"),
        ("html", "docs/coming-from.md"),
        ("jsx", "docs/cookbook.md"),
        ("svelte", "docs/cookbook.md"),
        ("css", "docs/guide.md"),
        ("json", "docs/guide.md"),
        ("js", "docs/states.md"),
        ("html", "docs/states.md"),
        ("json", "docs/studio.md"),
    }
