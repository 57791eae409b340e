"""Documents as Inkscape has them."""

LEG = "M2 12h4v10h-4z"

NAMESPACES = (
    'xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
    'xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"'
)


def walker(leg=LEG):
    """A figure in two layers, 24 mm wide."""
    return (
        f'<svg {NAMESPACES} viewBox="0 0 24 24" width="24mm" height="24mm" id="svg5">'
        '<g inkscape:groupmode="layer" inkscape:label="Legs" id="layer1" transform="translate(1 0)"><g id="g7">'
        f'<path id="leg-l" inkscape:label="left leg" d="{leg}"/><path id="leg-r" d="M12 12h4v10h-4z"/></g></g>'
        '<g inkscape:groupmode="layer" inkscape:label="Head" id="layer2">'
        '<circle id="head" cx="12" cy="6" r="4" fill="#f00"/></g></svg>'
    )


DOCUMENT = f"""<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<!-- Created with Inkscape -->
<svg {NAMESPACES} width="100mm" height="50mm" viewBox="0 0 100 50" id="svg5">
<sodipodi:namedview id="namedview7" inkscape:document-units="mm"/>
<g inkscape:groupmode="layer" inkscape:label="Layer 1" id="layer1" transform="translate(2,3)">
<path id="low" style="fill:#aa0000" d="M 5,10 H 25 V 30 H 5 Z"/>
<g id="high" inkscape:label="the high one"
  ><path id="hp" style="fill:#0000aa" d="m 80,5 10,10 -10,10 -10,-10 z"/></g>
</g><g inkscape:groupmode="layer" inkscape:label="Pins" id="layer2">
<circle id="dot-a" inkscape:label="pin 1" cx="7" cy="13" r="0.5"/>
<circle id="dot-b" inkscape:label="pin 1" cx="82" cy="28" r="0.5"/>
</g></svg>
"""
"""Two objects, and dots that mark the upper left corner of one and the lower one of the other."""
