"""The sheets of drawings in the documents."""

from PIL import ImageChops

from tools.contact_sheet import sheet

SQUARE = '<path stroke-width="2" d="M0 0H12V24H0Z"/></svg>'
PLAIN = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24">{SQUARE}'
SIZED = f'<svg xmlns="http://www.w3.org/2000/svg" width="5mm" height="7" viewBox="0 0 24 24">{SQUARE}'


def test_drawings_fill_their_cells_whatever_size_their_files_have():
    plain, sized = sheet([PLAIN], 1, 60), sheet([SIZED], 1, 60)
    assert ImageChops.difference(plain, sized).getbbox() is None
    assert plain.getpixel((20, 50)) == (0, 0, 0)
