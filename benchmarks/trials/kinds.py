"""All kinds of trials, `class/family/what`: how each makes its structure, and what it puts into it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from benchmarks.trials import library
from benchmarks.trials.beam import beam
from benchmarks.trials.case import Blank, Mechanism
from benchmarks.trials.chain import chain
from benchmarks.trials.frame import frame
from benchmarks.trials.library import Draw
from benchmarks.trials.outside import fields, grounds, links, plates
from benchmarks.trials.plate import plate

Maker = Callable[[np.random.Generator], Blank]
CLASSES = {"single": 0.28, "several": 0.16, "outside": 0.22, "control": 0.26, "misstated": 0.08}  # shares of the cases
CLAMPED = ("cantilever", "clamped")
SUPPORTED = ("cantilever", "clamped", "pinned")
HELD = ("clamped", "pinned")  # both ends: where axial forces build up
POINT_MASSES = (6, 9)  # of a beam from which some are removed


@dataclass(frozen=True)
class Kind:
    """name; blank: makes the structure; draws: one for each mechanism, or `several` for all; near: they need not stand apart;
    error: of the test that its deck does not state."""

    name: str
    blank: Maker
    draws: tuple[Draw, ...] = ()
    several: Callable[[Blank, np.random.Generator], list[Mechanism]] | None = None
    error: str = ""
    near: bool = False

    def made(self, seed: int, without: int | None = None) -> tuple[Blank, list[Mechanism]]:
        """The structure, and all that its deck lacks, already in it; `without`: but for one of the mechanisms.

        Each has random numbers of its own, so that the others stay as they are.
        """
        blank = self.blank(np.random.default_rng(seed))
        if self.several:
            return blank, self.several(blank, np.random.default_rng([seed, 2])) if without is None else []
        found = []
        for i, draw in enumerate(self.draws):
            if i != without:
                found.append(draw(blank, np.random.default_rng([seed, 2, i])))
            elif draw is library.shear:
                library.slender(blank)
        return blank, found


def _beam(*boundaries: str, **options: object) -> Maker:
    return lambda rng: beam(rng, str(rng.choice(boundaries or SUPPORTED)), **options)


storeys, portal = partial(chain, storeys=True), partial(frame, bays=2)
laden: Maker = lambda rng: beam(rng, masses=int(rng.integers(*POINT_MASSES)))
layered = _beam(layer=fields.LAYER)


def any_end(rng: np.random.Generator) -> Blank:
    """A beam on supports or free; some have point masses or a bonded layer, so that neither tells what is missing."""
    pick = rng.uniform()
    return laden(rng) if pick < 0.15 else layered(rng) if pick < 0.25 else _beam(*SUPPORTED, "free")(rng)


thick_beam, thick_frame = _beam(*SUPPORTED, "free", thick=True), partial(frame, thick=True)

SINGLES: dict[str, tuple[Maker, Draw]] = {
    "beam/mass": (any_end, library.mass),
    "beam/ground-spring": (_beam(), library.ground_spring),
    "beam/oscillator": (any_end, library.oscillator),
    "beam/crack": (any_end, library.hinge),
    "beam/stiffness-loss": (any_end, library.soft),
    "beam/axial": (_beam(*HELD), library.axial),
    "beam/foundation": (_beam(), library.foundation),
    "beam/support-rotation": (_beam(*CLAMPED), library.support_rotation),
    "beam/support-translation": (_beam(), library.support_translation),
    "beam/taper": (_beam(*SUPPORTED, "free"), library.taper),
    "beam/added-mass": (_beam(), library.added_mass),
    "beam/mass-loss": (laden, library.mass_loss),
    "beam/shear": (thick_beam, library.shear),
    "frame/mass": (frame, library.mass),
    "frame/ground-spring": (frame, library.ground_spring),
    "frame/oscillator": (frame, library.oscillator),
    "frame/joint": (frame, library.joint),
    "frame/stiffness-loss": (frame, library.soft),
    "frame/support-rotation": (frame, library.support_rotation),
    "frame/support-translation": (frame, library.support_translation),
    "frame/shear": (thick_frame, library.shear),
    "chain/mass": (chain, library.mass),
    "chain/ground-spring": (chain, library.ground_spring),
    "chain/oscillator": (chain, library.oscillator),
    "storeys/stiffness-loss": (storeys, library.soft),
    "storeys/mass-loss": (storeys, library.mass_loss),
    "storeys/mass": (storeys, library.mass),
    "plate/mass": (plate, library.mass),
    "plate/ground-spring": (plate, library.ground_spring),
    "plate/oscillator": (plate, library.oscillator),
}


def masses_removed(blank: Blank, rng: np.random.Generator) -> list[Mechanism]:
    """Two to four of the point masses are gone."""
    chosen = sorted(rng.choice(len(blank.masses), int(rng.integers(2, 5)), replace=False).tolist())
    return [library.removed(blank, *blank.masses[i], 1.0) for i in chosen]


def flexible_feet(blank: Blank, rng: np.random.Generator) -> list[Mechanism]:
    """All three feet of a frame turn."""
    return [library.flexible(blank, node, rng) for node in blank.feet]


SEVERAL: dict[str, tuple[Maker, tuple[Draw, ...]]] = {
    "beam/two masses": (any_end, (library.mass, library.mass)),
    "beam/two cracks": (any_end, (library.hinge, library.hinge)),
    "beam/mass + stiffness-loss": (any_end, (library.mass, library.soft)),
    "beam/support-rotation + mass": (_beam(*CLAMPED), (library.support_rotation, library.mass)),
    "beam/axial + crack": (_beam(*HELD), (library.axial, library.hinge)),
    "beam/ground-spring + oscillator": (_beam(), (library.ground_spring, library.oscillator)),
    "beam/shear + mass": (thick_beam, (library.shear, library.mass)),
    "beam/three": (_beam(*CLAMPED), (library.support_rotation, library.mass, library.hinge)),
    "frame/joint + mass": (frame, (library.joint, library.mass)),
    "frame/support-rotation + ground-spring": (frame, (library.support_rotation, library.ground_spring)),
    "frame/three": (frame, (library.joint, library.mass, library.soft)),
    "chain/mass + ground-spring": (chain, (library.mass, library.ground_spring)),
    "storeys/stiffness-loss + mass": (storeys, (library.soft, library.mass)),
    "plate/mass + ground-spring": (plate, (library.mass, library.ground_spring)),
}
GROUPS: dict[str, tuple[Maker, Callable]] = {
    "beam/masses removed": (laden, masses_removed),
    "frame/three feet": (portal, flexible_feet),
}
OUTSIDE: dict[str, tuple[Maker, tuple[Draw, ...]]] = {
    "beam/half bed": (_beam(), (fields.half_bed,)),
    "beam/wavy stiffness": (any_end, (fields.wavy_stiffness,)),
    "beam/wavy mass": (any_end, (fields.wavy_mass,)),
    "beam/outrigger": (_beam(), (links.outrigger,)),
    "beam/distant spring": (_beam(), (links.distant,)),
    "beam/axial gradient": (_beam(*HELD), (fields.graded_axial,)),
    "beam/soft foot": (_beam(*CLAMPED), (fields.soft_foot,)),
    "beam/slipping layers": (layered, (fields.slipping,)),
    "beam/amplitude": (_beam(*CLAMPED), (links.amplitude,)),
    "beam/elastomer": (_beam(), (links.elastomer,)),
    "beam/arch": (_beam(*HELD), (links.arch,)),
    "beam/warm": (_beam(*SUPPORTED, "free"), (fields.warm,)),
    "beam/corroded": (_beam(), (fields.corroded,)),
    "beam/elastic wall": (_beam(*CLAMPED), (grounds.elastic_wall,)),
    "beam/pad": (_beam(), (grounds.pad,)),
    "frame/foot on a block": (frame, (grounds.foot_on_block,)),
    "storeys/swaying foundation": (storeys, (grounds.swaying,)),
    "storeys/neighbour": (storeys, (grounds.neighbour,)),
    "plate/delaminated patch": (plate, (plates.thin_patch,)),
    "plate/elastic edge": (plate, (plates.elastic_edge,)),
    "plate/pull": (plate, (plates.pull,)),
    "plate/rib": (plate, (plates.rib,)),
    "plate/wet": (plate, (plates.wet,)),
    "plate/gasket": (plate, (plates.gasket,)),
    "frame/elastomer": (frame, (links.elastomer,)),
    "storeys/overall bending": (storeys, (links.overall_bending,)),
    "frame/outrigger": (frame, (links.outrigger,)),
    "frame/distant spring": (frame, (links.distant,)),
    "frame/soft foot": (frame, (fields.soft_foot,)),
    "frame/amplitude": (frame, (links.amplitude,)),
    "chain/rocking soil": (chain, (links.rocking,)),
    "storeys/rocking soil": (storeys, (links.rocking,)),
    "storeys/eccentric masses": (storeys, (links.eccentric,)),
    "chain/distant spring": (chain, (links.distant,)),
    "plate/distant spring": (plate, (links.distant,)),
    "beam/wavy stiffness + outrigger": (_beam(), (fields.wavy_stiffness, links.outrigger)),
    "beam/half bed + distant spring": (_beam(), (fields.half_bed, links.distant)),
    "frame/soft foot + distant spring": (frame, (fields.soft_foot, links.distant)),
    "storeys/rocking soil + distant spring": (storeys, (links.distant, links.rocking)),
}
OUTSIDE_GROUPS: dict[str, tuple[Maker, Callable]] = {
    "beam/attached beam": (_beam(), links.attached_beam),
    "beam/sleeve": (_beam(*SUPPORTED, "free"), fields.sleeve),
    "frame/every corner": (frame, links.every_corner),
}
CONTROLS: dict[str, Maker] = {
    "beam/none": any_end,
    "frame/none": frame,
    "chain/none": chain,
    "storeys/none": storeys,
    "plate/none": plate,
    "beam/none, laden": laden,
}
ERRORS = ("understated", "gains")  # noise twice as stated; 2 % in the gain of each sensor
MISSTATED = ("beam/mass", "beam/crack", "frame/joint", "chain/ground-spring", "frame/support-rotation")


def kinds() -> list[Kind]:
    """All of them, in a fixed order."""
    found = [Kind(f"single/{name}", blank, (draw,)) for name, (blank, draw) in SINGLES.items()]
    found += [Kind(f"several/{name}", blank, draws) for name, (blank, draws) in SEVERAL.items()]
    found += [Kind(f"several/{name}", blank, several=own, near=True) for name, (blank, own) in GROUPS.items()]
    found += [Kind(f"outside/{name}", blank, draws, near=True) for name, (blank, draws) in OUTSIDE.items()]
    found += [Kind(f"outside/{name}", blank, several=own, near=True) for name, (blank, own) in OUTSIDE_GROUPS.items()]
    found += [Kind(f"control/{name}", blank) for name, blank in CONTROLS.items()]
    for error in ERRORS:
        found += [
            Kind(f"misstated/{name}, {error}", SINGLES[name][0], (SINGLES[name][1],), error=error) for name in MISSTATED
        ]
        found += [
            Kind(f"misstated/{name}, {error}", CONTROLS[name], error=error) for name in ("beam/none", "frame/none")
        ]
    return found
