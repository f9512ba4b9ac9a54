#!/usr/bin/env python3
"""Opens the program's HTML pages in a headless Chromium and uses them as a person does. Exit code 77 without one.

    check_page.py PROGRAM DATA_FOLDER"""

import pathlib
import subprocess
import sys
import tempfile

import browser

HOSTILE = "a'\"><img src=x onerror=console.error('markup')><\u2028script>&lt;.xml"

# Waits for the view to be drawn, then counts the colours of the canvas.
COLORS = """new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(() => {
  const view = document.getElementById('canvas'), copy = document.createElement('canvas');
  copy.width = view.width; copy.height = view.height;
  const context = copy.getContext('2d');
  context.drawImage(view, 0, 0);
  const words = new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer);
  resolve(new Set(words).size);
})))"""
NAMES = "[...document.querySelectorAll('.files > tbody > tr')].filter(r => !r.hidden).map(r => r.cells[1].dataset.value)"
TRIANGLES = "[...document.querySelectorAll('.files > tbody > tr')].map(r => Number(r.cells[3].dataset.value))"


def require(holds, message):
    if not holds:
        raise AssertionError(message)


def make_page(program, data, folder):
    """Of five files: one has a hostile name, one is broken, one has no triangles."""
    names = [HOSTILE, "broken.xml", "index.xml", "curves.swp", "bottle.swp"]
    stud = (data / "stud.xml").read_bytes()
    (folder / HOSTILE).write_bytes(stud)
    (folder / "broken.xml").write_text("<step-assembly")
    for source in [*(data / "assembly").glob("*.xml"), data / "samples/swp/curves.swp", data / "samples/swp/bottle.swp"]:
        (folder / source.name).write_bytes(source.read_bytes())
    done = subprocess.run([program, *names, "-o", "page.html", "-q"], cwd=folder, check=False)
    require(done.returncode == 1, f"the batch gave {done.returncode}, not 1")
    return folder / "page.html"


def choose(page, identity, value, attribute="value"):
    page.run(f"(e => {{ e.{attribute} = {value!r}; e.dispatchEvent(new Event('input')); }})"
             f"(document.getElementById('{identity}'))".replace("True", "true").replace("False", "false"))
    return page.run(NAMES)


def check_table(page):
    names = page.run(NAMES)
    require(len(names) == 5, f"rows: {names}")
    require(names[0].startswith("a'\"><img src=x onerror="), f"the hostile name became {names[0]}")
    require(page.run("document.querySelectorAll('img:not([src^=\"data:image/png;base64,\"])').length") == 0, "foreign markup")
    require(page.run("document.querySelectorAll('.picture img').length") == 4, "not every file has a picture")
    sizes = page.run("Promise.all([...document.images].map(async i => { i.loading = 'eager'; await i.decode(); "
                     "return [i.naturalWidth, i.naturalHeight]; }))")
    require(sizes == 4 * [[320, 240]], f"pictures of {sizes}")
    require(choose(page, "filter-text", "BOTT") == ["bottle.swp"], "the filter by name")
    require(page.run("document.getElementById('shown').textContent") == "1 of 5 files shown", "the count")
    choose(page, "filter-text", "")
    require(choose(page, "filter-outcome", "failed") == ["broken.xml"], "the filter by outcome")
    choose(page, "filter-outcome", "")
    require(choose(page, "filter-warnings", True, "checked") == [], "the filter by warnings")
    require(len(choose(page, "filter-warnings", False, "checked")) == 5, "the filters are off again")


def check_sorting(page):
    page.run("document.querySelectorAll('.files > thead button')[2].focus()")
    page.press("Enter", text="\r")
    falling = page.run(TRIANGLES)
    require(falling == sorted(falling, reverse=True) and falling[0] > 1000, f"by triangles, falling: {falling}")
    page.press("Enter", text="\r")
    require(page.run(TRIANGLES) == falling[::-1], "by triangles, rising")
    require(page.run("document.querySelectorAll('[aria-sort=ascending]').length") == 1, "the order is not told")
    page.run("document.querySelectorAll('.files > thead button')[0].click()")
    require(page.run(NAMES) == sorted(page.run(NAMES)), "by name")


def check_view(page):
    page.prefer(reduced_motion="reduce")
    for name in ("index.xml", "bottle.swp", "curves.swp"):
        page.run(f"document.querySelector('button[data-name=\"{name}\"]').focus()")
        page.press("Enter", text="\r")
        require(page.run("document.getElementById('viewer').open"), f"{name}: no view")
        colors = page.run(COLORS)
        require(colors > (20 if name != "curves.swp" else 1), f"{name}: {colors} colours, {page.run('document.getElementById(`viewer-note`).textContent')}")
        before = page.run("document.getElementById('canvas').toDataURL()")
        page.press("ArrowLeft")
        page.run(COLORS)
        require(page.run("document.getElementById('canvas').toDataURL()") != before, f"{name}: does not turn")
        page.run("document.querySelectorAll('#viewer [data-layer]').forEach(b => { if (b.checked) b.click(); })")
        require(page.run(COLORS) == 1, f"{name}: something shows without layers")
        page.run("document.querySelectorAll('#viewer [data-layer]').forEach(b => b.click())")
        page.press("Escape")
        require(not page.run("document.getElementById('viewer').open"), f"{name}: Escape does not close the view")


def check_phone(page):
    page.resize(390, 800, mobile=True)
    wide = page.run("document.documentElement.scrollWidth")
    require(wide <= 390, f"the page is {wide} pixels wide on a phone")


def main(program, data):
    if browser.program() is None:
        print("skipped: no Chromium")
        return 77
    with tempfile.TemporaryDirectory() as name, browser.Browser() as page:
        path = make_page(program, pathlib.Path(data), pathlib.Path(name))
        page.open(path)
        for check in (check_table, check_sorting, check_view, check_phone):
            check(page)
            print(check.__name__, "good")
        require(page.messages == [], f"the browser complains: {page.messages}")
        outside = [url for url in page.requests if not url.startswith(("file:", "data:"))]
        require(outside == [], f"asks for {outside}")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
