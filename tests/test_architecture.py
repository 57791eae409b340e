"""Which room may look into which, by imports and by calls, and what holds for every function."""

import ast
import os
import sys
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
    "cli": "studio project rank batch inkscape states plot files jobs outputs report interrupts svg.reading settings "
    "fields field_types errors version",
    "__init__": "api outputs model settings errors version",
    "api": "pipeline outputs output report pairing svg.reading svg.writing settings model clock version easing errors",
    "studio": "project preview tries files jobs outputs output pipeline svg.reading svg.writing motion views fields "
    "field_types model kept clock version processes errors",
    "rank": "batch tries files svg.reading svg.writing output settings motion model kept clock errors",
    "project": "batch field_types errors",
    "batch": "files svg.reading jobs outputs output kept staging processes interrupts settings fields field_types "
    "clock easing errors version",
    "plot": "files output svg.reading svg.writing pairing interpolate geometry settings matching model clock "
    "errors",
    "states": "files outputs interpolate svg.writing names settings matching model clock errors",
    "inkscape": "outputs output pipeline svg.reading svg.writing names geometry settings fields model easing errors",
    "files": "preview tries report jobs outputs output pipeline svg.reading motion settings matching model kept clock "
    "errors version",
    "tries": "pipeline svg.writing motion geometry settings model errors",
    "preview": "svg.reading svg.writing pairing interpolate paint geometry settings matching model easing",
    "report": "interpolate geometry model",
    "jobs": "outputs settings fields errors",
    "outputs": "pipeline interpolate svg.writing names settings fields field_types model easing triggers errors",
    "output": "staging interrupts errors",
    "staging": "",
    "processes": "",
    "interrupts": "errors",
    "pipeline": "clipping views pairing motion interpolate names paint geometry settings model kept clock easing "
    "errors",
    "clipping": "geometry model",
    "views": "interpolate geometry model",
    "pairing": "geometry settings matching constants model errors",
    "motion": "interpolate geometry model _cython",
    "interpolate": "names paint geometry model",
    "matching": "constants model errors _cython",
    "settings": "constants fields field_types easing errors",
    "constants": "fields field_types",
    "fields": "field_types",
    "field_types": "svg.reading easing triggers",
    "svg.reading": "svg.libraries geometry model errors",
    "svg.writing": "svg.libraries names paint model easing triggers",
    "names": "model",
    "paint": "model",
    "svg.libraries": "",
    "svg": "",
    "geometry": "model _cython",
    "model": "",
    "clock": "",
    "kept": "",
    "easing": "",
    "triggers": "",
    "errors": "",
    "version": "",
    "_cython": "",
}

# Libraries that only some rooms know. numpy and the standard library are everybody's.
LIBRARIES = {
    "click": "cli",
    "rich": "cli",
    "svgpathtools": "svg.libraries",
    "tinycss2": "svg.reading",
    "cssselect2": "svg.reading",
    "svgwrite": "svg.libraries",
    "PIL": "outputs",
    "resvg_py": "outputs",
    "coloraide": "paint",
    "distributed": "batch",
    "lap": "pairing",
    "cython": "geometry matching motion",
}
SHARED = {"numpy", *sys.stdlib_module_names}

# What a room hands to one below it, which calls it there.
HANDED_DOWN = {
    *(
        "Terminal.note",
        "Terminal.warn",
        "watch_part.<locals>.<lambda>",
        "Terminal.progress",
    ),  # how far a run has come
    # A `Motion`, which `model` declares.
    *(
        f"{motion}.{what}"
        for motion in ("Rigid", "Intrinsic", "Safe", "Sweep")
        for what in ("name", "segments")
    ),
    *("Settings._defaults", "WorkConstants._defaults"),  # a `Record` asks what it is made of
}

MOST_PARAMETERS = 8


def module_name(file):
    """The name of a module without the package's: `svg.reading.read`."""
    parts = Path(file).relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts[:-1] if len(parts) > 1 and parts[-1] == "__init__" else parts)


TREES = {module_name(file): ast.parse(file.read_text("utf-8")) for file in sorted(PACKAGE.rglob("*.py"))}


def room(module):
    rooms = [name for name in ROOMS if f"{module}.".startswith(f"{name}.")]
    assert rooms, f"{module} is in no room: give it a line in ROOMS"
    return max(rooms, key=len)


def rooms_below(name):
    """A room with all that it can reach, in however many steps."""
    return {name}.union(*map(rooms_below, ROOMS[name].split()))


def imports(module):
    """Full names that a module imports, anywhere in it: in functions, and for types alone, too."""
    for node in ast.walk(TREES[module]):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}: write `from shapeblend_cli...`, not a relative import"
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def imported_modules(module):
    """Our modules among them."""
    for name in imports(module):
        package, _, rest = name.partition(".")
        if package == "shapeblend_cli":
            parent = rest.rpartition(".")[0]
            yield rest if rest in TREES else parent if parent in TREES else "__init__"


def assert_none(wrong, remedy):
    if wrong:
        pytest.fail("\n".join([*sorted(wrong), f"Remedy: {remedy}"]), pytrace=False)


def test_arrows_in_the_table_point_down():
    order = list(ROOMS)
    for name, below in ROOMS.items():
        upwards = [other for other in below.split() if order.index(other) <= order.index(name)]
        assert upwards == [], f"{name} stands below {upwards}: move what they share into a room below both"
    assert {room(module) for module in TREES} == set(ROOMS), "ROOMS has lines for rooms that are gone"


def test_imports_follow_the_arrows():
    arrows = {(name, below) for name in ROOMS for below in ROOMS[name].split()}
    taken, wrong = set(), set()
    for module in TREES:
        for other in imported_modules(module):
            arrow = room(module), room(other)
            taken.add(arrow)
            if arrow[0] != arrow[1] and arrow not in arrows:
                wrong.add(f"{module} imports {other}")
    assert_none(wrong, "move the code into a room that may, or hand the value down as an argument")
    assert_none({f"{name} -> {below}" for name, below in arrows - taken}, "nobody goes there: take it away")


def test_no_modules_import_each_other_in_a_circle():
    graph = {module: {*imported_modules(module)} - {module} for module in TREES}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(f"{' <- '.join(error.args[1])}: move what two of them share into a module below both")


def test_libraries_are_known_to_the_rooms_that_wrap_them():
    wrong = set()
    for module in TREES:
        for library in {name.split(".")[0] for name in imports(module)} - SHARED - {"shapeblend_cli"}:
            assert library in LIBRARIES, f"{module} imports {library}: give it a line in LIBRARIES"
            if room(module) not in LIBRARIES[library].split():
                wrong.add(f"{module} imports {library}")
    assert_none(wrong, "call the room that wraps the library")


def test_functions_have_few_parameters():
    long = set()
    for module, tree in TREES.items():
        for function in ast.walk(tree):
            if isinstance(function, ast.FunctionDef):
                of = function.args
                every = (*of.posonlyargs, *of.args, *of.kwonlyargs, of.vararg, of.kwarg)
                if len({arg.arg for arg in every if arg} - {"self", "cls"}) > MOST_PARAMETERS:
                    long.add(f"{module}.{function.name}")
    assert_none(long, "gather parameters that belong together in a value")


def test_calls_follow_the_arrows(here):
    """At run time too: no function, handed down or made late, reaches a room that imports could not reach."""
    calls = set()

    def watch(frame, event, _):
        if event == "call" and frame.f_back is not None:
            calls.add((frame.f_back.f_code, frame.f_code))

    for name, path in {"a": EYED, "b": LEAF, "c": SQUARES, "d": BAR}.items():
        Path(f"{name}.svg").write_text(svg(path, attributes='fill-rule="evenodd"'), "utf-8")
    sys.setprofile(watch)
    try:
        for arguments in (
            "a.svg b.svg -v -n 2 --ends --report report.json --preview page.html --vertices 40",
            "c.svg d.svg a.svg -o moving.svg --unmatched split",
            "c.svg d.svg -o frames --motion safe --polygons -n 1",
            "a.svg b.svg --emit lottie --motion intrinsic",
            "plot graph c.svg d.svg -o plot.svg",
        ):
            assert run(arguments.split()) == 0
    finally:
        sys.setprofile(None)
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
