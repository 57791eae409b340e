"""Pictures of pixels for drawings, and elements that show them."""

import base64
import io

import numpy as np
from PIL import Image, ImageDraw

MEDIA = {"PNG": "image/png", "JPEG": "image/jpeg", "WEBP": "image/webp", "GIF": "image/gif"}


def encoded(image, form="PNG", **options):
    """The bytes of a picture."""
    file = io.BytesIO()
    image.save(file, form, **options)
    return file.getvalue()


def uri(data, form="PNG"):
    """A link that holds the bytes of a picture."""
    return f"data:{MEDIA[form]};base64,{base64.b64encode(data).decode()}"


def checkerboard(cells=6, side=20, colours=((20, 60, 160), (250, 230, 190))):
    """A checkerboard whose upper left corner has the first colour."""
    k = np.indices((cells * side, cells * side)) // side
    return Image.fromarray(np.array(colours, np.uint8)[(k[0] + k[1]) % 2])


def face(width=160, height=120):
    """A picture that shows which way is up, and right."""
    image = Image.new("RGB", (width, height), (120, 190, 230))
    draw = ImageDraw.Draw(image)
    draw.ellipse((0.2 * width, 0.1 * height, 0.8 * width, 0.95 * height), fill=(230, 160, 110))
    for x in (0.35, 0.57):
        draw.ellipse((x * width, 0.35 * height, (x + 0.08) * width, 0.47 * height), fill="black")
    draw.arc((0.35 * width, 0.45 * height, 0.65 * width, 0.8 * height), 20, 90, fill="red", width=5)
    return image


def disc(side=64, colour=(200, 30, 60, 255)):
    """A disc with nothing around it."""
    image = Image.new("RGBA", (side, side))
    ImageDraw.Draw(image).ellipse((0, 0, side - 1, side - 1), fill=colour)
    return image


def image(picture, attributes, form="PNG", **options):
    """An element that shows a picture."""
    return f'<image {attributes} href="{uri(encoded(picture, form, **options), form)}"/>'
