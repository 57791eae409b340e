"""Chromium, started as all tests need it, and pictures of what it shows."""

import io

from PIL import Image

from tests.support.equipment import CHROMIUM

# On a loaded machine the watchdog of the process that draws takes slowness for a hang, and ends it.
ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--disable-gpu-watchdog"]


def start_chromium(chromium, *arguments, **options):
    """Start the Chromium of this machine; `chromium` is Playwright's type of browser, which takes the options."""
    return chromium.launch(executable_path=CHROMIUM, args=[*ARGUMENTS, *arguments], **options)


def picture_of(place, mode="RGB", **options):
    """What a page, or a place on it, shows."""
    from playwright.sync_api import Error

    try:
        data = place.screenshot(**options)
    except Error as error:
        # The process that draws was started anew at this moment: the page is whole, only its surface was lost.
        if "Unable to capture screenshot" not in str(error):
            raise
        data = place.screenshot(**options)
    with Image.open(io.BytesIO(data)) as image:
        return image.convert(mode)
