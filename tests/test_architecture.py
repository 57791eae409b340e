"""Which module may import which."""

import ast
from pathlib import Path

import pytest

import shapeblend_cli

PACKAGE = Path(shapeblend_cli.__file__).parent
MODULES = sorted(path.relative_to(PACKAGE).as_posix() for path in PACKAGE.rglob("*.py"))

# For each room, the rooms it may look into besides itself. The first name that fits a module is its room.
ROOMS = {
    "errors": set(),
    "model": set(),
    "_cython": set(),
    "field_types": {"easing", "svg"},
    "fields": {"field_types"},
    "constants": {"fields", "field_types"},
    "easing": set(),
    "clock": set(),
    "progress": set(),
    "output": {"errors"},
    "svg": {"model", "errors", "easing", "geometry"},
    "geometry": {"model", "errors", "_cython"},
    "match": {"model", "errors", "_cython", "constants"},
    "paint": {"model"},
    "interpolate": {"model", "errors", "geometry", "easing", "paint"},
    "motion": {"model", "geometry", "interpolate", "_cython"},
    "report": {"model", "geometry", "measure"},
    "measure": {"model", "geometry", "interpolate"},
    "views": {"model", "geometry", "interpolate"},
    "settings": {"constants", "easing", "fields", "field_types"},
    "pairing": {"constants", "model", "errors", "geometry", "match", "settings"},
    "pipeline": {
        "model",
        "clock",
        "geometry",
        "interpolate",
        "motion",
        "paint",
        "pairing",
        "settings",
        "views",
    },
    "outputs": {
        "pipeline",
        "interpolate",
        "paint",
        "svg",
        "geometry",
        "model",
        "settings",
        "easing",
        "errors",
    },
    "files": {
        "pipeline",
        "measure",
        "outputs",
        "clock",
        "svg",
        "report",
        "preview",
        "output",
        "match",
        "model",
        "errors",
        "settings",
        "__init__",
    },
    "preview": {
        "easing",
        "geometry",
        "interpolate",
        "match",
        "model",
        "paint",
        "pairing",
        "report",
        "settings",
        "svg",
    },
    "plot": {
        "files",
        "output",
        "clock",
        "outputs",
        "svg",
        "pairing",
        "interpolate",
        "match",
        "geometry",
        "settings",
        "model",
        "errors",
    },
    "commands": set(),
    "parameters": {"svg", "easing", "outputs"},
    "options": {"parameters", "constants", "outputs", "settings"},
    "listing": set(),
    "cli": {
        "easing",
        "settings",
        "files",
        "outputs",
        "listing",
        "progress",
        "plot",
        "pipeline",
        "report",
        "svg",
        "match",
        "options",
        "parameters",
        "commands",
        "errors",
        "__init__",
    },
    "__main__": {"cli"},
    "__init__": {"constants", "settings", "errors", "match", "pipeline", "svg"},
}


def room(module):
    return module.removesuffix(".py").split("/")[0]


def imports(module):
    """Our modules that a module imports, anywhere in it, types included."""
    tree = ast.parse((PACKAGE / module).read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}: relative imports hide where things come from"
            if node.module == "shapeblend_cli":  # a submodule, or a name of the package itself
                names = [
                    f"shapeblend_cli.{a.name if list(PACKAGE.glob(f'{a.name}*')) else '__init__'}"
                    for a in node.names
                ]
            else:
                names = [node.module]
        yield from (name.split(".")[1] for name in names if name.startswith("shapeblend_cli."))


@pytest.mark.parametrize("module", MODULES)
def test_arrows_point_one_way(module):
    here = room(module)
    assert set(imports(module)) - {here} <= ROOMS[here]


LIBRARIES = {
    "svg": {"svgpathtools", "svgwrite", "tinycss2", "cssselect2"},
    "outputs": {"PIL", "resvg_py"},
}


@pytest.mark.parametrize("owner", LIBRARIES)
@pytest.mark.parametrize("module", MODULES)
def test_only_one_room_knows_some_libraries(module, owner):
    text = (PACKAGE / module).read_text(encoding="utf-8")
    imported = {
        name.split(".")[0]
        for node in ast.walk(ast.parse(text))
        for name in (
            [a.name for a in node.names]
            if isinstance(node, ast.Import)
            else [getattr(node, "module", None) or ""]
        )
    }
    assert room(module) == owner or imported & LIBRARIES[owner] == set()


@pytest.mark.parametrize(
    "module", [m for m in MODULES if room(m) not in ("cli", "commands", "options", "parameters", "progress")]
)
def test_only_the_command_line_knows_click(module):
    assert "import click" not in (PACKAGE / module).read_text(encoding="utf-8")
