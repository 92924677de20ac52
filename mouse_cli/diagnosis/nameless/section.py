"""A section that varies smoothly along bars, so that stiffness and mass change together: corrosion, wear, a wrong thickness."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.matrices import of_matrices
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import FEWEST, Cells, of_elements
from mouse_cli.model.diagnosis import STIFFNESS

_SHARE = 1 / 3  # of a small change of b h over that of b h^3, where the depth h changes


def cells(model: Reduced) -> Cells | None:
    """K + sum v_e K_e and M + sum v_e M_e / 3 over beams; no parameter of a deck holds both."""
    if of_matrices(model.problem) or model.bars is None:
        return None
    stiff, heavy = of_elements(model, "K", ("E", "G")), of_elements(model, "M", ("density", "nonstructural_mass"))
    if stiff is None or heavy is None:
        return None
    beams = set(model.bars.ids.tolist())
    place = {site.ids: i for i, site in enumerate(heavy.sites)}
    kept = [i for i, site in enumerate(stiff.sites) if site.ids in place and site.ids[0] in beams]
    if len(kept) < FEWEST:
        return None
    stiff = stiff.some(np.array(kept))
    heavy = heavy.some(np.array([place[site.ids] for site in stiff.sites]))
    blocks = tuple((u, _SHARE * M) for u, M in heavy.blocks)
    return replace(stiff, extend=None, beside=replace(heavy, blocks=blocks))


NAMELESS = Nameless(
    "field-section",
    "a section that varies along the structure",
    STIFFNESS,
    "depth of every beam is off by its own share, neighbours alike, and mass changes a third as much as stiffness: a smooth random "
    "field whose spread and correlation length are integrated out",
    (0.03, 0.1, 0.3),
    cells,
    gradient="taper",
)
