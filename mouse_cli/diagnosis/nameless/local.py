"""An unknown law at one place: a support, a mount or a joint whose stiffness depends on frequency or amplitude."""

from dataclasses import replace
from itertools import product

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.localise.force import Scores, log_prior, scores
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._averaged import averaged
from mouse_cli.diagnosis.nameless._by_mode import Lawful, OneLaw
from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._correlated import leading
from mouse_cli.diagnosis.nameless._field import Smooth
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.sites.channels import FORCE, HINGE, PAIR, SLIDE, STRETCH, TIE
from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.model.diagnosis import LAW, Site

_STEPS, _FEWEST = 30, 3  # of a fit; modes with a frequency and a shape that make a law
_OCTAVES = (0.0, 1.0, 3.0)  # over which a law is correlated; 0: each mode has a value of its own
_EVEN = {
    FORCE: "ground-spring",
    HINGE: "local-stiffness",
    SLIDE: "local-stiffness",
    STRETCH: "local-stiffness",
    PAIR: "local-stiffness",
    TIE: "brace",
}  # groups of what a law is that does not vary
_SMOOTH = 1e-3  # share of the largest singular value below which a start follows no component of a law
_RIGID = 1e-6  # share of the eigenvalue of the highest measured mode below which a mode is rigid


def best_law(model: Reduced, reach: float = np.inf) -> Fit | None:
    """The law at the place where the shapes by themselves put one force, all places and spreads integrated out.

    reach: misfit above which no fit matters.

    The evidence at the best place is Laplace's, of the fit; that of another differs from it by what its shapes do. None where the
    test has fewer than three modes with shapes, or shapes that tell no place.
    """
    found = scores(model)
    if found is None or len(found.measured.modes) < _FEWEST:
        return None
    weight = -0.5 * (found.matches.cost + found.matches.volume()) + log_prior(found.channels)
    place = int(np.argmax(weight))
    places = float(np.logaddexp.reduce(weight) - weight[place] + log_prior(found.channels)[place])
    grid = list(product(NAMELESS.spreads, _OCTAVES))
    fits = [one for one in (_at(model, found, place, *each, reach) for each in grid) if one is not None]
    if not fits:
        return None
    total = np.logaddexp.reduce([one.log_evidence for one in fits]) - np.log(len(grid))
    return averaged(fits, [one.log_evidence for one in fits], total + places)


def _at(model: Reduced, found: Scores, place: int, spread: float, octaves: float, reach: float) -> Fit | None:
    """The fit of a law at one place, its values in units of the static stiffness there."""
    row, z = found.rows[place], found.matches.z[place]
    number = _numbers(model)
    elastic = model.eigenvalues > _RIGID * model.eigenvalues[min(int(number.max()), model.r) - 1]
    unit = 1 / float((row[elastic] ** 2 / model.eigenvalues[elastic]).sum())
    channel, i = found.find(place)
    hz = dict(zip(model.data.test.number.tolist(), model.data.test.frequency_hz.tolist(), strict=True))
    sites = tuple(_of_mode(channel.site(i), channel.name, n, hz.get(n)) for n in number.tolist())
    at = _octaves(model, number)
    cells = Cells(sites, at[:, None], "octaves", (), "K")
    P = _about_a_level(cells.at, octaves) if octaves else np.eye(len(number))
    field = Smooth(replace(NAMELESS, even=_EVEN.get(channel.name, "")), cells, spread * P, spread, octaves)
    own = {name: getattr(model, name) for name in Reduced.__dataclass_fields__}
    none = np.zeros((P.shape[1], model.r, model.r))
    base = Lawful(**own, nameless=field, of_field=none, row=np.sqrt(unit) * row, numbers=number)
    known = np.isin(number, model.data.test.number)
    start = np.linalg.lstsq(spread * P[known], _implied(base, z), rcond=_SMOOTH)[0]
    return fit(OneLaw(base), np.zeros(0), np.concatenate([z, start]), _STEPS, reach)


def _about_a_level(at: np.ndarray, octaves: float) -> np.ndarray:
    """A level of all modes (m, 1 + w), and what varies about it: each as unknown as the other."""
    return np.hstack([np.ones((len(at), 1)), leading(at, octaves)])


def _numbers(model: Reduced) -> np.ndarray:
    """Numbers of the modes that were measured, then of those that the deck holds out: a law that is smooth predicts these too."""
    test, held = model.data.test, model.problem.hold_out
    out = held.test.number if held is not None and held.test is not None else test.number[:0]
    return np.concatenate([test.number, np.setdiff1d(out, test.number)])


def _octaves(model: Reduced, number: np.ndarray) -> np.ndarray:
    """Where modes lie on a logarithmic scale of frequency, by the model: what was measured of those held out stays unknown."""
    lam = model.eigenvalues[np.minimum(number, model.r) - 1]
    return 0.5 * np.log2(np.maximum(lam, _RIGID * lam.max()))


def _of_mode(site: Site, channel: str, number: int, hz: float | None) -> Site:
    where = site.text or f"{site.kind} {', '.join(map(str, site.ids))}"
    return replace(
        site, text=f"{where} ({channel}), mode {number} " + ("held out" if hz is None else f"at {hz:.4g} Hz")
    )


def _implied(base: Lawful, z: np.ndarray) -> np.ndarray:
    """Values (m,) that each measured frequency asks for at z, as `localise/implied_law.py` reads them; 0 without a frequency."""
    K, M = Reduced.matrices(base, np.append(z, np.zeros(len(base.of_field))))
    values = np.zeros(base.data.m)
    for i, hz in enumerate(base.data.test.frequency_hz):
        if np.isfinite(hz):
            values[i] = -1 / float(base.row @ np.linalg.solve(K - eigenvalue(hz) * M, base.row))
    return values


NAMELESS = Nameless(
    "law",
    "one force of an unknown law at one site",
    LAW,
    "a stiffness of its own in each mode at one site, or between two neighbours: the law of a mount, a support or a joint that "
    "depends on frequency or amplitude; its site, its spread, in units of the static stiffness there, and whether each mode has "
    "its own or they vary over one or three octaves about a level are integrated out",
    (0.3, 3.0, 30.0, 300.0),
    lambda model: None,
)
