"""Groups of mechanisms that are hard to tell apart: how those of several are called, and which of them leads."""

from collections import Counter
from collections.abc import Sequence

_NUMBERS = {2: "two", 3: "three", 4: "four", 5: "five", 6: "six"}
TITLES = {  # of groups with more than one member; others are called as their member
    "axial": "an axial force",
    "clearance": "a clearance",
    "friction": "friction",
    "ground-spring": "a spring to the ground",
    "mass": "an added mass",
    "local-stiffness": "a local loss of stiffness",
    "sensor": "a faulty sensor",
    "shear": "shear or rotary inertia",
    "smooth-stiffness": "a smooth nonlinear stiffness",
    "support": "a flexible support",
}


def enumerated(words: Sequence[str]) -> str:
    """Words as a sentence lists them.

    >>> enumerated(["a crack"]), enumerated(["a crack", "a gap"]), enumerated(["a crack", "a gap", "a mass"])
    ('a crack', 'a crack and a gap', 'a crack, a gap and a mass')
    """
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))


def counted(titles: Sequence[str]) -> str:
    """Mechanisms as a sentence lists them, those of one title once with the number of their sites.

    >>> counted(["a crack"] * 2 + ["a mass"]), counted(["a mass"] * 3), counted([])
    ('a crack at two sites and a mass', 'a mass at three sites', '')
    """
    times = Counter(titles)
    return enumerated([each if n == 1 else f"{each} at {_NUMBERS.get(n, n)} sites" for each, n in times.items()])


def joined(groups: Sequence[str]) -> str:
    """The group of several mechanisms, sorted, `none` without any: a support that is flexible in two manners is one mechanism.

    >>> joined(["support", "mass", "support"]), joined(["mass", "mass"]), joined([])
    ('mass + support', 'mass + mass', 'none')
    """
    names = sorted(groups)
    return " + ".join(name for i, name in enumerate(names) if name != "support" or name not in names[:i]) or "none"


def leading(groups: Sequence[tuple[str, float]], members: Sequence[str]) -> int | None:
    """Which of `members`, groups of explanations in the order of their probability, leads: the first of the most probable group.

    A cause before none at all; None without members.

    >>> leading([("none", 0.6), ("mass", 0.3), ("shear", 0.1)], ["none", "shear", "mass"])
    2
    """
    order = [name for name, _ in groups if name != "none"] + ["none"]
    found = [members.index(name) for name in order if name in members]
    return found[0] if found else None


def shares(groups: Sequence[str], probabilities: Sequence[float]) -> tuple[tuple[str, float], ...]:
    """Groups of explanations with their probabilities together, the largest first.

    >>> shares(["mass", "none", "mass"], [0.5, 0.25, 0.125])
    (('mass', 0.625), ('none', 0.25))
    """
    found: dict[str, float] = {}
    for name, p in zip(groups, probabilities, strict=True):
        found[name] = found.get(name, 0.0) + float(p)
    return tuple(sorted(found.items(), key=lambda item: -item[1]))
