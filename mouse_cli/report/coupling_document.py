"""Coupled structures as one JSON document, schema mouse.coupling/1."""

from typing import Any

from mouse_cli.model.coupled import Coupled, CoupledModes, InterfaceState
from mouse_cli.model.coupling import Connection, Coupling
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.report.json_values import coded, fields

SCHEMA = "mouse.coupling/1"


def document(found: Coupled) -> dict[str, Any]:
    """`found` in plain Python values; complex numbers as [real, imaginary]."""
    coupling = found.coupling
    return {
        "schema": SCHEMA,
        "title": coupling.title.strip(),
        "source": coupling.path,
        "substructures": [
            {
                "name": part.name,
                "source": part.problem.source.path if part.problem else part.frf.path,
                **fields(part, "measured", "removed", "places"),
            }
            for part in coupling.substructures
        ],
        "interfaces": [[coupling.name(a), coupling.name(b)] for a, b in coupling.interfaces],
        "connections": [connection(one, coupling) for one in coupling.connections],
        "truncate": coupling.truncate,
        "interface": None if found.interface is None else _interface(found.interface),
        "functions": None if found.functions is None else functions(found.functions),
        "peaks": [vars(peak) for peak in found.peaks],
        "modes": None if found.modes is None else _modes(found.modes),
        "warnings": coded(found.warnings),
    }


def connection(one: Connection, coupling: Coupling | None = None, names: tuple[str, ...] = ()) -> dict[str, Any]:
    """What a connection is and where; places by the names of a coupling, or of one model."""

    def name(point) -> str | None:
        if point is None:
            return None
        return coupling.name(point) if coupling is not None else names[point.place]

    return {
        "name": one.name,
        "kind": one.kind,
        "at": name(one.at),
        "to": name(one.to),
        **fields(one, "mass", "stiffness", "loss_factor", "damping"),
    }


def functions(frf: FrfTest) -> dict[str, Any]:
    """Lines, and each function with its variance."""
    return {
        "kind": frf.kind,
        "hz": frf.frequency_hz,
        "decay_rate": frf.decay_rate,
        "each": [
            {
                "response": response,
                "force": force,
                "real": frf.H[:, o, i].real,
                "imag": frf.H[:, o, i].imag,
                "variance": frf.variance[:, o, i],
            }
            for o, response in enumerate(frf.output_names)
            for i, force in enumerate(frf.input_names)
        ],
    }


def _interface(state: InterfaceState) -> dict[str, Any]:
    named = {"conditions": state.conditions, "condition_number": state.condition}
    return {**named, **fields(state, "kept", "noise"), "basis_error": state.error}


def _modes(modes: CoupledModes) -> dict[str, Any]:
    return {
        "degrees_of_freedom": modes.size,
        "rigid_modes": modes.rigid,
        "hz": modes.frequencies_hz,
        "reduced": [
            {**fields(r, "method", "keep", "coordinates"), "hz": r.frequencies_hz, "error": r.error}
            for r in modes.reduced
        ],
    }
