"""Which room may look into which, by imports and by calls, and how large functions, files and rooms are."""

import ast
import cProfile
import os
import re
import sys
import tomllib
from collections import Counter
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import shapeblend_cli
from shapeblend_cli.cli import run
from tests.support.drawings import BAR, EYED, LEAF, SQUARES, svg

PACKAGE = Path(shapeblend_cli.__file__).parent

# For each room, the rooms it may look into besides itself. Arrows point down: a room stands above those it looks into.
# A room is a module or a folder; the longest name that fits a module is its room.
ROOMS = {
    "__main__": "cli",
    "cli": "studio batch plot inkscape rows job outputs options svg.reading system errors version",
    "__init__": "api outputs options errors model version",
    "studio": "rows job blending preview outputs frames svg.writing options svg.reading system errors "
    "model version",
    "api": "job pipeline outputs wires frames svg.writing options svg.reading paint system errors model version",
    "batch": "rows job blending outputs svg.writing options svg.reading system errors model version",
    "plot": "job pens wires matching svg.writing options svg.reading anatomy geometry system errors model",
    "rows": "job options system errors",
    "inkscape": "pipeline outputs frames svg.writing options svg.reading geometry paint svg.xml system errors model",
    "job": "pipeline blending grading pens preview outputs frames matching svg.writing options svg.reading "
    "anatomy interpolate geometry paint system errors model version",
    "pipeline": "blending wires frames options anatomy interpolate paint system model",
    "blending": "brushes pens grading pairing wires frames motion options anatomy interpolate images geometry paint "
    "system errors model",
    "brushes": "pens motion options geometry model",
    "pens": "wires matching motion options anatomy geometry _cython errors model",
    "pairing": "wires motion options anatomy geometry errors model",
    "preview": "wires frames matching svg.writing options svg.reading interpolate geometry paint model",
    "outputs": "web frames svg.writing options interpolate images paint system errors model",
    "wires": "matching options anatomy geometry errors model",
    "frames": "options interpolate geometry paint errors model",
    "matching": "options _cython errors model",
    "svg.writing": "options paint model",
    "web": "options",
    "motion": "interpolate geometry model",
    "grading": "geometry model",
    "options": "svg.styles errors",
    "svg.reading": "svg.effects svg.styles geometry images svg.xml errors model svg.libraries",
    "svg.effects": "svg.styles geometry images svg.xml model",
    "anatomy": "geometry errors model",
    "interpolate": "geometry paint _cython model",
    "svg.styles": "svg.xml",
    "images": "_cython model",
    "geometry": "_cython model",
    "paint": "model",
    "svg.xml": "model",
    "system": "errors _cython",
    "_cython": "",
    "errors": "",
    "model": "",
    "svg": "",
    "svg.libraries": "",
    "version": "",
}

# Libraries that only some rooms know. numpy and the standard library are everybody's.
LIBRARIES = {
    "click": "cli",
    "rich": "cli",
    "svgpathtools": "svg.libraries",
    "tinycss2": "svg.styles svg.effects",
    "cssselect2": "svg.styles",
    "svgwrite": "svg.writing",
    "PIL": "outputs images",
    "resvg_py": "outputs",
    "coloraide": "svg.styles",
    "distributed": "batch",
    "lap": "geometry",
    "fontTools": "svg.reading",
    "brotli": "svg.reading",
    "uharfbuzz": "svg.reading",
    "cython": "geometry images interpolate matching pens system",
    "mapbox_earcut": "images",
    "pathops": "anatomy",
}
SHARED = {"numpy", *sys.stdlib_module_names}

# What a room hands to one below it, which calls it there.
HANDED_DOWN = {
    *(
        "Terminal.note",
        "Terminal.warn",
        "watch_part.<locals>.<lambda>",
        "Progress.tell",
        "Terminal.progress",
    ),  # how far a run has come
    # A `Motion`, which `model` declares.
    *(
        f"{motion}.{what}"
        for motion in ("Rigid", "Intrinsic", "Sweep", "Pen", "Together", "Inlaid", "Posed", "Early")
        for what in ("name", "segments")
    ),
    "Intrinsic.expect",  # the outlines at all times that a shape is asked for, found together
    "_Figures.__call__",  # those of a `Correspondence` that only reports have
    "Proof.__call__",  # the lower bound of a `Correspondence`, searched for when it is asked for
    *("Settings._defaults", "WorkConstants._defaults"),  # a `Record` asks what it is made of
}

MOST_PARAMETERS, MOST_LINES, LONGEST_FILE, MOST_FILES = 8, 60, 500, 14

# Names of files that are there twice: a shorter list is better.
REPEATED = {"__init__.py", "options.py", "graph.py"}

SOURCES = [file for file in PACKAGE.rglob("*") if file.suffix in (".py", ".js", ".css", ".html")]


def module_name(file):
    """The name of a module without the package's: `svg.reading.read`."""
    parts = Path(file).relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts[:-1] if len(parts) > 1 and parts[-1] == "__init__" else parts)


@cache
def trees():
    """The syntax tree of each module."""
    return {module_name(file): ast.parse(file.read_text("utf-8")) for file in sorted(PACKAGE.rglob("*.py"))}


@cache
def nodes(module):
    """All nodes of its tree."""
    return [*ast.walk(trees()[module])]


_PROJECT = tomllib.loads((PACKAGE.parent / "pyproject.toml").read_text("utf-8"))["tool"]
KERNELS = {module_name(PACKAGE.parent / kernel) for kernel in _PROJECT["shapeblend"]["kernels"]}


def room(module):
    rooms = [name for name in ROOMS if f"{module}.".startswith(f"{name}.")]
    assert rooms, f"{module} is in no room: give it a line in ROOMS"
    return max(rooms, key=len)


def rooms_below(name):
    """A room with all that it can reach, in however many steps."""
    return {name}.union(*map(rooms_below, ROOMS[name].split()))


@cache
def imports(module):
    """Full names that a module imports, anywhere in it: in functions, and for types alone, too."""
    found = []
    for node in nodes(module):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}: write `from shapeblend_cli...`, not a relative import"
            found += [f"{node.module}.{alias.name}" for alias in node.names]
    return found


def imported_modules(module):
    """Our modules among them."""
    for name in imports(module):
        package, _, rest = name.partition(".")
        if package == "shapeblend_cli":
            parent = rest.rpartition(".")[0]
            yield rest if rest in trees() else parent if parent in trees() else "__init__"


def assert_none(wrong, remedy):
    if wrong:
        pytest.fail("\n".join([*sorted(wrong), f"Remedy: {remedy}"]), pytrace=False)


def test_arrows_in_the_table_point_down():
    order = list(ROOMS)
    for name, below in ROOMS.items():
        upwards = [other for other in below.split() if order.index(other) <= order.index(name)]
        assert upwards == [], f"{name} stands below {upwards}: move what they share into a room below both"
    assert {room(module) for module in trees()} == set(ROOMS), "ROOMS has lines for rooms that are gone"


def test_imports_follow_the_arrows():
    arrows = {(name, below) for name in ROOMS for below in ROOMS[name].split()}
    taken, wrong = set(), set()
    for module in trees():
        for other in imported_modules(module):
            arrow = room(module), room(other)
            taken.add(arrow)
            if arrow[0] != arrow[1] and arrow not in arrows:
                wrong.add(f"{module} imports {other}")
    assert_none(wrong, "move the code into a room that may, or hand the value down as an argument")
    assert_none({f"{name} -> {below}" for name, below in arrows - taken}, "nobody goes there: take it away")


def test_tools_import_modules_that_there_are():
    wrong = set()
    for file in (PACKAGE.parent / "tools").rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("shapeblend_cli."):
                if node.module.partition(".")[2] not in trees():
                    wrong.add(f"{file.name} imports {node.module}")
    assert_none(wrong, "import it from where it is now")


def test_no_modules_import_each_other_in_a_circle():
    graph = {module: {*imported_modules(module)} - {module} for module in trees()}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(f"{' <- '.join(error.args[1])}: move what two of them share into a module below both")


def test_libraries_are_known_to_the_rooms_that_wrap_them():
    wrong = set()
    for module in trees():
        for library in {name.split(".")[0] for name in imports(module)} - SHARED - {"shapeblend_cli"}:
            assert library in LIBRARIES, f"{module} imports {library}: give it a line in LIBRARIES"
            if room(module) not in LIBRARIES[library].split():
                wrong.add(f"{module} imports {library}")
    assert_none(wrong, "call the room that wraps the library")


def test_functions_have_few_parameters():
    long = set()
    for module in trees():
        for function in nodes(module):
            if isinstance(function, ast.FunctionDef):
                of = function.args
                every = (*of.posonlyargs, *of.args, *of.kwonlyargs, of.vararg, of.kwarg)
                if len({arg.arg for arg in every if arg} - {"self", "cls"}) > MOST_PARAMETERS:
                    long.add(f"{module}.{function.name}")
    assert_none(long, "gather parameters that belong together in a value")


def test_functions_files_and_rooms_are_small():
    long = {
        file.relative_to(PACKAGE).as_posix()
        for file in SOURCES
        if module_name(file) not in KERNELS and lines_of(file) > LONGEST_FILE
    }
    for module in trees().keys() - KERNELS:
        for node in nodes(module):
            if isinstance(node, ast.FunctionDef) and code_lines(node) > MOST_LINES:
                long.add(f"{module}.{node.name}")
    assert_none(long, "cut it in two where it does two things")
    files = Counter(file.parent for file in SOURCES)
    crowded = {module_name(folder / "__init__.py") for folder, count in files.items() if count > MOST_FILES}
    assert_none(crowded, "make two rooms of it")


def test_names_of_files_say_which_one_is_meant():
    """Modules of `cli` are called as their commands, and `options` in any room are those of its command."""
    found = Counter(file.name for file in SOURCES if file.parent != PACKAGE / "cli")
    twice = {name for name, count in found.items() if count > 1}
    assert_none(twice ^ REPEATED, "give one of them another name, or take it off the list")


def test_the_map_for_newcomers_names_files_where_they_are():
    wrong = set()
    for row in (PACKAGE.parent / "CONTRIBUTING.md").read_text("utf-8").splitlines():
        folder = PACKAGE
        for name in re.findall(r"`([\w/]+(?:/|\.(?:py|js|css|html)))`", row if row.startswith("| ") else ""):
            if "/" in name:
                folder = (PACKAGE / name).parent if "." in name else PACKAGE / name
            if not any((around / Path(name).name).exists() for around in (folder, folder.parent, PACKAGE)):
                wrong.add(f"{name} in: {row[:60]}")
    assert_none(wrong, "name the file that it is in now")


def lines_of(file):
    return len(file.read_text("utf-8").splitlines())


def code_lines(function):
    """The number of lines of a function without its docstring."""
    first = function.body[0]
    is_docstring = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    return function.end_lineno - function.lineno + 1 - (is_docstring and first.end_lineno - first.lineno + 1)


def test_calls_follow_the_arrows(here):
    """At run time too: no function, handed down or made late, reaches a room that imports could not reach."""
    for name, path in {"a": EYED, "b": LEAF, "c": SQUARES, "d": BAR}.items():
        Path(f"{name}.svg").write_text(svg(path, attributes='fill-rule="evenodd"'), "utf-8")
    with cProfile.Profile(builtins=False) as profile:
        for arguments in (
            "a.svg b.svg -v -n 2 --ends --report report.json --preview page.html --vertices 40",
            "c.svg d.svg a.svg -o moving.svg --unmatched split",
            "c.svg d.svg -o frames --motion rigid --polygons -n 1",
            "a.svg b.svg --emit lottie --motion intrinsic",
            "plot graph c.svg d.svg -o plot.svg",
        ):
            assert run(arguments.split()) == 0
    calls = {(entry.code, call.code) for entry in profile.getstats() for call in entry.calls or ()}
    inside = [[(c, module_name(c.co_filename)) for c in call] for call in calls if all(map(is_ours, call))]
    wrong = {
        f"{module}.{caller.co_qualname} calls {other}.{callee.co_qualname}"
        for (caller, module), (callee, other) in inside
        if room(other) not in rooms_below(room(module)) and callee.co_qualname not in HANDED_DOWN
    }
    assert len(inside) > 500
    assert_none(wrong, "return what has to be done, and let a room above do it")


def is_ours(code):
    return code.co_filename.startswith(f"{PACKAGE}{os.sep}")
