# SPDX-License-Identifier: BSD-3-Clause
"""Shows a block of Python and a block of C as two tabs if one block directly follows the other. site.css hides the
tab that is not chosen, and tabs.js stores the chosen language."""

from docutils import nodes

TITLES = {"python": "Python", "py": "Python", "c": "C"}


def are_pair(one, two):
    titles = {TITLES.get(block.get("language")) for block in (one, two)}
    return titles == {"Python", "C"} and one.parent is two.parent and one.parent.index(two) == one.parent.index(one) + 1


def make_tabs(app, doctree, docname):
    blocks = list(doctree.findall(nodes.literal_block))
    for k, pair in enumerate(zip(blocks, blocks[1:])):
        if not are_pair(*pair):
            continue
        tabs = nodes.container(classes=["tabs"])
        pair[1].parent.remove(pair[1])
        pair[0].replace_self(tabs)
        for part, block in enumerate(pair):
            id = f"tab-{k}-{part}"
            button = f'<input type="radio" name="tab-{k}" id="{id}"{"" if part else " checked"}>'
            button += f'<label for="{id}">{TITLES[block["language"]]}</label>'
            tabs += nodes.raw("", button, format="html")
        tabs += [nodes.container("", block, classes=["tab"]) for block in pair]


def setup(app):
    app.connect("doctree-resolved", make_tabs)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
