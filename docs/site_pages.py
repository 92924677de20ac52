"""A hook of mkdocs: the pages of the site are those of the index, docs/README.md, in its order and under its headings."""

import re
from pathlib import Path

_HEADING = re.compile(r"^## (.+)$")
_ROW = re.compile(r"^\| \[(.+?)\]\((.+?\.md)\) \|")


def nav(index: str) -> list[dict]:
    """The navigation of mkdocs for an index: the tutorial, then a menu for each heading with the pages of its table."""
    menus: list[dict] = [{"Start": "README.md"}, {"Tutorial": "tutorial.md"}]
    for line in index.splitlines():
        if heading := _HEADING.match(line):
            menus.append({heading[1]: []})
        elif row := _ROW.match(line):
            next(iter(menus[-1].values())).append({row[1]: row[2]})
    return menus


def on_config(config):
    """Called by mkdocs once it has read mkdocs.yml."""
    config.nav = nav((Path(config.docs_dir) / "README.md").read_text("utf-8"))
    return config


_FIELD = "this.field('title');"


def on_post_build(config):
    """Makes a word of a heading count ten times one of a text, in the search of mkdocs, which has no option for it."""
    worker = Path(config.site_dir, "search", "worker.js")
    text = worker.read_text("utf-8")
    if _FIELD not in text:
        raise ValueError(f"{worker} has no {_FIELD}: this version of mkdocs searches otherwise")
    worker.write_text(text.replace(_FIELD, "this.field('title', {boost: 10});"), "utf-8")
