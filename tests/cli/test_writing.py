"""What stands when writing fails, is interrupted, or meets another run; and targets that are no files."""

import errno
import json
import os
import signal
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from shapeblend_cli.cli import run, run_safely
from shapeblend_cli.job import make, targets
from shapeblend_cli.system import staging
from shapeblend_cli.system.write import is_inside
from tests.support.commands import contents, made, names, process
from tools.faults import runs
from tools.faults.aimed import strike_at

AB = ["a.svg", "b.svg", "--vertices", "12"]
BA = ["b.svg", "a.svg", "--vertices", "12"]


@pytest.fixture(autouse=True)
def here(three):
    return three


def failing(function, at):
    """A function that fails with an error of the disk when it is called for a certain time, from 1."""
    calls = []

    def call(*arguments, **options):
        calls.append(arguments)
        if len(calls) == at:
            raise OSError(errno.EIO, os.strerror(errno.EIO))
        return function(*arguments, **options)

    return call


FAILING = {
    "a folder made ready": ("fsync", 3, ["-f"]),
    "a folder exchanged": ("fsync", 7, ["-f"]),
    "a new folder": ("rename", 1, ["-o", "deep/er"]),
    "files one by one": ("replace", 2, ["-o", ".", "-f"]),
    "files and a report": ("fsync", 4, ["-o", "x.svg", "--report", "r.json"]),
    "a folder after a report": ("fsync", 6, ["-f", "-n", "2", "--report", "b.json"]),
}


@pytest.mark.parametrize(("function", "at", "arguments"), FAILING.values(), ids=FAILING)
def test_an_error_while_writing_changes_nothing_and_says_so(
    here, refused, monkeypatch, function, at, arguments
):
    assert run([*BA]) == run([*BA, "-o", "."]) == run([*BA, "-n", "0", "--report", "b.json"]) == 0
    Path("blend/mine.txt").write_text("mine")
    monkeypatch.setattr(os, function, failing(getattr(os, function), at))
    refused([*AB, *arguments], 1, "(Input/output error); nothing was changed")


def without_exchange(*_):
    raise OSError(errno.EINVAL, "")


@pytest.mark.parametrize("system", ["exchange", "two steps", "files one by one"])
def test_a_folder_is_replaced_with_all_that_is_in_it(here, monkeypatch, system):
    assert run([*BA, "-n", "3"]) == 0
    os.chmod("blend", 0o750)
    os.chmod("blend/frame-2.svg", 0o604)
    Path("blend/mine.txt").write_text("mine")
    os.symlink("mine.txt", "blend/link")
    if system != "exchange":
        monkeypatch.setattr(staging, "exchange", without_exchange)
    if system == "files one by one":
        Path("blend/inner").mkdir()
        Path("blend/inner/mine.txt").write_text("mine")
    assert run([*AB, "-n", "2", "-f"]) == 0
    assert run([*AB, "-n", "2", "-o", "alone"]) == 0
    for k in (1, 2):
        assert Path(f"blend/frame-{k}.svg").read_bytes() == Path(f"alone/frame-{k}.svg").read_bytes()
    assert Path("blend/mine.txt").read_text() == os.readlink("blend/link").replace(".txt", "") == "mine"
    assert (system != "files one by one") or Path("blend/inner/mine.txt").read_text() == "mine"
    assert stat.S_IMODE(os.stat("blend").st_mode) == 0o750
    assert stat.S_IMODE(os.stat("blend/frame-2.svg").st_mode) == 0o604
    assert not list(here.rglob(".shapeblend*"))


def test_a_folder_that_cannot_be_exchanged_in_two_steps_either_is_put_back(here, refused, monkeypatch):
    assert run([*BA, "-n", "3"]) == 0
    monkeypatch.setattr(staging, "exchange", without_exchange)
    monkeypatch.setattr(os, "rename", failing(os.rename, 2))
    refused([*AB, "-n", "3", "-f"], 1, "nothing was changed")


def test_the_folder_of_a_shell_stays_the_same_folder(here):
    assert run([*BA, "-n", "3"]) == 0
    os.chdir("blend")
    before = os.stat(".").st_ino
    assert run(["../a.svg", "../b.svg", "-n", "3", "-o", ".", "-f"]) == 0
    assert os.stat("../blend").st_ino == before


def killed(make):
    """Have a stage made in the working folder by a process that ends then, or before; return the stage."""
    if (child := os.fork()) == 0:
        make()
        os._exit(0)
    os.waitpid(child, 0)
    return next(Path().glob(f"{staging.PREFIX}*"), None)


def half_written():
    stage = staging.Stage(Path(), ["x.svg"])
    stage.make()
    (stage.new / "x.svg").write_text("half")


def test_a_run_removes_what_a_killed_one_has_left_in_the_folder_that_it_writes_to(here):
    stage = killed(half_written)
    before = contents()
    assert run([*AB, "-o", "deep/x.svg"]) == 0
    assert {path: data for path, data in contents().items() if path.parts[0] != "deep"} == before
    assert run([*AB, "-o", "x.svg"]) == 0
    assert not stage.exists()


@pytest.mark.parametrize("moment", range(1, 6))
def test_a_maker_that_is_killed_early_leaves_nothing_for_long(here, moment):
    killed(lambda: (strike_at(moment, "SIGKILL"), half_written()))
    assert run([*AB, "-o", "x.svg"]) == 0
    assert made() == ["x.svg"]


FOREIGN = {
    "another name": lambda stage: stage.rename(".shapeblend-0123456789ab"),
    "a file beside": lambda stage: (stage / "db").write_text("mine"),
    "a file inside": lambda stage: (stage / "new" / "mine.txt").write_text("mine"),
    "a folder inside": lambda stage: (stage / "new" / "mine").mkdir(),
    "a folder for a file": lambda stage: (stage / "old" / "x.svg").mkdir(parents=True),
    "a link for a folder": lambda stage: (stage / "old").symlink_to("../../mine"),
    "a link": lambda stage: stage.rename("mine").parent.joinpath(stage).symlink_to("mine"),
    "no list": lambda stage: (stage / "names").unlink(),
}


@pytest.mark.parametrize("change", FOREIGN.values(), ids=FOREIGN)
def test_a_folder_that_is_not_wholly_a_stage_stays(here, change):
    change(killed(half_written))
    before = contents()
    assert run([*AB, "-o", "y.svg", "--report", "r.json"]) == run([*BA, "-o", "y.svg", "-f"]) == 0
    assert [path for path, data in before.items() if contents().get(path) != data] == []


@pytest.mark.parametrize(
    "line",
    [
        "nowhere.svg b.svg -o x.svg",
        "a.svg b.svg -o y.svg",
        "a.svg b.svg -o y.svg/x.svg",
        "a.svg -o x.svg",
        "batch --chain . -o o/{a}.svg --dry-run",
    ],
)
def test_a_run_that_writes_nothing_removes_nothing(here, line):
    killed(half_written)
    Path("y.svg").write_text("there")
    before = contents()
    run(line.split())
    assert contents() == before


def test_the_stage_of_a_run_that_lives_stays_even_without_the_lock_of_its_folder(here):
    stage = staging.Stage(Path(), ["x.svg"])
    stage.make()
    assert run([*AB, "-o", "x.svg"]) == 0
    assert stage.new.is_dir()
    stage.remove()
    assert made() == ["x.svg"]


def test_a_file_of_others_in_a_stage_outlives_it(here):
    stage = staging.Stage(Path(), ["x.svg"])
    stage.make()
    for name in ("x.svg", "mine.txt"):
        (stage.new / name).write_text(name)
    stage.remove()
    assert [path.name for path in contents(stage.path) if path.is_file()] == ["mine.txt"]


def test_who_holds_the_lock_of_a_folder_for_long_stops_nobody(here, monkeypatch):
    # As `flock FOLDER shapeblend ...` does; then nobody knows whether the folder is being written to.
    fcntl = pytest.importorskip("fcntl")
    monkeypatch.setattr(staging, "PATIENCE", 0.05)
    stage = killed(half_written)
    handle = os.open(here, os.O_RDONLY)
    fcntl.flock(handle, fcntl.LOCK_EX)
    assert run([*AB, "-o", "x.svg"]) == 0
    os.close(handle)
    assert stage.is_dir()
    assert run([*AB, "-o", "x.svg", "-f"]) == 0
    assert made() == ["x.svg"]


def test_the_lock_of_a_folder_is_waited_for(here):
    pytest.importorskip("fcntl")
    other = staging.locked(here)
    assert other.__enter__()
    threading.Timer(0.05, other.__exit__, (None, None, None)).start()
    with staging.locked(here) as is_held:
        assert is_held


@pytest.fixture
def half_moved(here):
    """The folder as it was, after a run was killed that was moving a second frame of three into it."""
    for k in (1, 2):
        Path(f"frame-{k}.svg").write_text(f"old {k}")
    before = contents()

    def move():
        names = [f"frame-{k}.svg" for k in (0, 1, 2)]
        stage = staging.Stage(here, names)
        stage.make()
        for name in names:
            (stage.new / name).write_text("new")
        replace, calls = os.replace, []
        os.replace = lambda *paths: os._exit(0) if calls else calls.append(replace(*paths))
        stage.move(force=True)

    killed(move)
    assert Path("frame-0.svg").read_text() == Path("frame-1.svg").read_text() == "new"
    return before


def test_the_next_run_that_writes_there_puts_old_files_back_and_deletes_none(half_moved):
    assert run([*AB, "-n", "3", "-o", "."]) == 1
    assert Path("frame-1.svg").read_text() == "new"
    assert run([*AB, "-o", "x.svg"]) == 0
    Path("x.svg").unlink()
    assert contents() == half_moved | {Path("frame-0.svg"): b"new"}


def test_a_file_that_has_changed_since_is_not_put_back(half_moved):
    Path("frame-1.svg").write_text("edited")
    assert run([*AB, "-o", "x.svg"]) == 0
    assert Path("frame-1.svg").read_text() == "edited"
    assert not list(Path().glob(".shapeblend*"))


@pytest.mark.parametrize(
    ("arguments", "first"),
    [
        (["-o", "out"], "out/frame-1.svg"),
        (["-o", "deep/out"], "deep/out/frame-1.svg"),
        (["-o", "x.svg"], "x.svg"),
        (["-o", "."], "frame-1.svg"),
    ],
)
def test_what_another_run_has_written_meanwhile_stays(here, capsys, monkeypatch, arguments, first):
    write_files = targets.write_files

    def write_after_another_run(*given):
        monkeypatch.setattr(targets, "write_files", write_files)
        assert run([*BA, *arguments]) == 0
        theirs.update(contents())
        write_files(*given)

    theirs = {}
    monkeypatch.setattr(targets, "write_files", write_after_another_run)
    assert run([*AB, *arguments]) == 1
    assert capsys.readouterr().err == f"shapeblend: {first}: exists; --force replaces it\n"
    assert contents() == theirs


def test_runs_that_make_the_same_new_folder_both_get_what_they_want(here, monkeypatch):
    write_files = targets.write_files

    def write_after_another_run(*given):
        monkeypatch.setattr(targets, "write_files", write_files)
        assert run([*BA, "-o", "deep/other.svg"]) == 0
        write_files(*given)

    monkeypatch.setattr(targets, "write_files", write_after_another_run)
    assert run([*AB, "-o", "deep/one.svg"]) == 0
    assert made() == ["deep", "deep/one.svg", "deep/other.svg"]


@pytest.mark.parametrize("force", [True, False])
def test_of_two_runs_at_once_one_wins_whole(tmp_path, force):
    runs.two_at_once("folder", force, tmp_path / "two")


@pytest.mark.parametrize("name", ["shorter folder", "new folder"])
def test_a_run_that_is_killed_leaves_the_old_or_the_new(tmp_path, name):
    expected = runs.prepare(name, tmp_path / "it")
    for what, moment in (
        ("SIGKILL", expected.changes // 2),
        ("SIGTERM", expected.changes // 2),
        ("SIGKILL", expected.changes - 4),
    ):
        runs.kill_at_moves(expected, what, [moment], tmp_path / "it")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_who_is_interrupted_after_writing_is_told_the_truth(here, capsys, monkeypatch, number):
    if signal.getsignal(number) is signal.SIG_IGN:
        pytest.skip("the tests run where this signal is ignored")
    monkeypatch.setattr(targets, "print_text", lambda *_: signal.raise_signal(number))
    assert run([*AB, "-o", "x.svg"]) == 128 + number
    assert capsys.readouterr().err == "shapeblend: interrupted; all files were written\n"
    assert made() == ["x.svg"]


def test_a_signal_while_files_are_moved_waits(here, capsys, monkeypatch):
    link = os.link

    def link_and_raise(*arguments):
        signal.raise_signal(signal.SIGTERM)
        link(*arguments)

    monkeypatch.setattr(os, "link", link_and_raise)
    assert run([*AB, "-n", "3", "-o", "."]) == 143
    assert capsys.readouterr().err == "shapeblend: interrupted; all files were written\n"
    assert made() == ["frame-1.svg", "frame-2.svg", "frame-3.svg"]


@pytest.mark.parametrize(
    ("module", "name"),
    [
        *(
            (module, "SIGINT")
            for module in "shapeblend_cli.version typing click numpy svgpathtools.parser".split()
        ),
        *(("numpy", name) for name in ("SIGTERM", "SIGHUP")),
    ],
)
def test_a_signal_while_modules_load_is_one_line(here, module, name):
    code = (
        "import os, signal, sys\n"
        "for name in ('SIGTERM', 'SIGHUP'): signal.signal(getattr(signal, name), signal.SIG_DFL)\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "def watch(event, given):\n"
        f"    if event == 'import' and given[0] == '{module}': os.kill(os.getpid(), signal.{name})\n"
        "sys.addaudithook(watch)\n"
        "sys.argv = ['shapeblend', 'a.svg', 'b.svg']\n"
        "from shapeblend_cli.__main__ import main; main()\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    status = 128 + getattr(signal, name)
    assert (done.returncode, done.stderr) == (status, "shapeblend: interrupted; nothing was written\n")


def test_a_signal_while_a_class_is_made_or_an_error_is_said_is_one_line(here, capsys, monkeypatch):
    class Wraps:
        def __set_name__(self, *_):
            signal.raise_signal(signal.SIGTERM)

    monkeypatch.setattr(make, "contents_of", lambda _: type("Class", (), {"field": Wraps()}))
    assert run_safely(AB) == 143
    monkeypatch.setattr("shapeblend_cli.cli.in_words", lambda _: signal.raise_signal(signal.SIGTERM))
    monkeypatch.setattr(make, "contents_of", lambda _: 1 / 0)
    assert run_safely(AB) == 143
    assert capsys.readouterr().err == 2 * "shapeblend: interrupted; nothing was written\n"


def test_a_timeout_ends_a_run_with_nothing_written(here, refused):
    # In a process of its own, since the signal may come between the opening of a file and what would close it.
    command = [sys.executable, "-m", "shapeblend_cli", *AB, "--timeout", "0.001"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    said = "shapeblend: stopped after 0.001 s (--timeout); nothing was written\n"
    assert (done.returncode, done.stderr) == (1, said)
    assert made() == []
    refused(["inspect", "a.svg", "--timeout", "0"], 2, "--timeout must be greater than 0")
    assert run([*AB, "--timeout", "600", "--report", "r.json"]) == 0
    assert json.loads(Path("r.json").read_text())["settings"]["timeout"] == 600


@pytest.mark.parametrize("force", [[], ["-f"]])
def test_a_device_is_written_to_and_stays(here, force):
    assert run([*AB, "-n", "0", "--report", "/dev/null", *force]) == 0
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_a_full_device_is_an_error_that_says_what_stands(here, capsys):
    assert run([*AB, "-o", "x.svg", "--report", "/dev/full"]) == 1
    said = capsys.readouterr().err
    assert said == (
        "shapeblend: /dev/full: cannot be written (No space left on device); the other files were written\n"
    )
    assert made() == ["x.svg"]


def test_a_pipe_with_a_name_is_written_to_and_stays(here):
    os.mkfifo("pipe.svg")
    read = []
    reader = threading.Thread(target=lambda: read.append(Path("pipe.svg").read_bytes()))
    reader.start()
    assert run([*AB, "-o", "pipe.svg"]) == 0
    reader.join()
    assert run([*AB, "-o", "x.svg"]) == 0
    assert read == [Path("x.svg").read_bytes()]
    assert stat.S_ISFIFO(os.stat("pipe.svg").st_mode)


@pytest.mark.parametrize("name", ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"])
def test_a_stream_of_the_process_is_written_to_where_it_stands(here, name):
    assert run([*AB, "-o", "alone.svg"]) == 0
    Path("x.svg").write_text("first\n")
    command = [sys.executable, "-m", "shapeblend_cli", *AB, "-o", name]
    with open("x.svg", "ab") as stream:
        subprocess.run(command, stdout=stream, check=True)
    assert Path("x.svg").read_bytes() == b"first\n" + Path("alone.svg").read_bytes()
    reader, writer = os.pipe()
    os.close(reader)
    with open(writer, "wb") as closed:
        done = subprocess.run(command, stdout=closed, stderr=subprocess.PIPE, check=False)
    assert (done.returncode, done.stderr) == (1, b"")


def test_a_link_stays_and_the_file_it_names_is_replaced(here, refused):
    Path("real").mkdir()
    Path("real/x.svg").write_text("old")
    os.chmod("real/x.svg", 0o640)
    os.symlink("real/x.svg", "x.svg")
    refused([*AB, "-o", "x.svg"], 1, "x.svg: exists; --force replaces it")
    assert run([*AB, "-o", "x.svg", "-f"]) == 0
    assert os.readlink("x.svg") == "real/x.svg"
    assert "<svg" in Path("real/x.svg").read_text()
    assert stat.S_IMODE(os.stat("real/x.svg").st_mode) == 0o640


def test_a_link_to_a_folder_stays_and_the_folder_is_replaced(here):
    assert run([*BA, "-o", "real"]) == 0
    os.symlink("real", "blend")
    assert run([*AB, "-f"]) == 0
    assert run([*AB, "-o", "alone"]) == 0
    assert os.readlink("blend") == "real"
    assert [*contents("real").values()] == [*contents("alone").values()]


@pytest.mark.skipif(not hasattr(os, "chown") or os.geteuid() != 0, reason="only root gives files away")
def test_what_is_replaced_keeps_its_owner(here):
    assert run([*BA, "-n", "1"]) == run([*BA, "-o", "x.svg"]) == 0
    for path in ("blend", "blend/frame-1.svg", "x.svg"):
        os.chown(path, 65534, 65533)
    assert run([*AB, "-n", "1", "-f"]) == run([*AB, "-o", "x.svg", "-f"]) == 0
    for path in ("blend", "blend/frame-1.svg", "x.svg"):
        found = os.stat(path)
        assert (found.st_uid, found.st_gid) == (65534, 65533)


@pytest.mark.parametrize("option", ["--output", "--report"])
def test_an_empty_name_is_an_error(refused, option):
    refused([*AB, option, ""], 2, f"{option} must be a file name, not ''")


def test_a_file_that_cannot_be_read_has_the_status_of_one_that_is_missing(here, refused, monkeypatch):
    os.chmod("a.svg", 0)
    monkeypatch.setattr(os, "access", lambda path, mode, **_: mode != os.R_OK)
    if os.geteuid() == 0:
        monkeypatch.setattr("builtins.open", forbidden)
    refused_status = 1
    assert run(["inspect", "a.svg"]) == run(["inspect", "nowhere.svg"]) == refused_status


def forbidden(*_, **__):
    raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))


@pytest.mark.parametrize(
    "arguments", [["-o", "x" * 300 + ".svg"], ["-o", "x" * 300], ["--report", "x" * 300]]
)
def test_a_name_that_is_too_long_is_one_line(refused, arguments):
    refused([*AB, *arguments], 1, "cannot be written (File name too long)")


def test_names_that_are_not_utf_8(here, capsys):
    name = os.fsdecode(b"\xff\xfe.svg")
    os.rename("a.svg", name)
    more = ["--preview", "p.html", "--report", "r.json", "-v"]
    assert run([name, *AB[1:], "-o", os.fsdecode(b"\xff"), *more]) == 0
    assert run(["inspect", name, "--picture", "p.svg"]) == run(["plot", "graph", name, "b.svg"]) == 0
    for text in ("p.html", "p.svg", "graph.svg"):
        assert Path(text).read_text("utf-8")
    assert "Traceback" not in capsys.readouterr().err


def test_a_working_folder_that_cannot_be_written_to_is_named(here, refused, monkeypatch):
    monkeypatch.setattr(os, "access", lambda path, mode, **_: mode != os.W_OK)
    for output in ("moving.svg", "./moving.svg", "new/moving.svg"):
        refused([*AB, "-o", output], 1, f"{here}: is a folder that cannot be written to")
    Path("there").mkdir()
    refused([*AB, "-o", "there/moving.svg"], 1, "there: is a folder that cannot be written to")


@pytest.mark.parametrize(
    "line", ["{0}/a.svg {0}/b.svg", "batch --chain {0}", "studio --no-open {0}/a.svg {0}/b.svg"]
)
def test_a_working_folder_that_is_gone_is_named(here, capsys, monkeypatch, line):
    gone = here / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    monkeypatch.setenv("PWD", str(gone))
    gone.rmdir()
    assert run(line.format(here).split()) == 1
    said = (
        f"shapeblend: {gone}: the current folder is not there any more; changing to another one would work\n"
    )
    assert capsys.readouterr().err == said


def test_a_working_folder_that_is_gone_is_one_line(here, capsys):
    gone = here / "gone"
    gone.mkdir()
    os.chdir(gone)
    gone.rmdir()
    try:
        assert run([str(here / "a.svg"), str(here / "b.svg"), "-o", str(here / "out")]) == 0
        assert run(["../a.svg", "../b.svg", "-o", "x.svg"]) == 1
        assert capsys.readouterr().err.count("\n") == 1
    finally:
        os.chdir(here)


STREAMS = {
    "--help >/dev/full": (1, "standard output: cannot be written (No space left on device)"),
    "--version >/dev/full": (1, "standard output: cannot be written (No space left on device)"),
    "inspect a.svg >/dev/full": (1, "standard output: cannot be written (No space left on device)"),
    "inspect a.svg --json >/dev/full": (1, "standard output: cannot be written (No space left on device)"),
    "inspect a.svg >&-": (1, "standard output: cannot be written (Bad file descriptor)"),
    "a.svg b.svg -o - >&-": (1, "standard output: cannot be written (Bad file descriptor)"),
    "a.svg b.svg --report - >/dev/full": (
        1,
        "standard output: cannot be written (No space left on device); the files were written",
    ),
    "a.svg b.svg >&-": (0, ""),
    "a.svg b.svg -v 2>&-": (0, ""),
    "a.svg b.svg -v 2>/dev/full": (0, ""),
    "a.svg b.svg -v <&- >&- 2>&-": (0, ""),
    "nowhere.svg b.svg 2>&-": (1, ""),
}


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
@pytest.mark.parametrize(("line", "expected"), STREAMS.items())
def test_streams_that_are_closed_or_full(here, line, expected):
    command = f"'{sys.executable}' -m shapeblend_cli {line}"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False)
    status, words = expected
    assert (done.returncode, done.stderr) == (status, words and f"shapeblend: {words}\n")
    assert bool(names("blend")) == ("were written" in words or status == 0)


def test_the_fresh_folder_is_one_step(here, monkeypatch):
    # Whoever looks sees no folder of frames, or all of it.
    seen = []
    rename = os.rename
    monkeypatch.setattr(os, "rename", lambda *given: (seen.append(made()), rename(*given)))
    assert run([*AB, "-o", "deep/er"]) == 0
    assert [name for name in seen[0] if staging.PREFIX not in name] == ["deep"]


def test_a_path_lies_in_a_folder_where_links_lead(here):
    (here / "own" / "deep").mkdir(parents=True)
    (here / "own" / "out").symlink_to(here)
    inside = [is_inside(Path(path), "own") for path in ("own/a", "own/deep/b", "own/x/../c", here / "own/d")]
    outside = [is_inside(Path(path), "own") for path in ("a", "own/../a", "own/out/a", "owner/a", "/etc/a")]
    assert inside == [True] * 4
    assert outside == [False] * 5


@pytest.mark.skipif(not os.path.exists("/dev/fd/1"), reason="needs /dev/fd")
@pytest.mark.parametrize("output", ["-", "/dev/fd/1"])
def test_a_pipe_on_standard_output_gets_what_a_file_would(here, output):
    printed = process(*AB, "-o", output).stdout
    assert made() == []
    assert run([*AB, "-o", "x.svg"]) == 0
    assert printed == Path("x.svg").read_bytes()
