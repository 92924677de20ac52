"""An unknown law at one place: a support, a mount or a joint whose stiffness depends on frequency or amplitude."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.localise.force import Scores, log_prior, scores
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._by_mode import Lawful, OneLaw
from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._field import Smooth
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.model.diagnosis import LAW, Site

_STEPS, _FEWEST = 30, 3  # of a fit; modes with a frequency and a shape that make a law
_RIGID = 1e-6  # share of the eigenvalue of the highest measured mode below which a mode is rigid


def best_law(model: Reduced) -> Fit | None:
    """The law at the place where the shapes by themselves put one force, all places and spreads integrated out.

    The evidence at the best place is Laplace's, of the fit; that of another differs from it by what its shapes do. None where the
    test has fewer than three modes with shapes, or shapes that tell no place.
    """
    found = scores(model)
    if found is None or len(found.measured.modes) < _FEWEST:
        return None
    weight = -0.5 * (found.matches.cost + found.matches.volume()) + log_prior(found.channels)
    place = int(np.argmax(weight))
    places = float(np.logaddexp.reduce(weight) - weight[place] + log_prior(found.channels)[place])
    fits = [_at(model, found, place, spread) for spread in NAMELESS.spreads]
    fits = [one for one in fits if one is not None]
    if not fits:
        return None
    best = max(fits, key=lambda one: one.log_evidence)
    total = np.logaddexp.reduce([one.log_evidence for one in fits]) - np.log(len(NAMELESS.spreads))
    return replace(best, log_evidence=float(total + places))


def _at(model: Reduced, found: Scores, place: int, spread: float) -> Fit | None:
    """The fit of a law at one place, its values in units of the static stiffness there."""
    row, z = found.rows[place], found.matches.z[place]
    number = model.data.test.number
    elastic = model.eigenvalues > _RIGID * model.eigenvalues[min(int(number.max()), model.r) - 1]
    unit = 1 / float((row[elastic] ** 2 / model.eigenvalues[elastic]).sum())
    channel, i = found.find(place)
    sites = tuple(_of_mode(channel.site(i), channel.name, int(n), hz) for n, hz in _modes(model))
    cells = Cells(sites, number[:, None].astype(float), "modes", (), "K")
    field = Smooth(NAMELESS, cells, spread * np.eye(len(number)), spread, 0.0)
    own = {name: getattr(model, name) for name in Reduced.__dataclass_fields__}
    none = np.zeros((len(number), model.r, model.r))
    base = Lawful(**own, nameless=field, of_field=none, row=np.sqrt(unit) * row, numbers=number)
    return fit(OneLaw(base), np.zeros(0), np.concatenate([z, _implied(base, z) / spread]), _STEPS)


def _modes(model: Reduced) -> list[tuple[int, float]]:
    return list(zip(model.data.test.number.tolist(), model.data.test.frequency_hz.tolist(), strict=True))


def _of_mode(site: Site, channel: str, number: int, hz: float) -> Site:
    where = site.text or f"{site.kind} {', '.join(map(str, site.ids))}"
    return replace(site, text=f"{where} ({channel}), mode {number} at {hz:.4g} Hz")


def _implied(base: Lawful, z: np.ndarray) -> np.ndarray:
    """Values (m,) that each measured frequency asks for at z, as `localise/implied_law.py` reads them; 0 without a frequency."""
    K, M = Reduced.matrices(base, np.append(z, np.zeros(len(base.numbers))))
    values = np.zeros(len(base.numbers))
    for i, hz in enumerate(base.data.test.frequency_hz):
        if np.isfinite(hz):
            values[i] = -1 / float(base.row @ np.linalg.solve(K - eigenvalue(hz) * M, base.row))
    return values


NAMELESS = Nameless(
    "law",
    "one force of an unknown law at one site",
    LAW,
    "a stiffness of its own in each mode at one site, or between two neighbours: the law of a mount, a support or a joint that "
    "depends on frequency or amplitude; its site and its spread are integrated out, in units of the static stiffness there",
    (0.3, 3.0, 30.0, 300.0),
    lambda model: None,
)
