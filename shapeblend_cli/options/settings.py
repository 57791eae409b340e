"""What can be set of a blend, checked when it is made. The command line's options are made from these tables.

Nothing heavy is imported here, for the sake of ``--help``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from shapeblend_cli.errors import OptionError
from shapeblend_cli.options import types as types
from shapeblend_cli.options.constants import PRESETS, WIRE, WorkConstants
from shapeblend_cli.options.easing import LINEAR, Ease
from shapeblend_cli.options.fields import Record, option

Vertices = tuple[int, int] | tuple[complex, complex]
Contours = tuple[str, str] | tuple[complex, complex]

OUTPUT, SHAPES, CORRESPONDENCE = "Output", "Which shapes", "Correspondence"
IN_BETWEENS, ANIMATIONS, OTHER = "In-betweens", "Animations", "Other"
PLOT = "Plot"
BATCH = "Batch"
RANK = "Rank"
STUDIO = "Studio"
INKSCAPE = "Inkscape"
STATES = "States"
PICTURES = "Pictures, with the extra shapeblend[pictures]"

SECTIONS = (
    PLOT,
    BATCH,
    RANK,
    STUDIO,
    INKSCAPE,
    STATES,
    OUTPUT,
    SHAPES,
    CORRESPONDENCE,
    WIRE,
    IN_BETWEENS,
    ANIMATIONS,
    PICTURES,
    OTHER,
)
"""The order in which help lists options."""


class ReadOptions(Record, section=SHAPES):
    """Which shapes are taken from the files."""

    select_a: str | None = option(
        types.SELECTOR,
        default=None,
        help="Blend only these shapes of A: #id or a CSS selector.",
        default_text="all painted shapes",
    )
    select_b: str | None = option(
        types.SELECTOR, default=None, help="Blend only these shapes of B and of further files."
    )
    lenient: bool = option(
        types.FLAG,
        default=False,
        help="Draw broken path data up to the error, as browsers do, instead of refusing the file.",
    )

    def selections(self, files: int) -> tuple[str | None, ...]:
        """Return the selector of each of so many files."""
        return self.select_a, *[self.select_b] * (files - 1)


ABOUT_TWO_DRAWINGS = ("start", "pins", "match", "stiff")  # settings that name places of A and of B


class Settings(WorkConstants, section=CORRESPONDENCE):
    """How drawings are blended.

    A preset supplies the constants and the band that are not given themselves.
    """

    frames: int = option(
        types.whole(0, 10_000),
        default=5,
        section=OUTPUT,
        flags=("-n", "--frames"),
        help="Number of in-betweens between each drawing and the next.",
        default_text="5; in .gif, .webp, .apng and videos as many as --fps gives",
    )
    ends: bool = option(
        types.FLAG, default=False, section=OUTPUT, help="Include the drawings themselves, t = 0 and t = 1."
    )
    times: tuple[float, ...] | None = option(
        types.TIMES,
        default=None,
        section=OUTPUT,
        help="Times of the frames, instead of a number of in-betweens: 0 is A and 1 is B. Times from -1 to 0 and "
        "from 1 to 2 go on beyond the drawings.",
    )
    place: str = option(
        types.choice("viewbox", "bbox", "asis"),
        default="viewbox",
        section=SHAPES,
        help="How B is laid over A. viewbox: viewBox on viewBox; bbox: bounding box on bounding box; asis: in the "
        "coordinates of its file.",
    )
    specks: float | str | None = option(
        types.SPECKS,
        default=None,
        section=SHAPES,
        help="Leave out contours smaller than this: a length in units of their file, or a share of the drawing.",
    )
    vertices: int = option(
        types.whole(0, 100_000),
        default=200,
        help="Approximate number of vertices of a large contour. Smaller contours get fewer, and fewer still if "
        "there are more than 40 contours. The vertices of the drawing are always kept; 0 adds only what curves need.",
    )
    start: tuple[int, int] | None = option(
        types.START,
        default=None,
        help="Starting correspondence. auto: the best one overall; I,J: vertex I of A with vertex J of B.",
        default_text="auto",
    )
    pins: tuple[Vertices, ...] = option(
        types.PIN,
        default=(),
        many=True,
        flags=("--pin",),
        help="Vertices that must correspond: by number, or the ones nearest to a point of A and a point of B.",
    )
    mix: tuple[tuple[float, ...], ...] = option(
        types.MIX,
        default=(),
        many=True,
        section=IN_BETWEENS,
        help="Make a mixture of all files instead of in-betweens, with a share for each: .2,.5,.3. Each file "
        "corresponds with the first. A single mixture can be written to one file, .svg or .png.",
    )
    reverse: str = option(
        types.choice("auto", "yes", "no"),
        default="auto",
        help="Traverse B's contours in reverse. auto: if that makes closed contours run in the same direction; where "
        "that is ambiguous, and for open contours, both directions are tried.",
    )
    stiff: tuple[tuple[complex, float, float], ...] = option(
        types.STIFF,
        default=(),
        many=True,
        help="Make A's wire W times as stiff within the radius r of a point.",
    )
    match: tuple[Contours, ...] = option(
        types.MATCH,
        default=(),
        many=True,
        section=SHAPES,
        help="Contours that become each other: a number or an id of A, and one of B; or a point of A and a point of "
        "B. A point chooses the innermost contour around it or, if there is none, the nearest.",
    )
    unmatched: str = option(
        types.choice("auto", "point", "split"),
        default="auto",
        section=SHAPES,
        help="What happens to a contour without a partner. point: it grows from a point or shrinks to one; split: an "
        "outline of the other drawing is cut to make a partner for it; auto: split, but only where several outlines "
        "together fill the place of one. split and auto also open a ring whose partner has no hole, if that takes far "
        "less work.",
    )
    solver: str = option(
        types.choice("exact", "simplified"),
        default="exact",
        help="The paper's rigorous algorithm (section 4), or its simplified one (section 4.1).",
    )
    band: float | None = option(
        types.BAND,
        default=None,
        help="Largest diagonal deviation of the path from its start, 0 to 1 (section 5.2).",
        default_text="none",
    )
    effort: str = option(
        types.choice("auto", "exact", "fast"),
        default="auto",
        help="exact: prove the least work, however long it takes; fast: solve from coarse to fine, without proof; "
        "auto: exact if that is quick.",
    )
    preset: str | None = option(
        types.choice(*PRESETS),
        default=None,
        section=WIRE,
        help="paper: only the paper's work, as with --bending paper --kt 0 --smoothing 0; the others: also the "
        "constants and the band of a row of its table 1. Other options given with it take precedence.",
    )
    motion: str = option(
        types.choice("auto", "linear", "rigid", "intrinsic"),
        default="auto",
        section=IN_BETWEENS,
        help="How shapes move. linear: along straight lines; rigid: rotated as a whole; intrinsic: by their lengths "
        "and angles; auto: whichever of these looks best.",
    )
    strokes: str = option(
        types.choice("auto", "keep", "recover"),
        default="auto",
        section=IN_BETWEENS,
        help="auto: drawings that are made with a pen move as the lines of that pen, also where their strokes were "
        "expanded into filled shapes; recover: whatever lines there are do; keep: strokes and fills as the files have "
        "them.",
    )
    viewbox: str = option(
        types.choice("auto", "keep", "grow"),
        default="auto",
        section=IN_BETWEENS,
        help="What frames show. keep: the drawings' viewBoxes; grow: also what is outside them; auto: keep, unless "
        "something clearly visible would leave them on the way.",
    )
    style: str = option(
        types.choice("blend", "a", "b"),
        default="blend",
        section=IN_BETWEENS,
        help="Blend the paint too, or paint all frames like A or like B.",
    )
    curves: bool = option(
        types.FLAG,
        default=True,
        flags=("--curves/--polygons",),
        section=IN_BETWEENS,
        help="Draw frames with the drawings' own curves, or as the matched polygons.",
        default_text="curves",
    )
    stagger: float = option(
        types.number(0.0, 0.95),
        default=0.0,
        section=IN_BETWEENS,
        help="Start shapes one after the other. X is how late the last one starts, as a share of the time.",
        default_text="0, all at once",
    )
    stagger_by: str = option(
        types.choice("order", "size", "left", "right", "top", "bottom"),
        default="order",
        section=IN_BETWEENS,
        help="Which shape starts first: the lowest in the order of paint, the largest, or the one furthest to a side.",
    )
    ease: Ease = option(
        types.EASE,
        default=LINEAR,
        section=ANIMATIONS,
        help="Easing of animations, and of the times of in-betweens: linear, ease, ease-in, ease-out, ease-in-out "
        "or cubic-bezier(x1,y1,x2,y2).",
        default_text="linear",
    )

    def _defaults(self, given: Mapping[str, Any]) -> dict[str, Any]:
        preset = PRESETS.get(given.get("preset", ""), {})
        return super()._defaults(preset | dict(given)) | preset

    def check_drawings(self, count: int) -> None:
        """Raise OptionError if some of the settings do not go with so many drawings."""
        if count > 2 and any(getattr(self, name) for name in ABOUT_TWO_DRAWINGS):
            raise OptionError(f"--start, --pin, --match and --stiff apply to two files; {count} given")
        if count > 2 and self.strokes == "recover":
            raise OptionError(f"--strokes recover applies to two files; {count} given")
        for weights in self.mix:
            if len(weights) != count:
                shown = ",".join(f"{weight:g}" for weight in weights)
                raise OptionError(f"--mix {shown} is of {len(weights)} files; {count} given")
        if self.is_given("stagger_by") and not self.stagger:
            raise OptionError("--stagger-by sets the order of --stagger, and needs it")
        if self.stagger and self.mix:
            raise OptionError("--stagger is for blends from drawing to drawing, and --mix makes none")
        if self.times and count > 2:
            raise OptionError(f"--times applies to two files; {count} given")
        if self.times and (self.is_given("frames") or self.ends or self.mix):
            raise OptionError(
                "--times sets the frames itself; --frames, --ends and --mix cannot be given with it"
            )
        if self.mix and (self.is_given("frames") or self.ends or self.is_given("ease")):
            raise OptionError(
                "--mix sets the frames itself; --frames, --ends and --ease cannot be given with it"
            )

    @property
    def draws_ends(self) -> bool:
        """Whether frames at t = 0 and t = 1 are the drawings: not polygons of them, nor painted otherwise."""
        return self.curves and self.style == "blend"

    @property
    def makes_common_cuts(self) -> bool:
        """Whether outlines are cut at each other's vertices: not in the paper, nor where no vertices are added."""
        is_paper = self.bending == "paper" or self.solver == "simplified" or self.band is not None
        return self.vertices > 0 and not is_paper

    @property
    def constants(self) -> WorkConstants:
        """The constants of the wire alone."""
        return WorkConstants.of(vars(self))


class WriteOptions(Record, section=OUTPUT):
    """Which files a run writes."""

    force: bool = option(types.FLAG, default=False, flags=("-f", "--force"), help="Replace existing files.")
    report: str | None = option(
        types.file(),
        default=None,
        help="Write the correspondence, its work, and measurements of the frames as JSON; - for standard output.",
    )
    preview: str | None = option(
        types.file(".htm", ".html"),
        default=None,
        metavar="FILE.html",
        help="Write a web page that shows the blend, its correspondence and its graph.",
    )
    tries: str | None = option(
        types.file(".svg"),
        default=None,
        flags=("--try",),
        metavar="FILE.svg",
        help="Write a sheet of other blends of two drawings, to choose from by eye. Each has the options that give "
        "it, and a number for how wrong it looks to the judge; 0 is perfect.",
    )
    fail_on: str = option(
        types.choice("never", "poor"),
        default="never",
        help="poor: fail, and write nothing, if even the best in-betweens look poor to the judge.",
    )


class InspectOptions(Record, section=OUTPUT):
    """What `inspect` writes."""

    picture: str | None = option(
        types.file(".svg"),
        default=None,
        metavar="FILE.svg",
        help="Draw the shapes with the numbers of their contours, which --match takes.",
    )
    force: bool = option(types.FLAG, default=False, flags=("-f", "--force"), help="Replace an existing file.")


class PlotOptions(Record, section=PLOT):
    """What is drawn, and where to."""

    output: str | None = option(
        types.file(),
        default=None,
        flags=("-o", "--output"),
        help="The SVG file to write; - for standard output.",
        default_text="KIND.svg",
    )
    force: bool = option(types.FLAG, default=False, flags=("-f", "--force"), help="Replace an existing file.")
    contour: int | None = option(
        types.whole(0),
        default=None,
        metavar="K",
        help="A contour of A, by its number in the report.",
        default_text="the largest that is matched",
    )
    dot: tuple[int, int] | None = option(
        types.START,
        default=None,
        metavar="I,J",
        help="For angle: vertex I of A and vertex J of B, which correspond.",
        default_text="the dot with the most bending work; 0",
    )


class RankOptions(Record, section=RANK):
    """How drawings are ranked, and what is printed and written."""

    by: str = option(
        types.choice("looks", "work"),
        default="looks",
        help="What comes first. looks: the blend that looks least wrong to the judge; work: the one with the least "
        "work.",
    )
    top: int | None = option(types.whole(1), default=None, help="List only the first N.", default_text="all")
    as_json: bool = option(
        types.FLAG, default=False, key="json", help="Print a line of JSON for each drawing, for programs."
    )
    sheet: str | None = option(
        types.file(".svg"),
        default=None,
        metavar="FILE.svg",
        help="Write a contact sheet: a row of in-betweens for each drawing that is listed.",
    )
    force: bool = option(
        types.FLAG, default=False, flags=("-f", "--force"), help="Replace an existing sheet."
    )
    jobs: int | None = option(
        types.whole(1, 1024),
        default=None,
        flags=("-j", "--jobs"),
        help="Number of blends made at a time.",
        default_text="the number of processors",
    )


class StudioOptions(Record, section=STUDIO):
    """How the studio is opened."""

    port: int | None = option(
        types.whole(1, 65_535), default=None, help="Port of the page.", default_text="a free one"
    )
    open: bool = option(
        types.FLAG,
        default=True,
        flags=("--open/--no-open",),
        help="Open the page in the browser, or only print its address.",
        default_text="open, if there is a screen",
    )


class StatesOptions(Record, section=STATES):
    """What a drawing of several states is."""

    output: str = option(
        types.file(".svg", ".js", "-"),
        default="states.svg",
        flags=("-o", "--output"),
        metavar="FILE",
        help="An SVG, or a JavaScript module (.js) with a custom element for web pages; - for an SVG on standard "
        "output.",
    )
    force: bool = option(types.FLAG, default=False, flags=("-f", "--force"), help="Replace an existing file.")
    trigger: str = option(
        types.choice("none", "click", "hover"),
        default="none",
        help="What changes the state of an SVG. none: only the page around it; click: a click, Enter or Space moves "
        "on to the next state; hover: the second state is shown while the pointer is on it or it has the keyboard's "
        "focus. A custom element has the attribute trigger for this.",
    )
    duration: float = option(
        types.number(0.0, 3600.0), default=0.3, metavar="S", help="Seconds from one state to another."
    )
    element: str | None = option(
        types.ELEMENT,
        default=None,
        metavar="NAME",
        help="Name of the custom element, with a hyphen in it.",
        default_text="the name of the file, with -states",
    )
    precision: int | None = option(
        types.whole(0, 10),
        default=None,
        help="Decimal places of coordinates.",
        default_text="by the size of the drawings",
    )


class InkscapeOptions(Record, section=INKSCAPE):
    """What is blended in a document of Inkscape, and what becomes of it."""

    ids: tuple[str, ...] = option(
        types.TEXT,
        default=(),
        many=True,
        flags=("--id",),
        metavar="ID",
        help="Id of a selected object. The lowest object in the document comes first.",
    )
    frames_as: str = option(
        types.choice("group", "layers"),
        default="group",
        key="as",
        help="Put the in-betweens into one group right above the lower object, or each into a layer.",
    )


class InstallOptions(Record, section=INKSCAPE):
    """Where the extension goes."""

    folder: str | None = option(
        types.file(),
        default=None,
        metavar="FOLDER",
        help="Where Inkscape looks for extensions.",
        default_text="the one that Inkscape names, or else the usual one",
    )


class RunOptions(Record, section=OTHER):
    """How long a command may take."""

    timeout: float | None = option(
        types.number(0.0, 1e6, above=True),
        default=None,
        metavar="S",
        help="Stop after S seconds, with an error and with nothing written.",
        default_text="none",
    )


class TerminalOptions(Record, section=OTHER):
    """What a command prints."""

    quiet: bool = option(
        types.FLAG,
        default=False,
        flags=("-q", "--quiet"),
        help="Print only errors, and a line if frame files of another run remain.",
    )
    verbose: bool = option(
        types.FLAG,
        default=False,
        flags=("-v", "--verbose"),
        help="Print what was done, and how long it took.",
    )


REPORTED = (
    "frames ends output emit force select_a select_b lenient place vertices start pins reverse stiff match unmatched "
    "solver band effort preset ks kb es eb pb mb cs bending kt smoothing motion viewbox style curves precision animate "
    "duration ease repeat format width columns background fps report preview"
).split()
"""The order of the settings in reports of format 1; any others follow."""


def report_settings(*records: Record) -> dict[str, Any]:
    """Return the values of records as the report lists them."""
    values: dict[str, Any] = {}
    for record in records:
        values |= record.listed
    values["start"] = values["start"] or "auto"
    return {key: values[key] for key in REPORTED if key in values} | values
