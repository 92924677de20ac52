"""Coupled structures in brief: what was found, and whether the interface can be trusted."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.coupled import Coupled, InterfaceState
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import VERDICT, Options, Section
from mouse_cli.report.sections._wording import counted


def verdict(found: Coupled, options: Options) -> Iterator[Block]:
    """Trust first, then how much was computed."""
    if any(each.code == "MD713" for each in found.warnings):
        yield Text("Do not trust the coupled functions: noise decides the interface at more than a few lines.")
    else:
        yield Text(_trusted(found.interface))
    whole = found.modes
    if whole is not None and len(whole.frequencies_hz) > whole.rigid:
        elastic = whole.frequencies_hz[whole.rigid :]
        yield Text(
            f"{counted(len(elastic), 'elastic mode')} from {{}} to {{}} Hz.", (float(elastic[0]), float(elastic[-1]))
        )


def _trusted(interface: InterfaceState | None) -> str:
    """What is known of the interface where nothing forbids to trust it."""
    if interface is None or not interface.conditions:
        return "The parts are coupled as models."
    if np.isnan(interface.noise).all():
        return "The interface is not judged: the accuracy of the measured FRFs is unknown."
    return "The interface can be trusted: noise decides it at few lines or none."


SECTION = Section("coupling-verdict", 10, "Coupled structures", verdict, (Coupled,), place=VERDICT)
