"""Ids, labels, groups, layers, sizes, titles and descriptions: what makes a drawing one to work on."""

from pathlib import Path
from xml.etree import ElementTree

import pytest

from shapeblend_cli.cli import run
from tests.support.commands import write
from tests.support.drawings import svg

SVG, INKSCAPE = "{http://www.w3.org/2000/svg}", "{http://www.inkscape.org/namespaces/inkscape}"
LEG, BOOT, FOOT = "M2 12h4v10h-4z", "M1 12h4v10h-6z", "M12 12h4v10h-4z"
HEAD = '<circle id="head" cx="{x}" cy="6" r="4" fill="#f00"/>'


def walker(
    leg=LEG, *, second="path99", inner="g7", x=12, root='width="24mm" height="24mm" id="svg5"', more=""
):
    """A file such as Inkscape writes."""
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        f'viewBox="0 0 24 24" {root}><title>A walker</title><desc>on its\n way</desc>'
        '<g inkscape:groupmode="layer" inkscape:label="Legs" id="layer1" transform="translate(1 0)">'
        f'<desc>both of them</desc><g id="{inner}"><path id="leg-l" inkscape:label="left leg" d="{leg}"/>'
        f'<path id="{second}" d="{FOOT}"><title>the right one</title></path></g></g>'
        f'<g inkscape:groupmode="layer" inkscape:label="Head" id="layer2">{HEAD.format(x=x)}{more}</g></svg>'
    )


def written(*options, files=("a.svg", "b.svg"), file="out.svg"):
    """The root of what a run writes into one file, without what only serves to stop it."""
    assert run([*files, "-o", file, "-f", "-q", *options]) == 0
    root = ElementTree.parse(file).getroot()
    for timer in root.findall(f"{SVG}g[{SVG}set]"):
        root.remove(timer)
    return root


def frame(*options, t=0.5, **drawings):
    """The root of the frame in the middle, or of another of three."""
    write(**drawings)
    assert run(["a.svg", "b.svg", "-n", "1", "--ends", "-o", "frames", "-f", "-q", *options]) == 0
    return ElementTree.parse(f"frames/frame-{int(2 * t) + 1}.svg").getroot()


def ids(root):
    """The ids of what is in a document, in order, of shapes and of groups."""
    return [element.get("id") for element in root.iter() if element.get("id")]


def named(root, name):
    return next(element for element in root.iter() if element.get("id") == name)


def tree(element):
    """The structure: the id of each group and shape, with what is in it."""
    inside = [tree(child) for child in element if child.tag in (f"{SVG}g", f"{SVG}path")]
    return (element.get("id"), inside) if element.tag != f"{SVG}path" else element.get("id")


def test_what_both_drawings_agree_on_is_in_every_frame(here):
    for t in (0.0, 0.5, 1.0):
        root = frame(t=t, a=walker(), b=walker(BOOT, x=14))
        assert tree(root) == ("svg5", [("layer1", [("g7", ["leg-l", "path99"])]), ("layer2", ["head"])])
        assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("24mm", "24mm", "0 0 24 24")
        assert [root[0].text, root[1].text] == ["A walker", "on its way"]
        legs = named(root, "layer1")
        assert (legs.get(f"{INKSCAPE}label"), legs.get(f"{INKSCAPE}groupmode")) == ("Legs", "layer")
        assert legs.find(f"{SVG}desc").text == "both of them"
        assert named(root, "leg-l").get(f"{INKSCAPE}label") == "left leg"
        assert named(root, "path99").find(f"{SVG}title").text == "the right one"


def test_what_they_do_not_agree_on_is_left_out_and_the_rest_stays(here):
    b = walker(BOOT, second="path3", inner="g22", root='width="48mm" height="24mm"')
    root = frame(a=walker(), b=b.replace("A walker", "Another"))
    assert tree(root) == ("svg5", [("layer1", [(None, ["leg-l", None])]), ("layer2", ["head"])])
    assert (root.get("width"), root.get("height")) == (None, "24mm")
    assert [child.text for child in root if child.tag in (f"{SVG}title", f"{SVG}desc")] == ["on its way"]


def test_what_one_drawing_has_stays(here):
    plain = svg(f'<path d="{BOOT}"/>', f'<path d="{FOOT}"/>', HEAD.format(x=14).replace('id="head"', ""))
    for files in ({"a": walker(), "b": plain}, {"a": plain, "b": walker()}):
        root = frame("--motion", "linear", **files)
        assert tree(root) == ("svg5", [("layer1", [("g7", ["leg-l", "path99"])]), ("layer2", ["head"])])
        assert root.get("width") == "24mm"


def test_a_shape_that_comes_is_in_its_own_layer(here):
    hat = '<path id="hat" d="M10 0h4v1h-4z" fill="#00f"/>'
    root = frame(a=walker(), b=walker(more=hat))
    assert tree(root)[1][1] == ("layer2", ["head", "hat"])


def test_no_id_is_there_twice(here):
    """One shape that becomes two, and ids that both drawings use for other things."""
    a = svg('<path id="one" d="M2 2H10V10H2Z M14 2H22V10H14Z"/>')
    b = svg('<path id="one" d="M2 3H10V10H2Z"/>', '<path d="M14 3H22V10H14Z"/>', '<g id="one"/>')
    root = frame(a=a, b=b)
    assert ids(root) == ["one"]
    assert len(list(root.iter(f"{SVG}path"))) == 2


def test_a_gradient_gets_an_id_that_no_shape_has(here):
    stops = '<stop stop-color="red"/><stop offset="1" stop-color="blue"/>'
    shaded = f'<linearGradient id="g">{stops}</linearGradient>'
    shaded += '<path id="gradient-1" fill="url(#g)" d="M2 2H22V{}H2Z"/>'
    for options in ([], ["--animate", "smil"]):
        write(a=svg(shaded.format(22)), b=svg(shaded.format(18)))
        root = written(*options) if options else frame(a=svg(shaded.format(22)), b=svg(shaded.format(18)))
        path, gradient = root.find(f".//{SVG}path"), root.find(f".//{SVG}linearGradient")
        assert path.get("id") == "gradient-1" != gradient.get("id")
        assert path.get("fill") == f"url(#{gradient.get('id')})"


def test_a_size_keeps_its_scale_where_more_is_shown(here):
    sized = svg('<path d="M2 2H10V10H2Z"/>', viewbox="0 0 12 12").replace(
        "<svg", '<svg width="6cm" height="6cm"'
    )
    outside = sized.replace("M2 2H10V10H2Z", "M2 2H22V10H2Z")
    root = frame("--viewbox", "grow", t=1.0, a=sized, b=outside)
    x, _, width, height = map(float, root.get("viewBox").split())
    assert width > 20
    assert x <= 0
    assert float(root.get("width").removesuffix("cm")) == pytest.approx(width / 2)
    assert float(root.get("height").removesuffix("cm")) == pytest.approx(height / 2)


@pytest.mark.parametrize(
    ("fit", "of_b", "kept"),
    [
        ("none", 'width="40" height="24" preserveAspectRatio="none"', "none"),
        ("xMidYMin slice", "", "xMidYMin slice"),
        ("none", 'width="40" height="24"', None),
        ("xMidYMid", "", None),
    ],
)
def test_what_fills_a_size_of_another_shape_does_so_as_in_both_drawings(here, fit, of_b, kept):
    path = svg('<path d="M2 2H10V10H2Z"/>')
    sized = path.replace("<svg", f'<svg width="40" height="24" preserveAspectRatio="{fit}"')
    root = frame(a=sized, b=path.replace("<svg", f"<svg {of_b}"))
    assert (root.get("width"), root.get("preserveAspectRatio")) == ("40", kept)


@pytest.mark.parametrize("method", ["smil", "css"])
def test_animations_have_the_names_too(here, method):
    write(a=walker(), b=walker(BOOT), c=walker(LEG, second="path1"))
    root = written("--animate", method, files=("a.svg", "b.svg", "c.svg"))
    assert tree(root) == ("svg5", [("layer1", [("g7", ["leg-l", None])]), ("layer2", ["head"])])
    assert root.get("width") == "24mm"
    assert root[0].tag == f"{SVG}title"


def test_files_for_other_programs_have_the_ids(here):
    write(a=walker(), b=walker(BOOT, second="path3"))
    assert run("a.svg b.svg --emit pair -o pair -q".split()) == 0
    for name in ("a", "b"):
        assert ids(ElementTree.parse(f"pair/{name}.svg").getroot()) == ["leg-l", "shape-2", "head"]
    assert run("a.svg b.svg --emit lottie -o l.json -q".split()) == 0
    assert '"nm":"leg-l"' in Path("l.json").read_text()


def test_layers_are_one_document_with_a_layer_for_each_frame(here):
    write(a=walker(), b=walker(BOOT, x=14))
    root = written("--emit", "layers", "-n", "2", "--ends")
    layers = [element for element in root if element.tag == f"{SVG}g"]
    assert [layer.get(f"{INKSCAPE}label") for layer in layers] == [
        *("1: t = 0", "2: t = 0.3333", "3: t = 0.6667", "4: t = 1"),
    ]
    assert all(layer.get(f"{INKSCAPE}groupmode") == "layer" for layer in layers)
    assert len(ids(root)) == len(set(ids(root)))
    assert (root.get("width"), root.get("viewBox")) == ("24mm", "0 0 24 24")
    for layer in layers:
        labels = [element.get(f"{INKSCAPE}label") or element.get("id") for element in layer.iter()]
        assert {"Legs", "left leg", "Head", "head"} <= set(labels)
    # Each layer has the paths of its frame.
    assert run("a.svg b.svg -n 2 --ends -o frames -q".split()) == 0
    for k, layer in enumerate(layers, 1):
        alone = ElementTree.parse(f"frames/frame-{k}.svg").getroot()
        assert [p.get("d") for p in layer.iter(f"{SVG}path")] == [
            p.get("d") for p in alone.iter(f"{SVG}path")
        ]


def test_layers_need_frames_and_a_file(here, capsys):
    write(a=walker(), b=walker(BOOT))
    assert run("a.svg b.svg --emit layers -n 0 -o out.svg".split()) == 2
    assert "--frames 0 leaves nothing for layers" in capsys.readouterr().err
    assert run("a.svg b.svg --emit layers -o folder".split()) == 2
    assert "--output takes a name ending in .svg" in capsys.readouterr().err


def test_pictures_are_as_large_as_they_are_asked_to_be_whatever_size_the_drawing_has(here):
    from PIL import Image

    write(a=walker(root='width="5px" height="5px"'), b=walker(BOOT, root='width="5px" height="5px"'))
    assert run("a.svg b.svg --format png --width 48 -n 1 -o png -q".split()) == 0
    with Image.open("png/frame-1.png") as picture:
        _, top, _, bottom = picture.getbbox()
    assert picture.size == (48, 48)
    assert bottom - top > 38


def test_hostile_names_do_no_harm(here):
    """Groups in groups without end, titles of any length, ids that are no ids."""
    deep = "<g>" * 600 + '<path id="a b&lt;&quot;" d="M2 2H10V10H2Z"/>' + "</g>" * 600
    write(a=svg(f"<g><title>{'x' * 50_000}</title>{deep}</g>"), b=svg(deep))
    root = frame(a=Path("a.svg").read_text(), b=Path("b.svg").read_text())
    assert ids(root) == ['a b<"']
    assert len(list(root.iter(f"{SVG}g"))) <= 32
    assert max(len(title.text) for title in root.iter(f"{SVG}title")) <= 10_000
