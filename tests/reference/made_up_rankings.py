"""Rankings put together by hand: fits of given groups, sites and probabilities, on a beam of 1 m without a model behind it."""

from types import SimpleNamespace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Softening
from mouse_cli.diagnosis.search.rank import Ranking
from mouse_cli.model.diagnosis import EVERYWHERE, Site

BEAM = SimpleNamespace(geometry=SimpleNamespace(coordinates=np.array([[0.0, 0, 0], [1, 0, 0]])))


BARS = SimpleNamespace(nodes=np.array([[i, i + 1] for i in range(10)]))  # ten, end to end


def made_up(*groups: str, misfit: float = 20.0, dof: int = 20, z=(0.3, -0.4), nameless: str = "", **more):
    """A fit of mechanisms of those groups, `group@x` of one at x m; parameters E and density at z prior sd of 2 and 0.1."""
    named = tuple(SimpleNamespace(name=name) for name in ("E", "density"))
    data = SimpleNamespace(by_shape=more.pop("by_shape", True))
    problem = SimpleNamespace(parameters=named, structure=BEAM)
    base = SimpleNamespace(L=np.diag([2.0, 0.1]), data=data, problem=problem, first=SimpleNamespace(bars=BARS))
    recipes = tuple(_recipe(name, more.get("own", 0)) for name in groups)
    rival = SimpleNamespace(key=nameless, even=more.pop("even", ""), gradient=more.pop("gradient", ""))
    field = SimpleNamespace(rival=rival) if nameless else None
    own = {
        "strained": False,
        "variants": (),
        "telling": False,
        "shown": True,
        "bearable": 1.5,
        "elsewhere": (),
        "c": np.zeros(len(groups)),
        "covariance": 1e-6 * np.eye(2 + len(groups)),
        "data": data,
        "groups": [recipe.group(0.0) for recipe in recipes],
        "sites": tuple(recipe.site(0.0) for recipe in recipes),
    } | more
    model = SimpleNamespace(base=base, k=2, own=[slice(i, i + 1) for i in range(len(groups))])
    point = SimpleNamespace(x=np.asarray(z, float))
    return SimpleNamespace(misfit=misfit, dof=dof, recipes=recipes, nameless=field, model=model, point=point, **own)


def _recipe(name: str, own: int):
    """A mechanism whose physics is called as its group, `group@x`, `group@x:first-last` of bars; `group/a/b` of parts a and b."""
    name, *parts = name.split("/")
    group, _, place = name.partition("@")
    x, _, bars = place.partition(":")
    site = Site("node", (), (float(x), 0.0, 0.0)) if x else EVERYWHERE
    candidate = SimpleNamespace(group=group, key=group, title=group)
    return SimpleNamespace(
        candidate=candidate,
        own=own,
        unknowns=(SimpleNamespace(name=group),),
        parts=tuple(parts),
        dofs=tuple(parts),
        values=lambda c: c,
        group=lambda c: group,
        site=lambda values: site,
        at=lambda c: _change(group, bars),
    )


def _change(group: str, bars: str) -> Change:
    """What it does: to bars first-last where they are given, else as its group does."""
    if bars:
        first, last = map(int, bars.split("-"))
        own = np.arange(first, last + 1)
        return Change(softening=Softening(own, np.zeros((len(own), 2, 2))))
    return {"mass": Change(M=np.eye(1)), "ground-spring": Change(K=np.eye(1))}.get(group, Change())


def ranked(*fits, p, odds=None, stated: float = 1.0, baseline=None) -> Ranking:
    """The fits in that order, of those probabilities; log odds over the model as it is from them, if not given."""
    p = np.array(p)
    bare = [i for i, one in enumerate(fits) if not one.recipes and not one.nameless]
    baseline = fits[bare[0]] if bare else baseline
    odds = np.log(p / p[bare[0]]) if odds is None else np.array(odds)
    return Ranking(baseline, tuple(fits), 1.0, p, (), np.full(len(fits), stated), odds)
