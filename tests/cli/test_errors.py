"""What is refused, and in which words."""

import shlex
from pathlib import Path

import pytest

from tests.support.commands import write
from tests.support.drawings import BAR, RING, svg

OPTIONS = {
    "--nope": "--nope",
    "--fill red": "No such option '--fill' (shapeblend --help lists the options)",
    "--foo": "No such option '--foo' (",
    "--vershion": "No such option '--vershion'. Did you mean '--version'?",
    "--durations 3": "No such option '--durations'. Did you mean '--duration'?",
    "-o x.jsx": "--output x.jsx: .jsx cannot be written; x.js would work, a JavaScript module",
    "-o X.MOV": "X.MOV: .mov cannot be written; X.mp4 would work, a video",
    "-n 1000000": "--frames must be at most 10000, not 1000000",
    "-n -1": "--frames must be 0 or more, not -1",
    "--cs 0": "--cs must be greater than 0, not 0",
    "--cs 2": "--cs must be at most 1, not 2",
    "--ks nan": "--ks must be a number, not nan",
    "--kb -1": "--kb must be 0 or more, not -1",
    "--eb x": "--eb must be a number, not x",
    "--bending both": "--bending must be turn or paper, not 'both'",
    "--kt -1": "--kt must be 0 or more, not -1",
    "--smoothing -0.01": "--smoothing must be 0 or more, not -0.01",
    "--smoothing 0.2": "--smoothing must be at most 0.1, not 0.2",
    "--start 3": "--start must be auto, or two vertex numbers such as 0,3, not '3'",
    "--start 0,-3": "--start must be two vertex numbers, and these begin at 0, not 0,-3",
    "--pin 3": "--pin must be two vertex numbers",
    "--pin 1,2:3": "two points such as 1.5,2:3,4, not '1,2:3'",
    "--pin 1,x:3,4": "two points such as 1.5,2:3,4, not '1,x:3,4'",
    "--stiff 1,2=3": "--stiff must be of the form x,y,r=W",
    "--stiff 1,2,0=3": "a radius and a weight greater than 0, not 0 and 3",
    "--band 2": "--band must be none, or a number between 0 and 1, not '2'",
    "--reverse maybe": "--reverse must be auto, yes or no, not 'maybe'",
    "--preset fig9": "not 'fig9'",
    "--match 0": "--match must be of the form A=B",
    "--match 0=1,1=0": "--match must be one pair each time, 0=1 and then 1=0, not '0=1,1=0'",
    "--match '1=2 2=1'": "--match must be one pair",
    "--match =1": "--match must be of the form A=B",
    "--match 1,2:3": "such as 0=1 or left=right, or two points such as 120,40:98,44, not '1,2:3'",
    "--select-a 'g >'": "--select-a must be #id or a CSS selector: 'g >' is no CSS selector",
    "--select-b 'g >'": "--select-b",
    **{f"--motion '{value}'": f"--motion must be auto, linear, rigid or intrinsic, not '{value}'"
       for value in ("straight", "", "AUTO!")},
    "--ease easy": "--ease must be linear, ease, ease-in, ease-out, ease-in-out, back or ",
    "--ease 'cubic-bezier(2,0,1,1)'": "with x1 and x2 between 0 and 1, and x1 is 2",
    "--easing bounce": "--easing must be a known easing, not 'bounce'; elastic-out would work",
    "--repeat 0": "--repeat must be forever, pingpong, or a number from 1",
    "--repeat often": "pingpong",
    "--duration 0": "--duration must be 0.01 or more, not 0",
    "--precision 11": "--precision must be at most 10, not 11",
    "--preview x.txt": "--preview must be a file name ending in .htm or .html, not 'x.txt'",
    "-o - --report -": "--output and --report cannot both be standard output",
    "-q -v": "--quiet and --verbose contradict each other",
    "c.svg --start 0,0": "--start, --pin, --match and --stiff apply to two files; 3 given",
    "c.svg --match 0=0": "apply to two files; 3 given",
    "--emit gif": "layers, lottie, js or avd, or --output with a suffix such as .gif in its place, not 'gif'",
    "--emit pair -o -": "writes a.svg and b.svg, so --output takes a folder; - given",
    "--emit pair -o x.svg": "a folder; x.svg given",
    "--emit pair -o x.png": "a folder; x.png given",
    "--emit lottie -o x": "ending in .json or .lottie, or -; x given",
    "--emit lottie -o x.svg": "ending in .json",
    "--emit lottie -o x.gif": "ending in .json",
    "--emit avd -o x.json": "ending in .xml",
    "--emit avd -o - --report -": "standard output",
    "c.svg --emit pair": "two files; 3 given",
    "c.svg --emit avd": "two files; 3 given",
    "--emit pair --format png": "not for --emit pair",
    "c.svg -o x.xml": "--output x.xml takes two files; 3 given",
    "-o x.html": "x.html: --preview x.html writes a page of this kind",
    "-o x.jpg": "cannot be written; .svg, .png, .gif, .webp, .apng, .mp4, .webm, .json, .lottie, .js, .xml would work",
    "-o frames.old": ".old cannot be written",
    "-o x.foo": "or x.foo/ for a folder of frames",
    "--loop often": "--loop must be forever, pingpong, or a number from 1 to 1000000, not 'often'",
    "--loop infinite": "not 'infinite'; forever would work",
    "--repeat yoyo": "--repeat must be forever, pingpong, or a number from 1 to 1000000, not 'yoyo'; pingpong would",
    "--loop -o x.svg": "--loop takes a value, N|forever|pingpong, before -o",
    "--loop=yes -o x.svg": "--loop must be forever",
    "-o x.svg -o y.gif": "--output is given twice, x.svg and y.gif; a run for each of them would work",
    "-o x.svg --output y.gif": "--output is given twice, x.svg and y.gif",
    "--report x.json --report y.json": "--report is given twice",
    "--looping 3": "No such option '--looping'. Did you mean '--repeat'?",
    "--reverse-loop": "Did you mean '--repeat pingpong'?",
    "--pause 1": "Did you mean '--hold'?",
    "--lossless -o x.gif": "--lossless is for WebP, a name ending in .webp, not for --output x.gif",
    "--wait 1": "Did you mean '--delay'?",
    "--delay 1 -o x.svg --trigger click": "that start by themselves; --trigger click waits for an event",
    "--hold 1,2,3": "--hold must be seconds, such as 0.5 or 500ms, or two such times",
    "--hold 1 -o x.png": "--hold is for animations, a name ending in .svg, .gif, .webp",
    "--hold 1 -o y.png": ", .js or .xml, not for --output y.png",
    "--loop 3": "--loop is for animations, a name ending in .svg, .gif, ",
    "--repeat pingpong -o x.png": ", .js or .xml, not for --output x.png",
    "--repeat 3 --emit pair": "not for --emit pair",
    "-n 0": "wrote nothing: --frames 0 asks for no in-betweens; --ends would write the drawings",
    "-n 0 -q": "wrote nothing: --frames 0 asks for no in-betweens",
    "--hold 1 -o x.svg --trigger click": "--hold is for animations that start by themselves",
    "--overwrite": "Did you mean '--force'?",
    "--duration 3x": "--duration must be seconds, such as 0.3, 0.3s or 300ms, not '3x'",
    "-o x.svg --columns 3": "--columns is for a contact sheet, a name ending in .png, not for --output x.svg",
    "-o x.gif --columns 3": "--columns is for a contact sheet",
    "--columns 3": "not for --output blend",
    "--columns 0 -o x.png": "--columns must be 1 or more, not 0",
    "--width 100": "--width is for pictures",
    "--width 100 -o -": "--width is for pictures",
    "--width 0 -o x.png": "--width must be 1 or more, not 0",
    "-o x.png --fps 9": "--fps is for a raster animation",
    "-o x.svg --fps 9": "--fps is for a raster animation",
    "-o x.gif --fps 51": "--fps must be at most 50, not 51",
    "-o x.gif --fps 9 -n 3": "one is enough",
    "-o x.gif --background transparent": "half transparent",
    "-o x.png --background nope": "--background must be transparent, or an opaque CSS colour",
    "-o x.png --background '#ff000080'": "an opaque CSS colour such as white or #f4f4f0, not '#ff000080'",
    "--background red": "--background is for pictures",
    "-o x.png --format png": "--format is for a folder",
    "-o x.svg --format svg": "--format is for a folder",
    "-o - --format png": "--format is for a folder",
    "-o x.png -n 0": "--ends would work",
    "-o x.gif -n 200": "202 pictures in 2 seconds",
    "-o x.webp --duration 0.03": "2 pictures in 0.03 seconds",
    "-o x.mp4 --background transparent": "an MP4 cannot be transparent; .webm",
    "-o x.webm --repeat 101": "a video has 100 runs at most",
    "-o x.mp4 --duration 3600": "pictures are more than 20000",
    "-o x.apng --repeat 65536": "65535 times at most",
    "--loop": "Option '--loop' requires an argument. '--loop N|forever|pingpong' would work.",
    "--format gif": "--format must be svg or png, or --output with a suffix such as .gif in its place, not 'gif'",
    "--react": "Did you mean '--output NAME.js'?",
    "--times 3": "--times must be at most 2, not 3",
    "--times 0,x": "--times must be times between -1 and 2, such as",
    "--times 0,1 -n 3": "--times sets the frames itself",
    "--times 0,1 -o x.gif": "--times is for a folder of frames, a contact sheet or layers",
    "c.svg --times 0,1": "--times applies to two files; 3 given",
    "--specks -1": "--specks must be a length such as 2.5, or a share of the drawing such as 1%",
    "--specks 200%": "--specks must be a length",
    "--trigger press": "must be load, click, hover, or the id of an element and an event of it, such as menu.click",
    "--trigger click": "--trigger click is for an animated SVG, --output FILE.svg",
    "--trigger click -o x.gif": "--trigger click is for an animated SVG",
    "--trigger hover -o x.svg --animate frames": "not for --animate frames",
    "--trigger click -o x.svg --loop 2": "--loop is for animations that start by themselves",
    "--trigger click -o x.svg --repeat 2": "--repeat is for animations that start by themselves",
    "--trigger menu.click -o x.svg --animate css": "CSS knows no events of other elements",
    "c.svg --trigger click -o x.svg --animate css": "takes two files; 3 given",
    "--trigger click --emit lottie": "--trigger click is for an animated SVG",
    "c.svg --mix .5,.5": "--mix 0.5,0.5 has 2 shares; 3 files given",
    "c.svg --mix 1,-1,1": "--mix must be shares of two files or more, 0 or more and not all 0",
    "c.svg --mix 0,0,0": "not all 0",
    "c.svg --mix a,b,c": "--mix must be shares",
    "c.svg --mix 1,1,1 -n 4": "--mix sets the frames itself",
    "c.svg --mix 1,1,1 --ends": "--mix sets the frames itself",
    "c.svg --mix 1,1,1 --mix 1,0,0 -o x.svg": "takes one mixture, which stands still; a folder takes several",
    "c.svg --mix 1,1,1 -o x.gif": "--mix is for a folder, or for a name ending in .svg or .png",
    "c.svg --mix 1,1,1 --emit layers": "--mix is for a folder",
    "c.svg --mix 1,1,1 --report r.json": "--mix makes mixtures",
}  # fmt: skip
"""Further arguments of a blend of a.svg and b.svg."""

COMMANDS = {
    "": "A.svg B.svg",
    "help": "Did you mean the option '--help'?",
    "a.svg": "a blend needs two files or more, A.svg and B.svg; 1 given",
    "- -": "only one of the files can be standard input",
    "nowhere.svg b.svg --select-b 'g >'": "--select-b must be",
    "inspect": "FILE",
    "inspect --nope": "(shapeblend inspect --help lists the options)",
    "batch --chain . --keep-going x": "--keep-going must be a whole number, not x (shapeblend batch --help lists",
    "batch --chain . --loop x": "--loop must be forever",
    "inkscape blend --nope": "(shapeblend inkscape blend --help lists the options)",
    "states a.svg": "1 given (shapeblend states --help lists the options)",
    "a.svg b.svg --nope": "(shapeblend --help lists the options)",
    "inspect a.svg --select :x": "an unknown pseudo-class",
    "plot graph a.svg": "a plot compares two files, A.svg and B.svg; 1 given",
    "plot graph a.svg b.svg a.svg": "a plot compares two files, A.svg and B.svg; 3 given",
    "plot pie a.svg b.svg": "KIND must be graph or angle, not 'pie'; shapeblend plot graph A.svg B.svg would work",
    "plot a.svg b.svg": "not 'a.svg'; shapeblend plot graph a.svg ... would work",
    "inkscape": "shapeblend inkscape takes a command: animate, blend, install or studio",
    "docs --help": "No such command or file 'docs' (shapeblend --help lists",
    "a.svg b.svg studio": "studio is a command, which comes first: shapeblend studio",
    "'*.svg'": "1 given; without quotes the shell gives what fits *.svg",
    "batch a.svg b.svg": "a.svg and b.svg are drawings: shapeblend a.svg b.svg blends them, and --chain takes a folder",
    "batch sub sub2": "sub and sub2 are folders: --pairs sub sub2 would work",
    "states a.svg b.svg -o x.png": "must be a file name ending in .svg or .js or -",
    "states a.svg b.svg -o x.js --element icon": "--element must be the name of a custom element",
    "states a.svg b.svg -o 1-2.js": "elements begin with a letter",
    "states a.svg b.svg --trigger load": "--trigger must be none, click or hover",
    "plot graph a.svg b.svg --dot 0,0": "--dot is for angle; graph shows all dots",
}

FILES = {
    "smal.svg b.svg": "smal.svg: cannot be read (No such file or directory); small.svg is there",
    "SMALL.SVG b.svg": "; small.svg is there",
    "smal2.svg b.svg": "smal2.svg: cannot be read (No such file or directory); a readable SVG file would work",
    "in/q.svg b.svg": "in/q.svg: cannot be read (No such file or directory); a readable SVG file would work",
    "https://example.org/x.svg b.svg": "curl prints it, and x.svg saved from there would work",
    "'' b.svg": "'': cannot be read",
    "sub sub2": "sub: is a folder; shapeblend batch --pairs sub sub2 would work",
    "sub b.svg": "sub: is a folder; shapeblend batch --chain sub would work",
    "page.svg b.svg": "page.svg: this is a page of HTML; an SVG file would work",
    "project.json": "project.json: its drawing gone.svg: cannot be read",
}
"""Drawings that cannot be read."""

FAILURES = {
    "-o a.svg --force": "a.svg: is an input",
    "--report b.svg --force": "b.svg: is an input",
    "-o sub": "sub: is a file",
    "-o sub/x.svg": "sub: is a file",
    "--report .": ".: is a folder",
    "-o x.svg --report x.svg": "x.svg: is named for two",
    "--start 900,0": "a.svg and b.svg: pin 900,0 names no vertices",
    "--start 0,900": "0,900 names no vertices",
    "--pin 0,0 --pin 40,190 --pin 190,40": "cross each other",
    "--preset fig8 --vertices 0": "within 0 of the diagonal",
    "--stiff 500,500,1=2": "no vertex of A lies within 1",
    "--emit pair -o . --force": "a.svg: is an input",
    "--emit pair -o c.svg/x": "c.svg: is a file",
    "--emit lottie --report blend.json": "blend.json: is named for two",
    "-o sheet.png": "sheet.png: is a folder",
    "-o mine.gif": "mine.gif: exists; --force replaces it",
    "-o x.gif --width 9000": "x.gif: 50 pictures of 9000 x 9000 pixels",
    "-o x.png --width 9000": "x.png: 5 pictures of 9000 x 9000 pixels",
    "-o f --format png --width 9000": "f: 5 pictures",
    "--select-a '#smal'": "a.svg: nothing in it matches '#smal'; #small would",
    "--select-b '#x'": "b.svg: nothing in it matches '#x'",
    "--match 0=9": "a.svg and b.svg: B has no contour 9 to match; its contours are 0 to 1",
    "--match 0=1": "contour 0 of A is an outline and contour 1 of B a hole in contour 0",
    "--match smal=0": "a.svg paints no shape with the id 'smal'; there is small",
    "--match small=nothing": "b.svg paints no shape with the id 'nothing', nor any other id; a number from 0 to 1",
}
"""Further arguments of a blend of a.svg and b.svg that are well-formed, but do not fit the files."""


@pytest.mark.parametrize(("options", "words"), OPTIONS.items())
def test_wrong_options(three, refused, options, words):
    refused(["a.svg", "b.svg", *shlex.split(options)], 2, words)


@pytest.mark.parametrize(("command", "words"), COMMANDS.items())
def test_wrong_commands(three, refused, command, words):
    Path("sub").mkdir()
    Path("sub2").mkdir()
    refused(shlex.split(command), 2, words)


@pytest.mark.parametrize(("files", "words"), FILES.items())
def test_drawings_that_cannot_be_read(three, refused, files, words):
    write(small=svg(BAR), page="<!DOCTYPE html>\n<html><body>404")
    Path("sub").mkdir()
    Path("sub2").mkdir()
    Path("project.json").write_text('{"files": ["gone.svg", "b.svg"]}')
    refused(shlex.split(files), 1, words)


def test_a_file_of_json_that_is_no_project(three, refused):
    Path("l.json").write_text('{"v": "5.5", "layers": []}')
    refused(["l.json"], 2, "l.json: a Lottie animation, not a project of shapeblend; a project such as")
    Path("l.json").write_text("{}")
    refused(["l.json"], 2, "l.json: a JSON file without drawings, not a project of shapeblend")


@pytest.mark.parametrize(("options", "words"), FAILURES.items())
def test_what_does_not_fit_the_files(here, refused, options, words):
    write(a=svg(f'<path id="small" d="{BAR}"/>'), b=svg(RING, attributes='fill-rule="evenodd"'), c=svg(BAR))
    (here / "sub").write_text("a file")
    (here / "mine.gif").write_text("mine")
    (here / "sheet.png").mkdir()
    refused(["a.svg", "b.svg", *shlex.split(options)], 1, words)
