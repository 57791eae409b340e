"""The settings of a blend, which are checked when they are made. The options of commands are made from them.

Nothing heavy is imported here, for the sake of ``--help``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from shapeblend_cli.errors import OptionError
from shapeblend_cli.options import types
from shapeblend_cli.options.constants import PRESETS, WIRE, WorkConstants
from shapeblend_cli.options.easing import LINEAR, Curve, Easing
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.timetable import Timetable

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
"""Order of the sections of options in help."""


class ReadOptions(Record, section=SHAPES):
    """Which shapes are taken from the files."""

    select_a: str | None = option(
        types.SELECTOR,
        default=None,
        help="Blend only these shapes of A: #id, a CSS selector, or numbers as inspect prints them, such as 0,2.",
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
    text: str = option(
        types.choice("outline", "keep", "skip"),
        default="outline",
        help="outline: each letter is a shape, drawn with the font that the file embeds or that is installed; equal "
        "letters become each other. keep: text that all drawings have stays text in SVG frames and animations. "
        "skip: text is left out.",
    )
    images: str = option(
        types.choice("embedded", "beside", "skip"),
        default="embedded",
        help="embedded: pictures that are in the file itself go along, PNG, JPEG and WebP; beside: also files in the "
        "drawing's folder or below it; skip: pictures are left out.",
    )

    def selections(self, files: int) -> tuple[str | None, ...]:
        """Return the selector of each file."""
        return self.select_a, *[self.select_b] * (files - 1)


ABOUT_TWO_DRAWINGS = ("start", "pins", "match", "stiff")
"""Settings that name places of A and of B."""


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
        help="How B is laid over A. viewbox: viewBox on viewBox, at one scale if they are as wide or as high; bbox: "
        "bounding box on bounding box; asis: in the coordinates of its file.",
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
        help="Vertices that must correspond: by number, or the vertices nearest to a point of A and a point of B.",
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
        help="Pair two contours or pen lines, which inspect lists: a number or an id of A with a number or an id of B, "
        "or a point of A with a point of B. A point chooses the nearest pen line, or the innermost contour around it, "
        "or the nearest one.",
    )
    unmatched: str = option(
        types.choice("auto", "point", "split"),
        default="auto",
        section=SHAPES,
        help="What happens to a contour without a partner. point: it grows from a point or shrinks to one; split: an "
        "outline of the other drawing is cut to make a partner for it; auto: split, but only where several outlines "
        "together fill the place of one. split and auto also open a ring whose partner has one hole fewer, if that "
        "takes far less work.",
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
        "auto: solve exactly if that is quick, cut both outlines at each other's vertices, and solve again near that "
        "result.",
    )
    preset: str | None = option(
        types.choice(*PRESETS),
        default=None,
        section=WIRE,
        help="paper: the paper's work alone, as with --bending paper --kt 0 --smoothing 0; fig1 and so on: also the "
        "constants and the band of that figure in the paper's table 1. Options that are given too take precedence.",
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
        help="Lines of a pen. auto: drawings made with a pen move as its lines, even if their strokes were expanded "
        "into filled shapes, and strokes that meet fills become outlines; recover: every line that can be recovered "
        "moves so; keep: strokes and fills stay as they are in the files.",
    )
    swap: str = option(
        types.choice("auto", "never", "always"),
        default="auto",
        section=IN_BETWEENS,
        help="Let the first drawing shrink away, and the second one grow in its place, instead of a blend. auto: icons "
        "drawn with a pen whose lines have too little in common, such as a gear and a cross, and other drawings that "
        "would not blend well; where silhouettes are alike, they change over half way, and where one icon is the "
        "other one filled, a level rises between them. Not with --match, --pin, "
        "--stiff or another --motion than auto, nor with --place asis for drawings without pen lines. Mixtures, and "
        "shapes with times of their own, are always blended.",
    )
    viewbox: str = option(
        types.choice("auto", "keep", "grow"),
        default="auto",
        section=IN_BETWEENS,
        help="Part of the plane that frames show. keep: the drawings' viewBoxes; grow: also shapes outside of them; "
        "auto: keep, unless something clearly visible would leave them on the way.",
    )
    warp: str = option(
        types.choice("auto", "svg", "off"),
        default="auto",
        section=IN_BETWEENS,
        help="Pictures in outlines. auto: a picture that an outline clips or surrounds is bent with it where pixels "
        "are drawn, in .png, .gif and so on; svg: in SVG frames, too, as triangles; off: pictures move as a whole.",
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
        help="Start shapes one after the other. X is the start of the last shape, as a share of the time.",
        default_text="0, all at once",
    )
    stagger_by: str = option(
        types.choice("order", "size", "left", "right", "top", "bottom"),
        default="order",
        section=IN_BETWEENS,
        help="Which shape starts first: the lowest in the order of paint, the largest, or the one furthest to a side.",
    )
    timing: Timetable = option(
        types.TIMING,
        default=Timetable(),
        section=IN_BETWEENS,
        help="When each part moves: a JSON file, or JSON itself, with starts and lengths as shares of the time: "
        '{"#sun": {"start": 0.2, "length": 0.5}}. A key is the #id of a shape or a group, or the number of a shape of '
        "A as inspect prints it; B3 is shape 3 of B.",
        default_text="all move all the time",
    )
    ease: Easing = option(
        types.EASE,
        default=LINEAR,
        flags=("--easing", "--ease"),
        section=ANIMATIONS,
        help="Easing of animations, and of the times of in-betweens: linear, ease, ease-in, ease-out, ease-in-out "
        "or cubic-bezier(x1,y1,x2,y2); beyond the drawings and back: back, elastic, both also with -in, -out or "
        "-in-out, spring(mass,stiffness,damping) and linear(0,...,1) as in CSS.",
        default_text="linear",
    )

    def _defaults(self, given: Mapping[str, Any]) -> dict[str, Any]:
        preset = PRESETS.get(given.get("preset", ""), {})
        return super()._defaults(preset | dict(given)) | preset

    def check_drawings(self, count: int) -> None:
        """Raise OptionError if some of the settings do not go with this number of drawings."""
        if count > 2 and any(getattr(self, name) for name in ABOUT_TWO_DRAWINGS):
            raise OptionError(f"--start, --pin, --match and --stiff apply to two files; {count} given")
        for weights in self.mix:
            if len(weights) != count:
                shown = ",".join(f"{weight:g}" for weight in weights)
                raise OptionError(f"--mix {shown} has {len(weights)} shares; {count} files given")
        if self.is_given("stagger_by") and not self.stagger:
            raise OptionError("--stagger-by sets the order of --stagger, and needs it")
        if self.stagger and self.mix:
            raise OptionError("--stagger is for blends from drawing to drawing; --mix makes mixtures")
        if self.stagger and self.timing.parts:
            raise OptionError("--stagger and --timing both say when parts move; one is enough")
        if self.timing.parts and self.mix:
            raise OptionError("--timing is for blends from drawing to drawing; --mix makes mixtures")
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
    def eases_parts(self) -> bool:
        """Whether each part is eased by itself, and time as a whole is not."""
        return self.has_spans and isinstance(self.ease, Curve)

    @property
    def is_free(self) -> bool:
        """Whether a blend may take any motion and pace."""
        return self.motion == "auto" and not (self.mix or self.has_spans)

    @property
    def is_star(self) -> bool:
        """Whether drawings are mixed, and parts go straight, those without a partner to points."""
        return bool(self.mix) and self.motion == "linear" and self.unmatched == "point"

    @property
    def has_states(self) -> bool:
        """Whether they are those of states: of mixtures with one drawing in each."""
        return self.is_star and all(1.0 in weights for weights in self.mix)

    @property
    def has_spans(self) -> bool:
        """Whether parts have times of their own."""
        return bool(self.stagger or self.timing.parts)

    @property
    def spans_by(self) -> str:
        """The option that gives parts times of their own."""
        return "--stagger" if self.stagger else "--timing"

    @property
    def common_ease(self) -> Easing:
        """The easing of all parts together."""
        return LINEAR if self.eases_parts else self.ease

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
