"""Options of an output, with checks and defaults by format. Help takes the formats from their registry."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from shapeblend_cli.errors import OptionError
from shapeblend_cli.options.easing import LINEAR, Ease, Timing
from shapeblend_cli.options.fields import Record, option
from shapeblend_cli.options.settings import ANIMATIONS, IN_BETWEENS, OUTPUT, PICTURES, Settings
from shapeblend_cli.options.triggers import Trigger
from shapeblend_cli.options.types import COLOUR, FLAG, HOLD, REPEAT, TRIGGER, choice, file, seconds, whole
from shapeblend_cli.outputs.formats import FASTEST, Format, OutputSpec
from shapeblend_cli.outputs.pixels import MOST_SIDE
from shapeblend_cli.outputs.registry import DEFAULT, EMITS, FORMATS, FRAME_FORMATS, alternatives, choose

BY_SUFFIX = ", or --output with a suffix such as .gif in its place"
"""The end of errors about formats that have no word."""

LONG = 60.0
"""Time from which a line says how long it is, in seconds. Few drawings move for a minute, and milliseconds are easily
meant."""

SHARED = {
    "columns": "a contact sheet",
    "fps": "a raster animation",
    "width": "pictures",
    "background": "pictures",
}
"""Options that several formats take, and their purposes."""

PLAYING = "animations, a name ending in " + alternatives(
    list(dict.fromkeys(format.suffix for format in FORMATS if format.plays))
)
"""Purpose of options of time, in errors."""


def _by_suffix() -> str:
    suffixes: dict[str, list[str]] = {}
    taken: set[str] = set()
    for format in FORMATS:
        if format.suffix and format.suffix not in taken:
            taken.add(format.suffix)
            suffixes.setdefault(format.help, []).append(format.suffix)
    return "; in ".join(f"{alternatives(names)}: {help}" for help, names in suffixes.items())


def _by_emit() -> dict[str, Format]:
    """Return the first format of each value of --emit but the first."""
    found: dict[str, Format] = {}
    for format in FORMATS:
        found.setdefault(format.emit, format)
    del found[EMITS[0]]
    return found


def _default_text(name: str) -> str:
    formats: dict[object, list[str]] = {}
    for format in FORMATS:
        if name in format.defaults:
            formats.setdefault(format.defaults[name], []).append(format.suffix or f"--format {format.name}")
    return "; ".join(f"{value} for {', '.join(names)}" for value, names in formats.items())


class OutputOptions(Record, section=PICTURES):
    """Options for writing a blend. None means the format's default."""

    output: str | None = option(
        file(),
        default=None,
        flags=("-o", "--output"),
        metavar="PATH",
        section=OUTPUT,
        help=f"A folder: one file for each frame. A name ending in {_by_suffix()}. -: an animated SVG on standard "
        "output.",
        default_text="; ".join(
            [DEFAULT]
            + [
                f"{DEFAULT}{form.suffix} with --emit {emit}"
                for emit, form in _by_emit().items()
                if form.suffix
            ]
        ),
    )
    emit: str = option(
        choice(*EMITS, elsewhere=BY_SUFFIX),
        default=EMITS[0],
        section=OUTPUT,
        help="; ".join(
            ["frames: the format that --output names"]
            + [f"{emit}: {form.help}" for emit, form in _by_emit().items()]
        )
        + ".",
    )
    precision: int | None = option(
        whole(0, 10),
        default=None,
        section=IN_BETWEENS,
        help="Decimal places of coordinates.",
        default_text="by the size of the drawings",
    )
    animate: str = option(
        choice("smil", "css", "frames"),
        default="smil",
        section=ANIMATIONS,
        help="How an animated SVG moves: SMIL or CSS animations of its paths, or all frames in turn, which works "
        "everywhere. Those that repeat forever stand still for those who prefer reduced motion; with css, all do. "
        "Safari does not play CSS animations.",
    )
    duration: float = option(
        seconds(0.01, 3600.0),
        default=2.0,
        section=ANIMATIONS,
        help="Seconds that an animation takes from one drawing to the next; 300ms works, too.",
    )
    repeat: int | str = option(
        REPEAT,
        default="forever",
        flags=("--loop", "--repeat"),
        section=ANIMATIONS,
        help="Number of runs of an animation; pingpong: forwards and backwards, forever.",
    )
    hold: tuple[float, float] = option(
        HOLD,
        default=(0.0, 0.0),
        section=ANIMATIONS,
        help="Seconds that an animation rests at each drawing; two numbers: at the first one, and at the others.",
        default_text="0",
    )
    delay: float = option(
        seconds(0.0, 3600.0),
        default=0.0,
        section=ANIMATIONS,
        help="Seconds before an animation begins. Animated SVGs wait once; what repeats as a whole, such as Lottie, GIF"
        " and video, waits before each run.",
    )
    trigger: Trigger = option(
        TRIGGER,
        default=Trigger(),
        section=ANIMATIONS,
        help="What starts an animated SVG. load: it starts by itself; click: a click, Space or, with smil, Enter plays "
        "it, and the next one plays it back; hover: it plays when it gets the pointer or the keyboard's focus, and "
        "plays back when it loses them; NAME.event: an event of the element with that id plays it, with --animate "
        "smil.",
        default_text="load",
    )
    format: str | None = option(
        choice(*FRAME_FORMATS, elsewhere=BY_SUFFIX),
        default=None,
        help="Format of the files in a folder of frames.",
        default_text=FRAME_FORMATS[0],
    )
    width: int | None = option(
        whole(1, MOST_SIDE),
        default=None,
        metavar="PX",
        help="Width of a picture, or of a cell of a contact sheet, in pixels.",
        default_text=_default_text("width"),
    )
    columns: int | None = option(
        whole(1, 10_000),
        default=None,
        help="Columns of a contact sheet.",
        default_text="by the number of frames",
    )
    background: str | None = option(
        COLOUR,
        default=None,
        help="Colour behind pictures, or transparent.",
        default_text=_default_text("background"),
    )
    lossless: bool = option(
        FLAG,
        default=False,
        help="Keep every pixel of a WebP as it is; the file is larger.",
    )
    fps: int | None = option(
        whole(1, FASTEST),
        default=None,
        help=f"Frames per second of an animation, at most {FASTEST}, unless --frames is given.",
        default_text=_default_text("fps"),
    )


def specify(options: OutputOptions, settings: Settings, drawings: int = 2) -> OutputSpec:
    """Choose the format that is asked for, check the options, and fill in the defaults of the format.

    The motion ``auto`` becomes that of the format. Options that contradict each other, or do not go with the format,
    raise OptionError.
    """
    format, path = choose(options.emit, options.output, options.format, drawings)
    asked = f"--output {path}" if options.emit == "frames" else f"--emit {options.emit}"
    for name, what in SHARED.items():
        if getattr(options, name) is not None and name not in format.defaults:
            raise OptionError(f"--{name} is for {what}, {_ways_to(name)}, not for {asked}")
    if options.format is not None and not format.has_frame_files:
        raise OptionError(f"--format is for a folder with a file for each frame, not for {asked}")
    defaults: dict[str, Any] = dict(format.defaults)
    if settings.is_given("frames"):
        defaults.pop("fps", None)
        if options.fps is not None:
            raise OptionError("--frames and --fps both set how many pictures there are; one is enough")
    if settings.has_spans and not format.takes_stagger:
        raise OptionError(f"{settings.spans_by} is for frames and what plays, not for {asked}")
    for name, is_asked in {"hold": any(options.hold), "delay": options.delay > 0.0}.items():
        if is_asked and not format.plays:
            raise OptionError(f"--{name} is for {PLAYING}, not for {asked}")
        if is_asked and not options.trigger.is_load:
            raise OptionError(
                f"--{name} is for animations that start by themselves; --trigger {options.trigger} waits for an event"
            )
    if settings.times and not format.takes_times:
        raise OptionError(f"--times is for a folder of frames, a contact sheet or layers, not for {asked}")
    if options.lossless and format.name != "webp":
        raise OptionError(f"--lossless is for WebP, a name ending in .webp, not for {asked}")
    if settings.mix:
        _check_mix(options, settings, format, asked)
    if not options.trigger.is_load:
        _check_trigger(
            options, format, drawings, asked, staggered=settings.spans_by if settings.has_spans else ""
        )
    if settings.motion == "auto":
        # CSS transitions go straight from value to value.
        is_transition = options.animate == "css" and not options.trigger.is_load
        settings = Settings.of({**settings.given, "motion": "linear" if is_transition else format.motion})
    ease = settings.common_ease if isinstance(settings.common_ease, Ease) else LINEAR
    hold, delay = options.hold, options.delay
    if not format.takes_triggers:  # in other files, to wait is to rest
        hold, delay = (hold[0] + delay, hold[1]), 0.0
    timing = Timing(options.duration, ease, options.repeat, hold, delay)
    shared: dict[str, Any] = {name: getattr(options, name) or defaults.get(name) for name in SHARED}
    spec = OutputSpec(
        format,
        path,
        settings,
        drawings,
        timing,
        options.animate,
        options.trigger,
        options.precision,
        **shared,
        lossless=options.lossless,
    )
    format.check(spec)
    return spec


def long_times(options: OutputOptions) -> Iterator[str]:
    """Yield a line for each time that is so long that milliseconds may have been meant.

    Examples
    --------
    >>> list(long_times(OutputOptions(duration=300)))
    ['--duration 300 is 5 minutes; 300ms would be 0.3 seconds']
    """
    for name, time in {
        "duration": options.duration,
        "hold": max(options.hold),
        "delay": options.delay,
    }.items():
        if time >= LONG:
            short = f"{time:g}ms would be {time / 1000.0:g} seconds"
            yield f"--{name} {time:g} is {time / 60.0:.3g} minute{'s' * (time > 60.0)}; {short}"


def check_runs(spec: OutputSpec) -> None:
    """Raise OptionError for an output that has no runs, as it does not play."""
    if not spec.format.plays:
        emit = spec.format.emit
        asked = f"--output {spec.path}" if emit == EMITS[0] else f"--emit {emit}"
        raise OptionError(f"--repeat is for {PLAYING}, not for {asked}")


def _check_mix(options: OutputOptions, settings: Settings, format: Format, asked: str) -> None:
    if format.mixtures == "none":
        raise OptionError(f"--mix is for a folder, or for a name ending in .svg or .png, not for {asked}")
    if format.mixtures == "one" and (len(settings.mix) > 1 or not options.trigger.is_load):
        raise OptionError(f"{asked} takes one mixture, which stands still; a folder takes several")


def _check_trigger(
    options: OutputOptions, format: Format, drawings: int, asked: str, *, staggered: str
) -> None:
    given = f"--trigger {options.trigger}"
    if not format.takes_triggers or options.animate == "frames":
        what = "--animate frames" if format.takes_triggers else asked
        raise OptionError(
            f"{given} is for an animated SVG, --output FILE.svg with --animate smil or css, not for {what}"
        )
    if options.is_given("repeat"):
        raise OptionError(
            f"--repeat is for animations that start by themselves; with {given} each event plays them once"
        )
    if options.animate == "css" and options.trigger.name:
        raise OptionError(f"{given}: CSS knows no events of other elements; --animate smil does")
    if options.animate == "css" and staggered:
        raise OptionError(f"{staggered} with {given} needs --animate smil: CSS transitions all start at once")
    if options.animate == "css" and drawings > 2:
        raise OptionError(
            f"{given} with --animate css takes two files; {drawings} given. --animate smil takes more, and "
            "shapeblend states makes one drawing of several states"
        )


def _ways_to(name: str) -> str:
    takers = [format for format in FORMATS if name in format.defaults]
    folders = [f", or a folder with --format {format.name}" for format in takers if not format.suffix]
    suffixes = [format.suffix for format in takers if format.suffix]
    return f"a name ending in {alternatives(suffixes)}{''.join(folders)}"
