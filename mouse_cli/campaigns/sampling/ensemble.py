"""The affine-invariant ensemble (Goodman and Weare 2010) by the package emcee, until its chain is long enough."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from mouse_cli._errors import MouseError
from mouse_cli.campaigns.sampling import chains
from mouse_cli.campaigns.sampling.kept import Kept
from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.updating.posterior import cost
from mouse_cli.updating.state import Setting

_EVERY = 250  # steps between two looks at the chain
_BURN = 5  # autocorrelation times left out at the beginning


@dataclass(frozen=True)
class Density:
    """log p(w) up to a constant in w, z = centre + root w, and the paired natural frequencies there (m,)."""

    setting: Setting
    centre: np.ndarray
    root: np.ndarray

    def __call__(self, w: np.ndarray) -> tuple[float, np.ndarray]:
        """-J/2 and Hz; -infinity and NaN where the density is zero."""
        J, state = cost(self.setting, self.z(w))
        if state is None:
            return -np.inf, np.full(self.setting.problem.test.m, np.nan)
        return -0.5 * J, frequency_hz(np.maximum(state.solution.eigenvalues[state.modes], 0.0))

    def z(self, w: np.ndarray) -> np.ndarray:
        """Places z (..., k) of w (..., k)."""
        return self.centre + w @ self.root.T

    def w(self, z: np.ndarray) -> np.ndarray:
        """The other way."""
        return np.linalg.solve(self.root, (z - self.centre).T).T


@dataclass(frozen=True)
class Walked:
    """A chain z (s, w, k) after `burn` of `steps` steps, log p (s, w), hz (s, w, m); see `Sampled` for the rest."""

    z: np.ndarray
    log_p: np.ndarray
    hz: np.ndarray
    steps: int
    burn: int
    tau: float
    acceptance: float
    long_enough: bool


def package() -> Any:
    """The package emcee. Raises MouseError (MD940)."""
    try:
        import emcee
    except ImportError as error:
        help = "pip install 'mouse-cli[sampling]'"
        raise MouseError.of("MD940", "the package emcee is not installed", help=help) from error
    return emcee


def walk(
    density: Density,
    begun: np.ndarray,
    steps: int,
    seed: int,
    pool: Any = None,
    say: Callable[[str], None] = lambda text: None,
    kept: Kept | None = None,
) -> Walked:
    """Walk from the places z (w, k) until the chain is long enough, or for so many `steps`; kept: goes on from there."""
    emcee = package()
    moves = [(emcee.moves.StretchMove(), 0.4), (emcee.moves.DEMove(), 0.5), (emcee.moves.DEMove(gamma0=1.0), 0.1)]
    count, k = begun.shape
    hz = [("hz", float, (density.setting.problem.test.m,))]
    kept, setting = kept or Kept(None), density.setting
    backend = kept.backend(emcee, begun, density.centre, density.root, setting.y, setting.sd, np.array(seed))
    sampler = emcee.EnsembleSampler(count, k, density, moves=moves, blobs_dtype=hz, pool=pool, backend=backend)
    done, state = backend.iteration, None
    if done:
        burn, enough, tau = _looked(sampler, done, steps, say)
    else:
        state, burn, enough, tau = emcee.State(density.w(begun), random_state=_random(seed)), 0, False, np.inf
    while done < steps and not enough:
        part = min(_EVERY, steps - done)
        state = sampler.run_mcmc(state, part, skip_initial_state_check=True)
        done += part
        if part == _EVERY:
            kept.keep(backend)
        burn, enough, tau = _looked(sampler, done, steps, say)
    kept.done()
    z, log_p = density.z(sampler.get_chain(discard=burn)), sampler.get_log_prob(discard=burn)
    acceptance = float(np.mean(sampler.acceptance_fraction))
    return Walked(z, log_p, sampler.get_blobs(discard=burn)["hz"], done, burn, tau, acceptance, enough)


def _looked(sampler: Any, done: int, steps: int, say: Callable[[str], None]) -> tuple[int, bool, float]:
    """Steps to leave out at the beginning, whether the rest is long enough, its autocorrelation time."""
    burn = min(int(np.ceil(_BURN * chains.long_enough(sampler.get_chain())[1])), done // 2)
    enough, tau = chains.long_enough(sampler.get_chain(discard=burn))
    say(f"step {done} of at most {steps}: autocorrelation time {tau:.3g}, {(done - burn) / tau:.0f} of {chains.ENOUGH}")
    return burn, enough, tau


def _random(seed: int) -> tuple:
    """The state of a generator as emcee wants it."""
    state = np.random.MT19937(seed).state["state"]
    return "MT19937", state["key"], state["pos"], 0, 0.0
