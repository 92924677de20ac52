"""The comparison in brief: which method predicts best what it was not given, and which raise no objection."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.updated import Compared, Updated
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import VERDICT, Options, Section


def verdict(found: Compared, options: Options) -> Iterator[Block]:
    """Best prediction, then the methods without remarks."""
    errors = {update.about.key: _predicted(update) for update in found.updates}
    known = {key: error for key, error in errors.items() if np.isfinite(error)}
    if known:
        best = min(known, key=known.__getitem__)
        yield Text(f"Least error of predicted frequencies, rms over all configurations: {best}, {known[best]:.3g} %.")
    else:
        yield Text("Nothing was held out: agreement with the modes that were fitted does not rank the methods.")
    sound = [update.about.key for update in found.updates if not update.warnings]
    if sound:
        yield Text(f"No objection to the answers of {', '.join(sound)}.")
    else:
        yield Text(f"There is an objection to the answer of each of {len(found.updates)} methods: see the remarks.")


def _predicted(update: Updated) -> float:
    """Root mean square frequency error in per cent of what was held out; NaN without."""
    held = [np.atleast_1d(one.revised_hz / one.test_hz - 1) for one in update.configurations if not one.fitted]
    off = np.concatenate(held) if held else np.array([np.nan])
    return float(100 * np.sqrt(np.mean(off**2)))


SECTION = Section("comparison-verdict", 10, "Comparison of methods of updating", verdict, (Compared,), place=VERDICT)
