"""Places that a document names, found on the structure that is drawn."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.page.numbers import probable
from mouse_cli.page.scene import Scene
from mouse_cli.page.sections._words import place
from mouse_cli.report.reading import Part

_FAINT = 0.02  # probability from which on a rival place is marked
_MOST = 12  # marks of a drawing


@dataclass(frozen=True)
class Mark:
    """A place to be marked: words for a list, name in the drawing; probability; strong: it is the answer; point (3,).

    nodes: of the elements that it takes up.
    """

    words: str
    name: str
    probability: float | None
    strong: bool
    point: np.ndarray
    nodes: frozenset[int] = frozenset()


@dataclass(frozen=True)
class Named:
    """A site of the document, with the title of what acts there."""

    site: Part
    title: str
    probability: float | None
    strong: bool

    @property
    def words(self) -> str:
        """Place and cause in one line."""
        p = "" if self.probability is None else f", probability {probable(self.probability)}"
        return f"{place(self.site)} ({self.title}{p})" if self.title else place(self.site)


def named(document: Part) -> list[Named]:
    """Sites that are the answer first, then rivals that hold a share of the probability, the likeliest first."""
    verdict, found = document.part("verdict"), []
    causes, titles = document.parts("candidates"), {}
    for one in [*causes, *(o for turn in document.parts("turns") for o in turn.parts("candidates"))]:
        titles.setdefault(one.text("physics"), one.text("title"))
    title = titles.get(verdict.text("physics"), verdict.text("physics"))
    lead = _leading(causes, verdict)
    found += [Named(site, title, _here(lead), True) for site in verdict.parts("sites")]
    for cause in verdict.parts("causes"):
        physics = cause.text("physics")
        found.append(Named(cause.part("site"), titles.get(physics, physics), cause.number("probability"), True))
    found += [Named(law.part("site"), law.text("title"), None, True) for law in document.parts("laws")]
    return found + (_rivals(document, verdict) if verdict.text("kind") in ("named", "one-of", "unknown") else [])


def _leading(causes: list[Part], verdict: Part) -> Part:
    return next((o for o in causes if o.text("physics") == verdict.text("physics")), Part({}, verdict.file))


def _share(one: Part) -> float:
    """Of the leading place of a candidate, in its probability."""
    return max(0.0, 1.0 - sum(other.number("share") or 0.0 for other in one.parts("elsewhere")))


def _here(one: Part) -> float | None:
    p = one.number("probability")
    return None if p is None else p * _share(one)


def _rivals(document: Part, verdict: Part) -> list[Named]:
    """Other places of candidates; where no candidate explains the data, places by the shapes alone."""
    if verdict.text("kind") == "unknown":
        location = document.part("location")
        places = location.parts("places") if location.flag("single") else []
        return [
            Named(p.part("site"), p.text("channel"), p.number("probability"), False)
            for p in places
            if (p.number("probability") or 0.0) >= _FAINT
        ]
    found, lead = [], _leading(document.parts("candidates"), verdict)
    for one in document.parts("candidates"):
        p, title = one.number("probability") or 0.0, one.text("title")
        pairs = [] if one.values == lead.values else [(one.parts("sites"), _share(one))]
        pairs += [(other.parts("sites"), other.number("share") or 0.0) for other in one.parts("elsewhere")]
        found += [
            Named(site, title, p * share, False) for sites, share in pairs for site in sites if p * share >= _FAINT
        ]
    return sorted(found, key=lambda one: -(one.probability or 0.0))


def marks(document: Part, scene: Scene) -> list[Mark]:
    """The sites that have a place on the structure, at most _MOST; several are named by numbers."""
    found = [(one, places) for one in named(document) if (places := _places(one.site, scene))][:_MOST]
    alone = sum(one.strong for one, _ in found) == 1
    made = []
    for number, (one, places) in enumerate(found, 1):
        name = one.title or place(one.site) if alone else str(number)
        for point, nodes in places[:_MOST]:
            made.append(Mark(one.words, name if one.strong else "", one.probability, one.strong, point, nodes))
    return made


def _places(site: Part, scene: Scene) -> list[tuple[np.ndarray, frozenset[int]]]:
    """Point and nodes of each piece of a site; none for the whole structure."""
    kind, ids = site.text("kind"), site.labels("ids")
    position = [x for x in site.numbers("position") if x is not None]
    nodes = [scene.elements[i] for i in ids if i in scene.elements] if kind == "element" else []
    if len(position) == 3:
        return [(np.array(position, float), frozenset())]
    if nodes and all(len(each) == 1 for each in nodes):
        return [(scene.positions[each[0]], frozenset()) for each in nodes]
    if nodes:
        middle = nodes[len(nodes) // 2]
        return [(scene.positions[middle].mean(axis=0), frozenset(i for each in nodes for i in each))]
    if kind in ("node", "dof", "sensor"):
        at = [scene.node(i) for i in ids]
        points = [scene.positions[i] for i in at if i is not None]
        return (
            [(np.mean(points, axis=0), frozenset())] if kind == "dof" and points else [(p, frozenset()) for p in points]
        )
    return []
