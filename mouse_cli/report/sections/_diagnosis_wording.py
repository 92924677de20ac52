"""Words that the sections of a diagnosis share."""

from collections.abc import Sequence

from mouse_cli.model.diagnosis import NAMED, ONE_OF, Cause, Diagnosis, Explanation, Score, Site, Size, foremost, members
from mouse_cli.model.groups import TITLES, counted, enumerated
from mouse_cli.model.shared_place import SharedPlace
from mouse_cli.model.units import Units
from mouse_cli.report.blocks import Cell, heads

_ALL = 0.9  # upper end of a share from which on its end is all of what there is
LEAST = 0.01  # probability within a group below which a member is not printed


def probable(p: float) -> str:
    """A probability as people read it.

    >>> probable(0.98), probable(0.0042), probable(0.99999), probable(1e-9), probable(float("nan"))
    ('0.98', '0.004', '> 0.999', '< 0.001', '')
    """
    if p != p:
        return ""
    return "> 0.999" if p > 0.999 else "< 0.001" if p < 0.001 else f"{p:.2f}" if 0.01 <= p < 0.995 else f"{p:.3f}"


def with_p(p: float) -> str:
    """The same with its noun.

    >>> with_p(0.98), with_p(0.99999)
    ('probability 0.98', 'probability > 0.999')
    """
    return f"probability {probable(p)}"


def p_value(p: float) -> str:
    """A p-value with its letter.

    >>> p_value(0.331), p_value(0.00042), p_value(1e-9), p_value(0.9999)
    ('p = 0.33', 'p = 0.0004', 'p < 1e-6', 'p > 0.999')
    """
    if p > 0.999 or p < 1e-6:
        return "p > 0.999" if p > 0.999 else "p < 1e-6"
    return f"p = {p:.2f}" if p >= 0.1 else f"p = {p:.2g}" if p >= 0.01 else f"p = {p:.1g}"


def nats(value: float) -> str:
    """A difference of logarithms, as finely as it means something.

    >>> nats(2649.17), nats(-0.0221), nats(95.2), nats(float("nan"))
    ('2649', '0.0', '95.2', '')
    """
    return (
        "" if value != value else f"{value:.0f}" if abs(value) >= 100 else f"{value + 0.0:.1f}".replace("-0.0", "0.0")
    )


def separation(value: float) -> str:
    """A predicted separation; what is far above the bar is not worth its digits.

    >>> separation(5.21), separation(1258.2), separation(0.0003)
    ('5.2', 'over 100', '0.0003')
    """
    return "over 100" if value > 100 else f"{value:.1f}" if value >= 0.95 else f"{value:.1g}"


def per_cent(value: float) -> str:
    """A difference in per cent to two digits that count.

    >>> per_cent(-11.6713), per_cent(0.0166), per_cent(float("nan"))
    ('-11.67', '0.017', '')
    """
    return "" if value != value else f"{value:.2f}" if abs(value) >= 0.1 else f"{value:.2g}"


def mac_text(mac: float) -> str:
    """A MAC; blank where no shape was measured.

    >>> mac_text(0.98931), mac_text(0.99996), mac_text(float("nan"))
    ('0.9893', '1.0000', '')
    """
    return "" if mac != mac else f"{mac:.4f}"


SCORES = heads("<model | rms frequency error [per cent] | log predictive density | within 90 % intervals [per cent]")


def scored(name: str, score: Score) -> tuple[Cell, ...]:
    """A row of SCORES: how well a model predicted what no fit has seen."""
    covered = "" if score.covered != score.covered else f"{100 * score.covered:.0f}"
    return name, per_cent(100 * score.rms_frequency_error), f"{score.log_predictive_density:.1f}", covered


def place(site: Site) -> str:
    """A site in words.

    >>> place(Site("node", (3,), (1.0, 0.0, 0.0))), place(Site("dof", ("12TY",), text="degree of freedom 12TY"))
    ('node 3', 'degree of freedom 12TY')
    """
    return site.text or f"{site.kind} {', '.join(map(str, site.ids))}".strip()


def _several(texts: Sequence[str]) -> str:
    """Sites, in whose words there may be commas."""
    return "; ".join(texts) if len(texts) > 2 else " and ".join(texts)


def where(one: Explanation) -> str:
    """The sites of an explanation."""
    return _several([place(cause.site) for cause in one.causes])


def lacking(one: Explanation) -> str:
    """What and where: each mechanism of an explanation with its site.

    >>> of = lambda key, at: Cause(key, key, f"a {key}", Site("node", (at,)), ())
    >>> lacking(Explanation((of("mass", 3),), 1, 1, 1, 0, None))
    'a mass: node 3'
    >>> lacking(Explanation((of("mass", 3), of("crack", 5), of("gap", 7)), 1, 1, 1, 0, None))
    'a crack (node 5), a gap (node 7) and a mass (node 3)'
    """
    if len(one.causes) == 1:
        return f"{one.title}: {where(one)}"
    return enumerated([f"{cause.title} ({place(cause.site)})" for cause in one.causes])


def grouped(explanations: Sequence[Explanation], one: Explanation) -> str:
    """What the group of `one` is called: as `one` where it has no other member that counts."""
    return _in_groups(one) if within(explanations, one) else one.title


def called(found: Diagnosis) -> str:
    """The same of what is named."""
    return _in_groups(found.best) if inside(found) else found.best.title


def _in_groups(one: Explanation) -> str:
    titles = [TITLES.get(cause.group, cause.title) for cause in one.causes]
    return counted([t for i, t in enumerate(titles) if one.causes[i].group != "support" or t not in titles[:i]])


def companions(found: Diagnosis) -> str:
    """Groups of what may act beside what is certain, and the probability of each."""
    each = ((of_groups(found, groups), p) for groups, p in found.certain.companions if p >= LEAST)
    return ", ".join(f"{words} {probable(p)}" for words, p in each)


def of_groups(found: Diagnosis, groups: str) -> str:
    """Groups, joined as `Explanation.group` joins them, in words."""
    title = {cause.group: cause.title for one in reversed(found.explanations) for cause in one.causes} | {"none": "nothing"}
    of = lambda group: TITLES.get(group, title.get(group, group))
    return counted([of(each) for each in groups.split(" + ")])


def within(explanations: Sequence[Explanation], one: Explanation) -> str:
    """Members of the group of `one` and the probability of each within it; empty where one holds it all.

    >>> of = lambda key, title, p: Explanation((Cause(key, "local-stiffness", title, Site("node"), ()),), 1, 1, 1, 0, None, p)
    >>> both = of("crack", "an open crack", 0.6), of("stiffness-loss", "a softer part", 0.3)
    >>> grouped(both, both[0]), within(both, both[0]), within(both[:1], both[0])
    ('a local loss of stiffness', 'an open crack 0.67, a softer part 0.33', '')

    A member that is called as its group is called so too, whatever its key:

    >>> near = of("ground-spring", "a spring to the ground", 0.5), of("brace", "a spring between two points", 0.5)
    >>> within(near, near[0])
    'a spring to the ground 0.50, a spring between two points 0.50'

    Of the signs of one law that is called which is the most probable:

    >>> within([of("spring", "a spring (added)", 0.6), both[0], of("spring", "a spring (lost)", 0.0)], both[0])
    'a spring (added) 0.50, an open crack 0.50'
    """
    return _members(explanations, members(explanations, one.group))


def inside(found: Diagnosis) -> str:
    """The same of what is named."""
    if found.certain is None:
        return within(found.explanations, found.best)
    return _members(found.explanations, found.certain.members)


def _members(explanations: Sequence[Explanation], listed: Sequence[tuple[str, float]]) -> str:
    found = [(physics, p) for physics, p in listed if p >= LEAST]
    title = {cause.physics: cause.title for each in reversed(explanations) for cause in each.causes}
    words = lambda physics: counted([title[key] for key in physics.split(" + ")])
    return ", ".join(f"{words(physics)} {probable(p)}" for physics, p in found) if len(found) > 1 else ""


def whereabouts(one: Explanation, units: Units, elsewhere: tuple[tuple[tuple[Site, ...], float], ...] = ()) -> str:
    """The sites with coordinates, and rival sites with the probability of each among the sites of the explanation.

    >>> mass = Cause("mass", "mass", "a mass", Site("node", (3,), (1.0, 0.5, 0.0)), ())
    >>> whereabouts(Explanation((mass,), 1, 1, 1, 0, None), Units("mm", "t", "N"), (((Site("node", (7,)),), 0.12),))
    'node 3 at (1, 0.5, 0) mm; or at node 7 (probability of this site 0.12)'
    """
    first = _several([f"{place(cause.site)}{_at(cause.site, units)}" for cause in one.causes])
    return first + rivals_of_site(elsewhere)


def rivals_of_site(elsewhere: tuple[tuple[tuple[Site, ...], float], ...]) -> str:
    """Rival sites with the probability of each; empty without any.

    >>> rivals_of_site((((Site("node", (1, 8), text="between nodes 1 and 8"),), 0.4),))
    '; or between nodes 1 and 8 (probability of this site 0.40)'
    """
    what = lambda sites: "this site" if len(sites) == 1 else "these sites"
    at = lambda text: text if text.startswith("between") else f"at {text}"
    rivals = [f"; or {at(_several([*map(place, s)]))} (probability of {what(s)} {probable(p)})" for s, p in elsewhere]
    return "".join(rivals)


def in_common(found: SharedPlace, units: Units) -> str:
    """What rival sites share, in words.

    >>> in_common(SharedPlace((("y", 0.0, 0.0), ("z", 8.1, 11.2))), Units("mm", "t", "N"))
    'y = 0 mm, z = 8.1 to 11.2 mm'
    """
    unit = f" {units.of('m')}" if units.declared else ""
    words = [
        f"{axis} = {low + 0.0:.4g}{'' if low == high else f' to {high + 0.0:.4g}'}{unit}"
        for axis, low, high in found.extents
    ]
    nodes = f"node{'s' if len(found.nodes) > 1 else ''} {', '.join(map(str, found.nodes))}"
    return ", ".join([*words, *([nodes] if found.nodes else [])])


def _at(site: Site, units: Units) -> str:
    if site.position is None:
        return ""
    unit = f" {units.of('m')}" if units.declared else ""
    return f" at ({', '.join(f'{x + 0.0:.4g}' for x in site.position)}){unit}"


def sized(cause: Cause) -> str:
    """Its parameters with their standard deviations, and the law by which its spring loses energy."""
    law = f"; its damping is {cause.law}" if cause.law else ""
    return (", ".join(_size(size) for size in cause.sizes) or "nothing to be sized") + law


def _size(size: Size) -> str:
    unit = "" if size.unit in ("", "1") else f" {size.unit}"
    return f"{size.name} {size.value:.4g}{unit} (sd {size.sd:.2g}{_limit(size)})"


def _limit(size: Size) -> str:
    """What it means that a size is at a limit of its range; empty: it is at none.

    >>> [_limit(Size("share lost", "1", value, 0.01, 0.02, 0.99)) for value in (0.02, 0.5, 0.99)]
    [', at the limit of its range', '', ', as good as all of it']
    """
    if size.lower * 1.001 < size.value < size.upper * 0.999:
        return ""
    whole = size.unit == "1" and _ALL < size.upper <= 1 and size.value > size.lower * 1.001
    return ", as good as all of it" if whole else ", at the limit of its range"


def log_evidence_over_none(found: Diagnosis, one: Explanation) -> float:
    """ln of the evidence for an explanation over that for no cause."""
    baseline = found.baseline
    return float("nan") if baseline is None else float(one.log_evidence - baseline.log_evidence)


def standing(found: Diagnosis) -> list[Explanation]:
    """The explanation named, or the one that stands for each group that is left, none among them."""
    if found.kind == NAMED:
        return [found.best]
    return [foremost(found.explanations, name) for name, _ in found.rivals]


def leaders(found: Diagnosis) -> list[Explanation]:
    """The same without none."""
    return [one for one in standing(found) if one.causes]


def with_cause(found: Diagnosis) -> str:
    """How the model with a cause is called at the head of a column."""
    return "extended model" if found.kind == NAMED or found.best is None else f"with {found.best.title}"


def predicting(found: Diagnosis) -> str:
    """How what predicts held-out data beside the model as it is is called: of several explanations it is all of them."""
    return "all hypotheses together" if found.kind == ONE_OF else with_cause(found)
