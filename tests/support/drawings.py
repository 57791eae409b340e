"""Small drawings of several contours, as SVG."""

RING = "M12 2A10 10 0 1 0 12 22A10 10 0 1 0 12 2Z M12 6A6 6 0 1 0 12 18A6 6 0 1 0 12 6Z"
B = (
    "M5 2H13C17 2 19 4 19 7C19 9 18 11 16 11.5C18 12 20 14 20 17C20 20 17 22 14 22H5Z"
    "M8 5H13C15 5 16 6 16 7.5C16 9 15 10 13 10H8Z M8 13H14C16 13 17 14 17 16C17 18 16 19 14 19H8Z"
)
EIGHT = (
    "M12 2C16 2 18 4 18 7C18 9 17 10.5 15.5 11.5C18 13 19 14.5 19 17C19 20 16 22 12 22C8 22 5 20 5 17"
    "C5 14.5 6 13 8.5 11.5C7 10.5 6 9 6 7C6 4 8 2 12 2Z"
    "M12 5C10 5 9 6 9 7.5C9 9 10 10 12 10C14 10 15 9 15 7.5C15 6 14 5 12 5Z"
    "M12 13C9.5 13 8 14.5 8 16.5C8 18.5 9.5 19.5 12 19.5C14.5 19.5 16 18.5 16 16.5C16 14.5 14.5 13 12 13Z"
)
I_DOT = "M10 9H14V22H10Z M10 3H14V6H10Z"
J_DOT = "M10 9H14V18C14 21 12 23 8 23V20C9.5 20 10 19 10 18Z M12 3A2 2 0 1 0 12 7A2 2 0 1 0 12 3Z"
EYED = "M2 12C6 4 18 4 22 12C18 20 6 20 2 12Z M15 9A2 2 0 1 0 15 13A2 2 0 1 0 15 9Z"
LEAF = "M3 14C4 4 20 3 21 9C22 16 12 22 3 14Z"
SQUARES = "M2 2H10V10H2Z M14 2H22V10H14Z M2 14H10V22H2Z M14 14H22V22H14Z"
BAR = "M2 6H22V18H2Z"

EVENODD = 'fill-rule="evenodd"'


def svg(*paths, attributes="", viewbox="0 0 24 24"):
    """An SVG document of paths: path data, or whole elements."""
    body = "".join(p if p.startswith("<") else f'<path d="{p}" {attributes}/>' for p in paths)
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{viewbox}">{body}</svg>'


def drawing(*paths, file="a.svg", **options):
    """What such a document paints."""
    from shapeblend_cli.svg.reading.read import read

    return read(file, svg(*paths, **options).encode())


def filled(path):
    """What a document of one path by the even-odd rule paints."""
    return drawing(path, attributes=EVENODD)


def contours_of(*paths, vertices=200, **options):
    """The contours of such a document, flattened and with their roles."""
    from shapeblend_cli.anatomy.decompose import decompose
    from shapeblend_cli.geometry.similarity import Similarity

    return decompose(drawing(*paths, **options), Similarity(), vertices)[0]
