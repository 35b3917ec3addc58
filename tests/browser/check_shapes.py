# SPDX-License-Identifier: BSD-3-Clause
"""usage: check_shapes.py FOLDER [--write]

Draws each kind of element as an SVG picture and as a page in headless Chromium. Compares the
pictures with the references in tests/browser/references. Saves sheets of all pictures in FOLDER.
Lists the kinds of elements whose pictures differ, and marks them in the sheets. With --write,
replaces the references. Look at the new sheets before you commit them.

A sheet has COLUMNS pictures in a row, in the order of scenes.py, in 16 shades of grey.
"""

import base64
import os
import re
import struct
import sys
import warnings
import zlib

import numpy as np

import scenes
from baum.definitions import KINDS
from check_motion import key, wait
from chromium import Chromium

REFERENCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "references")
WIDTH, HEIGHT, COLUMNS = 320, 240, 6  # [px] size of a picture, and number of pictures in a row
SCALE = 2  # pictures are drawn larger by this factor
# [shades] largest allowed difference, as a mean over 3 x 3 pixels. Two runs of the same Chromium
# do not differ.
TOLERANCE = 0.6
SCENES = {"plane": scenes.PLANE, "space": scenes.SPACE}
PAGES = ("plane", "space")  # the pages for which there are references

# Returns the shades of an image or a canvas, as one hexadecimal digit for each pixel.
SHADES = """(source => {
  const canvas = document.createElement('canvas'), pen = canvas.getContext('2d');
  [canvas.width, canvas.height] = [%d, %d];
  pen.fillStyle = '#ffffff';
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.imageSmoothingQuality = 'high';
  const w = source.naturalWidth || source.width, h = source.naturalHeight || source.height;
  const scale = Math.min(canvas.width / w, canvas.height / h);
  pen.drawImage(source, (canvas.width - scale * w) / 2, (canvas.height - scale * h) / 2, scale * w, scale * h);
  const {data} = pen.getImageData(0, 0, canvas.width, canvas.height);
  let text = '';
  for (let k = 0; k < data.length; k += 4)
    text += Math.round((0.3 * data[k] + 0.59 * data[k + 1] + 0.11 * data[k + 2]) / 17).toString(16);
  return text; })""" % (WIDTH, HEIGHT)


def shades(text):
    return np.array([int(digit, 16) for digit in text], np.uint8).reshape(HEIGHT, WIDTH)


# ---- sheets: PNG files with 4 bits per pixel ----


def write_png(path, image):
    """Write rows of shades from 0 to 15. The width must be even."""
    rows = (image[:, ::2] << 4 | image[:, 1::2]).astype(np.uint8)
    lines = b"".join(b"\0" + row.tobytes() for row in rows)
    head = struct.pack(">IIBBBBB", image.shape[1], image.shape[0], 4, 0, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, body in ((b"IHDR", head), (b"IDAT", zlib.compress(lines, 9)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))


def read_png(path):
    """Read a file that write_png() has written."""
    with open(path, "rb") as file:
        data = file.read()
    width, height = struct.unpack(">II", data[16:24])
    at = data.index(b"IDAT")
    lines = zlib.decompress(data[at + 4 : at + 4 + struct.unpack(">I", data[at - 4 : at])[0]])
    rows = np.frombuffer(lines, np.uint8).reshape(height, 1 + width // 2)[:, 1:]
    return np.stack((rows >> 4, rows & 15), axis=2).reshape(height, width)


def join(pictures):
    pictures = list(pictures)
    rows = -(-len(pictures) // COLUMNS)
    sheet = np.full((rows * HEIGHT, COLUMNS * WIDTH), 15, np.uint8)
    for k, picture in enumerate(pictures):
        sheet[place(k)] = picture
    return sheet


def place(k):
    top, left = k // COLUMNS * HEIGHT, k % COLUMNS * WIDTH
    return slice(top, top + HEIGHT), slice(left, left + WIDTH)


def difference(a, b):
    """Return the largest difference of two pictures [shades], after both have been blurred."""
    d = np.pad(a.astype(float) - b, 1)
    d = d[:-2] + d[1:-1] + d[2:]
    return np.abs(d[:, :-2] + d[:, 1:-1] + d[:, 2:]).max() / 9


# ---- drawing ----


def read_images(browser, folder, images):
    """Return the shades of pictures. Each picture is given as the content of a data URL."""
    page = os.path.join(folder, "images.html")
    with open(page, "w", encoding="utf-8") as file:
        file.writelines(f'<img src="data:image/{image}">' for image in images)
    browser.open(page)
    return [shades(text) for text in browser.run(f"Array.from(document.images, {SHADES})")]


def enlarge(size):
    """Scale a picture so that its lines are as wide as in a page."""
    width, height = map(int, size.groups())
    scale = SCALE * min(WIDTH / width, HEIGHT / height)
    return f'width="{width * scale:.0f}" height="{height * scale:.0f}"'


def svg_image(svg):
    svg = re.sub(r'width="(\d+)" height="(\d+)"', enlarge, svg, count=1)
    return "svg+xml;base64," + base64.b64encode(svg.encode()).decode()


# A gap is a line that a page draws where a joint is violated. Returns the number of gaps that are
# open at the start, and the number after all bodies have been moved. Returns null if the page has
# no gaps.
GAPS = """(() => {
  const gaps = shapes.filter(shape => shape.style === 'gap'), frames = framesAt(at(first));
  const open = () => gaps.filter(shape => isOpen(ends(shape, frames))).length, before = open();
  frames.forEach((f, k) => { if (k) frames[k] = {...f, r: f.r.map((x, i) => x + (i + 1) * k * unit)}; });
  return gaps.length ? [before, open()] : null; })()"""


def page_image(browser, folder, name, m, wrong):
    """Return a picture of the page. Add the name to `wrong` if a gap is open at the start, or if no
    gap opens when the bodies move apart."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        run = m.freeze().simulate([0, 1e-6], "rk4", step=1e-6)
    path = os.path.join(folder, f"kind_{name}.html")
    run.page(path)
    browser.open(path + "#t=0")
    found = browser.run(GAPS)
    if found and (found[0] or not found[1]):
        print(f"wrong: {name}: {found[0]} gaps are open at the start, {found[1]} after the bodies have been moved")
        wrong.append(name)
    browser.run(f"stage.style.width = '{SCALE * WIDTH}px', stage.style.height = '{SCALE * HEIGHT}px',"
                " stage.style.border = 0, window.dispatchEvent(new Event('resize'))")
    wait(browser)
    key(browser, "0")
    wait(browser)
    left, top, width, height = browser.run(
        "(r => [r.left + scrollX, r.top + scrollY, r.width, r.height])(stage.getBoundingClientRect())")
    clip = {"x": left, "y": top, "width": width, "height": height, "scale": 1}
    shot = browser.call("Page.captureScreenshot", clip=clip, captureBeyondViewport=True)
    return "png;base64," + shot["data"]


def draw_all(browser, folder, wrong):
    """Return the SVG texts and the pictures of all sheets, as two dictionaries of dictionaries. The
    names of scenes are the inner keys."""
    svgs, images = {}, {}
    for group, kinds in SCENES.items():
        mechanisms = {name: scenes.build(kinds, name) for name in kinds}
        svgs[group] = {name: str(m.draw()) for name, m in mechanisms.items()}
        images[f"{group}_svg"] = {name: svg_image(svg) for name, svg in svgs[group].items()}
        pages = {name: page_image(browser, folder, name, m, wrong) for name, m in mechanisms.items()}
        if group in PAGES:
            images[f"{group}_page"] = pages
    return svgs, {title: dict(zip(each, read_images(browser, folder, each.values())))
                  for title, each in images.items()}


# ---- checks ----


def check_sheet(title, pictures, folder):
    """Compare the pictures with the references. Return the names of scenes that differ."""
    path = os.path.join(REFERENCES, f"{title}.png")
    names, sheet = list(pictures), join(pictures.values())
    known = read_png(path) if os.path.exists(path) else sheet[:0]
    if known.shape != sheet.shape:
        print(f"wrong: {title}: the reference has another number of pictures")
        wrong = names
    else:
        changes = {name: difference(known[place(k)], pictures[name]) for k, name in enumerate(names)}
        wrong = [name for name, change in changes.items() if change > TOLERANCE]
        for name in wrong:
            print(f"wrong: {title}: {name} differs by {changes[name]:.1f} shades")
            sheet[place(names.index(name))][0] = 0
    write_png(os.path.join(folder, f"{title}.png"), sheet)
    return wrong


def check_kinds():
    """Check that there is a scene for each kind of element, except user coordinates, which have no
    position in a picture."""
    used = {e.kind.name for kinds in SCENES.values() for name in kinds for e in scenes.build(kinds, name)}
    missing = sorted(set(KINDS) - used - {"coordinates"})
    for name in missing:
        print(f"wrong: there is no scene for {name}")
    return missing


def check_sensitivity(browser, folder, svgs, sheets):
    """Check that every picture changes if its last shape is removed."""
    wrong = []
    for group, texts in svgs.items():
        images = [svg_image(text[: text.rindex("<g>")] + "</svg>") for text in texts.values()]
        for (name, whole), less in zip(sheets[f"{group}_svg"].items(), read_images(browser, folder, images)):
            if difference(whole, less) <= TOLERANCE:
                print(f"wrong: {group}: the picture of {name} is the same without its last shape")
                wrong.append(name)
    return wrong


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    with Chromium() as browser:
        browser.size(1280, 900)
        wrong = check_kinds()
        svgs, sheets = draw_all(browser, folder, wrong)
        if "--write" in sys.argv:
            os.makedirs(REFERENCES, exist_ok=True)
            for title, pictures in sheets.items():
                write_png(os.path.join(REFERENCES, f"{title}.png"), join(pictures.values()))
        wrong += check_sensitivity(browser, folder, svgs, sheets)
    for title, pictures in sheets.items():
        wrong += check_sheet(title, pictures, folder)
    print(f"sheets are in {folder}; {len(wrong)} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
