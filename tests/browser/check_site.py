# SPDX-License-Identifier: BSD-3-Clause
"""usage: check_site.py SITE [SCREENSHOTS]

Checks the documentation site in the folder SITE. All links between its pages must have targets, and the search must work
from the file system. No page may be wider than a phone, need a network, or cause errors in the browser. Writes screenshots
of each kind of page into the folder SCREENSHOTS."""

import sys
import time
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from chromium import Chromium

PHONE, DESKTOP = (420, 800), (1280, 900)
SHOWN = (
    "index README docs/tutorial docs/cookbook/index docs/cookbook/cam docs/cookbook/warnings gallery/index"
    " gallery/known_bricard gallery/jansen_leg reference/c/planar reference/python/Mechanism modelling/index"
)


class Links(HTMLParser):
    """The links and the anchors of a page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = set(), set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif name in ("href", "src") and value:
                self.links.add(value)


def find_dead_links(site):
    pages = {path.resolve(): Links(path) for path in site.glob("**/*.html")}
    count, dead = 0, []
    for path, page in pages.items():
        for link in sorted(page.links):
            parts = urlsplit(link)
            if parts.scheme or parts.netloc or not (parts.path or parts.fragment):
                continue
            count += 1
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            known = pages.get(target)
            if not target.exists() or (
                parts.fragment and known and unquote(parts.fragment) not in known.anchors
            ):
                dead.append(f"{path}: {link}")
    print(f"{len(pages)} pages, {count} links between them, {len(dead)} of them dead")
    return dead


def find_errors(browser, path, size, scheme):
    """Open a page. Return a list of its errors."""
    browser.size(*size, phone=size is PHONE, scheme=scheme)
    browser.open(str(path))
    wrong = [f"console: {text}" for text in browser.complaints()]
    wrong += [
        f"network: {url}"
        for url in browser.requests()
        if not url.startswith(("file:", "data:", "blob:", "about:"))
    ]
    width = browser.run("document.documentElement.scrollWidth")
    if width > size[0]:
        wrong.append(f"{width} pixels wide instead of {size[0]}")
    return [f"{path} at {size[0]}, {scheme}: {text}" for text in wrong]


def search(browser, site):
    browser.open(f"{site}/search.html")
    browser.run("location.search = '?q=redundant+rows'")
    for _ in range(200):
        time.sleep(0.05)
        found = browser.run("document.querySelectorAll('ul.search li a').length")
        if found:
            print(f"search: {found} pages found")
            return []
    return ["the search finds no page"]


def main():
    site = Path(sys.argv[1])
    failures = find_dead_links(site)
    paths = [path for path in sorted(site.glob("**/*.html")) if path.parent.name != "motion"]
    with Chromium() as browser:
        for path in paths:
            failures += find_errors(browser, path, PHONE, "light")
            failures += find_errors(browser, path, DESKTOP, "dark")
        failures += search(browser, site)
        for name in SHOWN.split() if len(sys.argv) > 2 else ():
            for size in (PHONE, DESKTOP):
                for scheme in ("light", "dark"):
                    find_errors(browser, site / f"{name}.html", size, scheme)
                    time.sleep(1.5)  # until the frames of motions are loaded
                    target = Path(sys.argv[2]) / f"{name.replace('/', '-')}-{size[0]}-{scheme}.png"
                    target.parent.mkdir(parents=True, exist_ok=True)
                    browser.screenshot(target, whole=False)
    print(*failures, f"{2 * len(paths)} views, {len(failures)} failures", sep="\n")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
