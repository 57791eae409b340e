"""Text into outlines: characters are shaped by HarfBuzz and placed as https://www.w3.org/TR/SVG2/text.html says."""

from __future__ import annotations

import cmath
import unicodedata
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from functools import cache, cached_property
from itertools import accumulate, groupby, pairwise
from typing import Any, NamedTuple

import numpy as np

from shapeblend_cli.model import Contour
from shapeblend_cli.svg.reading import contours
from shapeblend_cli.svg.reading.directions import in_visual_order, levels_of, scripts_of
from shapeblend_cli.svg.reading.fonts import INSTALL, Face, Fonts, Wanted, families, weight_of
from shapeblend_cli.svg.styles.cascade import Inherited
from shapeblend_cli.svg.xml.messages import Notes, check_limit, printable
from shapeblend_cli.svg.xml.units import LIMIT, Lengths
from shapeblend_cli.svg.xml.xmltree import Node

MOST_CHARACTERS = 20_000
"""Maximum number of characters of a drawing."""

MOST_DEPTH = 32
"""Maximum depth of spans in a text."""

STEPS = 64
"""Number of steps in which a segment is measured that carries text."""

_ANCHORS = {"start": 0.0, "middle": 0.5, "end": 1.0}
# Letters that are joined stay so: browsers put no space between them.
_CURSIVE = frozenset(("Arab", "Mand", "Mong", "Nkoo", "Phag", "Rohg", "Syrc"))
_LETTERS_APART = {"liga": False, "clig": False, "dlig": False, "hlig": False}


class Span(NamedTuple):
    """An element with text, which has the characters from `start` on; the `path` of a ``textPath`` carries them."""

    node: Node
    inherited: Inherited
    lengths: Lengths
    start: int
    path: tuple[Contour, ...] | None = None


class Letter(NamedTuple):
    """What is painted for one character, or several that a font joins, in the coordinates of its span."""

    span: int
    letters: str
    contours: list[Contour]


class Text(NamedTuple):
    """The characters of a text element, white space collapsed, each with the number of its span; and ends of spans."""

    characters: list[tuple[str, int]]
    spans: list[Span]
    ends: list[int]

    def add(self, text: str, span: int, keeps_blanks: bool) -> None:
        """Add characters; blanks are one unless all of them are kept."""
        for character in text:
            is_blank = character in " \t\r\n"
            if is_blank and not keeps_blanks:
                if not self.characters or self.characters[-1][0] == " ":
                    continue
            self.characters.append((" " if is_blank else character, span))


class _Style(NamedTuple):
    """What decides about shapes and distances of letters."""

    wanted: Wanted
    size: float
    between_letters: float
    between_words: float
    is_rtl: bool


class _Run(NamedTuple):
    """Characters from a number on that are shaped together."""

    start: int
    text: str
    style: _Style
    face: Face
    level: int
    script: str


class _Cluster(NamedTuple):
    start: int
    letters: str
    glyphs: list[tuple[int, complex]]  # their numbers and offsets
    advance: float
    run: _Run
    stretch: float = 1.0  # along the line


class Texts:
    """The texts of one drawing."""

    def __init__(self, sheets: Sequence[str], notes: Notes) -> None:
        self._notes = notes
        self._fonts = Fonts(sheets, notes)
        self._characters = 0
        self._told: set[str] = set()
        self._outlines: dict[tuple[int, int], list[_Path]] = {}

    @cached_property
    def is_available(self) -> bool:
        """Whether the libraries are installed; if not, a note says how to get them."""
        try:
            import fontTools.unicodedata  # noqa: F401
            import uharfbuzz  # noqa: F401
        except ImportError:
            self._tell(f"text left out: {INSTALL} to draw it")
            return False
        return True

    @property
    def fonts(self) -> Fonts:
        """The fonts of the drawing."""
        return self._fonts

    def letters(self, text: Text) -> list[Letter]:
        """Return the letters of a text in the order of reading, those of each line as they are seen."""
        while text.characters and text.characters[-1][0] == " ":
            text.characters.pop()
        self._characters += len(text.characters)
        check_limit(self._characters, MOST_CHARACTERS, "characters")
        places = Places.of(text)
        pen = 0j
        found: list[Letter] = []
        for start, end in places.chunks(text):
            pen = complex(
                pen.real if places.x[start] is None else places.x[start] or 0.0,
                pen.imag if places.y[start] is None else places.y[start] or 0.0,
            )
            laid, pen = self._chunk(text, places, start, end, pen)
            found += laid
        return found

    def _tell(self, phrase: str) -> None:
        """Note a phrase once."""
        if phrase not in self._told:
            self._told.add(phrase)
            self._notes.add(phrase)

    def _chunk(
        self, text: Text, places: Places, start: int, end: int, pen: complex
    ) -> tuple[list[Letter], complex]:
        """Return the letters between two numbers, anchored together, and where the next ones begin."""
        clusters = [cluster for run in self._runs(text, start, end) for cluster in self._shaped(run)]
        clusters = _fitted(clusters, text, start, end)
        first = text.spans[text.characters[start][1]]
        begin = pen
        origins = []
        for cluster in clusters:
            shift = sum(
                complex(places.dx[k], places.dy[k])
                for k in range(cluster.start, cluster.start + len(cluster.letters))
            )
            pen += shift
            origins.append(pen)
            pen += cluster.advance
        share = _ANCHORS.get(first.inherited.text.get("text-anchor", "start").strip().lower(), 0.0)
        if _is_rtl(first.inherited):
            share = 1.0 - share
        moved = -share * (pen - begin).real
        rail = _Rail.of(first) if first.path is not None else None
        letters = []
        for cluster, origin in zip(clusters, origins, strict=True):
            span = text.spans[text.characters[cluster.start][1]]
            turn = cmath.rect(1.0, np.radians(places.rotate[cluster.start]))
            place = origin + moved
            if first.path is not None:
                on_path = rail.place(place, cluster.advance, first) if rail else None
                if on_path is None:
                    continue
                place, along = on_path
                turn *= along
            place += turn * 1j * _baseline(span, cluster.run)
            drawn = self._drawn(cluster, place, turn)
            if drawn:
                letters.append(Letter(text.characters[cluster.start][1], cluster.letters, drawn))
        return letters, pen

    def _runs(self, text: Text, start: int, end: int) -> list[_Run]:
        """Return the runs between two numbers as they are seen, from left to right."""
        styles = {k: style_of(text.spans[k]) for k in {span for _, span in text.characters[start:end]}}
        characters = "".join(character for character, _ in text.characters[start:end])
        base = _is_rtl(text.spans[text.characters[start][1]].inherited)
        levels, scripts = levels_of(characters, base), scripts_of(characters)
        keys = []
        face: Face | None = None
        for k, character in enumerate(characters):
            style = styles[text.characters[start + k][1]]
            before = styles[text.characters[start + k - 1][1]] if k else style
            face = self._face(character, style.wanted, face if before == style else None)
            keys.append((style, face, levels[k], scripts[k]))
        runs = []
        for key, group in groupby(range(len(characters)), lambda k: keys[k]):
            members = list(group)
            style, face, level, script = key
            if face is not None and style.size > 0:
                part = characters[members[0] : members[-1] + 1]
                runs.append(_Run(start + members[0], part, style, face, level, script))
        return in_visual_order(runs, [run.level for run in runs])

    def _face(self, character: str, wanted: Wanted, before: Face | None) -> Face | None:
        """Return the font for a character: marks and blanks have that of the character before."""
        category = unicodedata.category(character)
        if before is not None and (category[0] in "MZC") and (before.has(character) or category == "Cf"):
            return before
        faces = self._fonts.faces(wanted)
        own = next((face for face in faces if face.has(character)), None)
        if own is not None:
            return own
        face = self._fonts.fallback(wanted, character)
        if face is None:
            if category[0] not in "ZC":
                self._tell(f"no font has the letter '{printable(character)}'")
            return faces[0] if faces else None
        self._tell(f"{face.name} taken for letters that no font of the drawing has")
        return face

    def _shaped(self, run: _Run) -> Iterator[_Cluster]:
        """Yield the clusters of a run from left to right."""
        import uharfbuzz as hb

        buffer = hb.Buffer()
        buffer.add_codepoints(list(map(ord, run.text)))
        buffer.guess_segment_properties()
        buffer.direction = "rtl" if run.level % 2 else "ltr"
        between_letters = 0.0 if run.script in _CURSIVE else run.style.between_letters
        hb.shape(run.face.font, buffer, _LETTERS_APART if between_letters else {})
        scale = run.style.size / run.face.unit
        glyphs = list(zip(buffer.glyph_infos, buffer.glyph_positions, strict=True))
        numbers = sorted({info.cluster for info, _ in glyphs})
        ends = dict(zip(numbers, [*numbers[1:], len(run.text)], strict=True))
        for cluster, group in groupby(glyphs, lambda glyph: glyph[0].cluster):
            parts, advance = [], 0.0
            for info, position in group:
                offset = complex(advance + position.x_offset, -position.y_offset)
                parts.append((info.codepoint, offset * scale))
                advance += position.x_advance
            letters = run.text[cluster : ends[cluster]]
            spacing = between_letters + run.style.between_words * letters.count(" ")
            yield _Cluster(run.start + cluster, letters, parts, advance * scale + spacing, run)

    def _drawn(self, cluster: _Cluster, place: complex, turn: complex) -> list[Contour]:
        found = []
        scale, stretch = cluster.run.style.size / cluster.run.face.unit, cluster.stretch
        for number, offset in cluster.glyphs:
            origin, factor = place + complex(stretch * offset.real, offset.imag) * turn, turn * scale
            if not max(abs(origin.real), abs(origin.imag)) < LIMIT:
                continue
            for path in self._outline(cluster.run.face, number):
                segments = [
                    tuple(
                        origin + factor * complex(cluster.stretch * point.real, point.imag)
                        for point in segment
                    )
                    for segment in path.segments
                ]
                contour = contours.chain(segments, path.straight, closed=True)
                found += [contour] if contour is not None else []
        if not found and cluster.letters.strip() and unicodedata.category(cluster.letters[0])[0] not in "ZC":
            self._tell(f"letters left out for which {cluster.run.face.name} has no outline")
        return found

    def _outline(self, face: Face, number: int) -> list[_Path]:
        """Return a glyph in units of its font, with y down."""
        key = id(face.font), number
        if key not in self._outlines:
            paths: list[_Path] = []
            face.font.draw_glyph(number, _drawing(), paths)
            self._outlines[key] = paths
        return self._outlines[key]


class _Path(NamedTuple):
    start: complex
    segments: list[contours.Segment]
    straight: list[bool]


@cache
def _drawing() -> Any:
    """Return functions for HarfBuzz that add what they are told to a list of paths."""
    import uharfbuzz as hb

    def add(paths: list[_Path], segment: contours.Segment, is_straight: bool) -> None:
        paths[-1].segments.append(segment)
        paths[-1].straight.append(is_straight)

    def pen(paths: list[_Path]) -> complex:
        path = paths[-1]
        return path.segments[-1][-1] if path.segments else path.start

    def move(x: float, y: float, paths: list[_Path]) -> None:
        paths.append(_Path(complex(x, -y), [], []))

    def line(x: float, y: float, paths: list[_Path]) -> None:
        add(paths, contours.line(pen(paths), complex(x, -y)), True)

    def quadratic(x1: float, y1: float, x: float, y: float, paths: list[_Path]) -> None:
        add(paths, contours.quadratic(pen(paths), complex(x1, -y1), complex(x, -y)), False)

    def cubic(x1: float, y1: float, x2: float, y2: float, x: float, y: float, paths: list[_Path]) -> None:
        add(paths, (pen(paths), complex(x1, -y1), complex(x2, -y2), complex(x, -y)), False)

    functions = hb.DrawFuncs()
    functions.set_move_to_func(move)
    functions.set_line_to_func(line)
    functions.set_quadratic_to_func(quadratic)
    functions.set_cubic_to_func(cubic)
    functions.set_close_path_func(lambda paths: None)
    return functions


class Places(NamedTuple):
    """The attributes x, y, dx, dy and rotate of each character; no place is that after the character before."""

    x: list[float | None]
    y: list[float | None]
    dx: list[float]
    dy: list[float]
    rotate: list[float]

    @classmethod
    def of(cls, text: Text) -> Places:
        """Read the attributes of the spans; those of inner ones count."""
        count = len(text.characters)
        places = cls([None] * count, [None] * count, [0.0] * count, [0.0] * count, [0.0] * count)
        for span, end in zip(text.spans, text.ends, strict=True):
            for name, values in places._asdict().items():
                given = _list(span, name, count)
                if name == "rotate" and given:
                    given += given[-1:] * (end - span.start - len(given))
                for k, value in zip(range(span.start, min(end, count)), given, strict=False):
                    values[k] = value
        return places

    def chunks(self, text: Text) -> Iterator[tuple[int, int]]:
        """Yield the first and the last number of characters that are anchored together."""
        paths = [text.spans[span].path for _, span in text.characters]
        begins = [
            k
            for k in range(len(paths))
            if k == 0 or self.x[k] is not None or self.y[k] is not None or paths[k] is not paths[k - 1]
        ]
        return pairwise([*begins, len(paths)]) if paths else iter(())


def _list(span: Span, name: str, most: int) -> list[float]:
    written = (span.node.get(name) or "")[: 40 * most + 40].replace(",", " ").split()[: max(most, 1)]
    read = span.lengths.y if name in ("y", "dy") else span.lengths.x
    values = []
    for part in written:
        value = read(part)
        if value is None:
            break
        values.append(value)
    return values


def style_of(span: Span) -> _Style:
    """Return what decides about the shapes and distances of a span's letters."""
    given, size = span.inherited.text, span.inherited.font_size

    def spacing(name: str) -> float:
        return Lengths(size, size, size).x(given.get(name, "0")) or 0.0

    slanted = given.get("font-style", "normal").strip().lower().startswith(("italic", "oblique"))
    wanted = Wanted(
        families(given.get("font-family", "")), weight_of(given.get("font-weight", "400")), slanted
    )
    return _Style(wanted, size, spacing("letter-spacing"), spacing("word-spacing"), _is_rtl(span.inherited))


def _fitted(clusters: list[_Cluster], text: Text, start: int, end: int) -> list[_Cluster]:
    """Return clusters that fill the ``textLength`` of elements within a chunk."""
    for span, until in zip(reversed(text.spans), reversed(text.ends), strict=True):
        length = span.lengths.x(span.node.get("textLength") or "")
        inside = [k for k, c in enumerate(clusters) if span.start <= c.start < until]
        natural = sum(clusters[k].advance for k in inside)
        if (
            not length
            or length < 0.0
            or natural <= 0.0
            or not start <= span.start < min(until, len(text.characters)) <= end
        ):
            continue
        if (span.node.get("lengthAdjust") or "").strip() == "spacingAndGlyphs":
            share = length / natural
            for k in inside:
                c = clusters[k]
                clusters[k] = c._replace(advance=share * c.advance, stretch=share * c.stretch)
        else:
            for k in inside[:-1]:
                gap = (length - natural) / (len(inside) - 1)
                clusters[k] = clusters[k]._replace(advance=clusters[k].advance + gap)
    return clusters


def _is_rtl(inherited: Inherited) -> bool:
    return inherited.text.get("direction", "ltr").strip().lower() == "rtl"


def _baseline(span: Span, run: _Run) -> float:
    """Return how far below its line a letter stands."""
    import uharfbuzz as hb

    size, face = run.style.size, run.face
    extents = face.font.get_font_extents("ltr")
    ascent, descent = (size / face.unit * value for value in (extents.ascender, -extents.descender))
    given = span.inherited.text
    name = given.get("dominant-baseline", "auto").strip().lower()
    name = given.get("alignment-baseline", name).strip().lower()
    if name == "middle":
        metric = face.font.get_metric_position_with_fallback(hb.OTMetricsTag.X_HEIGHT)
        below = size / face.unit * metric / 2
    elif name == "central":
        below = (ascent - descent) / 2
    elif name in ("hanging", "text-before-edge", "before-edge", "text-top"):
        below = ascent * (0.8 if name == "hanging" else 1.0)
    else:
        below = -descent if name in ("text-after-edge", "after-edge", "text-bottom", "ideographic") else 0.0
    shift = given.get("baseline-shift", "baseline").strip().lower()
    if shift in ("sub", "super"):
        return below + (ascent + descent) / 2 * (1 if shift == "sub" else -1)
    return below - (Lengths(size, size, size).y(shift) or 0.0)


class _Rail(NamedTuple):
    """A path measured, which carries letters."""

    points: np.ndarray[Any, np.dtype[np.complex128]]
    lengths: list[float]

    @classmethod
    def of(cls, span: Span) -> _Rail | None:
        """Measure the path of a span, None if it has no length."""
        share = np.linspace(0.0, 1.0, STEPS + 1)[:, None]
        weights = (1 - share) ** 3, 3 * share * (1 - share) ** 2, 3 * share**2 * (1 - share), share**3
        pieces = [
            sum(weight * segment[k] for k, weight in enumerate(weights)).ravel()
            for contour in span.path or ()
            for segment in contour.segments
        ]
        if not pieces:
            return None
        points = np.concatenate(pieces)
        # Subpaths follow each other without the way between them.
        steps = np.abs(np.diff(points))
        steps[STEPS :: STEPS + 1] = 0.0
        lengths = [0.0, *accumulate(steps.tolist())]
        return cls(points, lengths) if lengths[-1] > 0 else None

    def place(self, place: complex, advance: float, span: Span) -> tuple[complex, complex] | None:
        """Return where the origin of a letter is, and the direction there; None beyond the ends."""
        whole = self.lengths[-1]
        start = Lengths(whole, whole, span.inherited.font_size).x(span.node.get("startOffset") or "0") or 0.0
        middle = start + place.real + advance / 2
        if not 0 <= middle <= whole:
            return None
        k = min(max(bisect_left(self.lengths, middle), 1), len(self.lengths) - 1)
        p, q = complex(self.points[k - 1]), complex(self.points[k])
        step = self.lengths[k] - self.lengths[k - 1]
        if step <= 0:
            return None
        along = (q - p) / abs(q - p)
        on_path = p + (q - p) * (middle - self.lengths[k - 1]) / step
        return on_path + along * complex(-advance / 2, place.imag), along


def keeps_blanks(node: Node, inherited: Inherited, before: bool) -> bool:
    """Return whether blanks in an element are kept as they are."""
    space = inherited.text.get("white-space", "").strip().lower()
    if space:
        return space.startswith(("pre", "break-spaces")) and space != "pre-line"
    return {"preserve": True, "default": False}.get(node.get("xml:space") or "", before)
