"""Writes what was imported: matrices and tables in a folder, and the deck that names them."""

import io
import os
import re
import zipfile
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from mouse_cli._atomic import write_bytes_atomically, write_text_atomically
from mouse_cli.formats.yaml_deck.text import real, word, wrapped
from mouse_cli.importing.cards import Card
from mouse_cli.importing.checks import Checked, held_rows
from mouse_cli.importing.model import InputModel
from mouse_cli.importing.separate import Parts
from mouse_cli.importing.thickness import total
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.held import Thickness
from mouse_cli.model.revision import DENSITY_OF, E_OF, OF_SPRING, THICKNESS, TO_THE_POWER
from mouse_cli.model.units import SYSTEMS

E_SD, DENSITY_SD, SPRING_SD = "5 %", "1 %", "20 %"  # what is known of a material and of a spring before the test
_THICKNESS_SD = "5 %"  # of a shell
_MOST_MODES = 6
_DIRECTIONS = ("S", *DIRECTIONS)


def write(
    target: Path, model: InputModel, parts: Parts, checked: Checked, system: str, thick: dict[int, Thickness],
    shells: Iterable[Card], lost: dict[int, tuple[Matrix, Matrix]],
) -> list[Path]:  # fmt: skip
    """The deck `target` and a folder of its files beside it; returns all paths, the deck last. Raises WrittenError.

    lost: what K and M lose without a group (number), where that is more than it gives.
    """
    folder = target.parent / f"{target.stem}_model"
    folder.mkdir(parents=True, exist_ok=True)
    written: list[Path] = []

    def keep(name: str, matrix: Matrix) -> str:
        path = folder / f"{name}.npz"
        write_bytes_atomically(path, _npz(matrix))
        written.append(path)
        return f"{{file: {word(f'{folder.name}/{name}.npz')}}}"

    def table(name: str, text: str) -> str:
        write_text_atomically(folder / name, text)
        written.append(folder / name)
        return f"{{file: {word(f'{folder.name}/{name}')}}}"

    lines = _head(model, parts, checked, system)
    lines += [
        "model:",
        f"  stiffness: {keep('K', parts.whole.K)}  # without supports",
        f"  mass: {keep('M', parts.whole.M)}",
        f"  dofs: {table('dofs.csv', _dofs(parts.whole.rows.names))}",
        f"  nodes: {table('nodes.csv', _nodes(model))}",
        *_supports(model, parts),
        *_sets(model, parts, keep, thick, lost),
        *_parameters(model, parts, keep, system),
        *_thick(model, thick, shells, keep),
        *stub(checked.own, "12TZ"),
    ]
    write_text_atomically(target, "\n".join(lines) + "\n")
    return [*written, target]


def _head(model: InputModel, parts: Parts, checked: Checked, system: str) -> list[str]:
    title = next((card.lines[0].text.strip() for card in model.every if card.keyword == "HEADING" and card.lines), "")
    n = parts.whole.K.shape[0]
    return [
        f"# Made by mouse import of {os.path.basename(model.path)}: {n} degrees of freedom, {len(model.groups)} element sets.",
        f"# Sets sum to the whole to {max(checked.sum_K, checked.sum_M):.1g};",
        f"# {checked.text()} (CalculiX).",
        "mouse: 1",
        f"title: {word(title or os.path.basename(model.path), flow=False)}",
        *([f"units: {system}"] if system else []),
    ]


def _supports(model: InputModel, parts: Parts) -> list[str]:
    names = [f"{node}{_DIRECTIONS[d]}" for node, d in parts.whole.rows.names.tolist()]
    found = held_rows(model, parts.whole)
    lines = ["  supports:"] if found else []
    return lines + [f"    {word(name)}: {{dofs: {wrapped((names[i] for i in rows), 6)}}}" for name, rows in found]


def _sets(model: InputModel, parts: Parts, keep, thick: dict[int, Thickness], lost: dict) -> list[str]:
    lines = ["  sets:"] if model.groups else []
    for i, group in enumerate(model.groups):
        files = [f"{key}: {keep(f'{mark}_{_slug(group.name)}', matrix)}"
                 for key, mark, matrix in (("stiffness", "K", parts.K[i]), ("mass", "M", parts.M[i])) if matrix.nnz]  # fmt: skip
        if files:
            nodes = sorted({node for e in group.elements for node in model.elements[e][1]})
            files += [f"thickness: {_by_power(thick[i], group.name, keep)}"] if i in thick else []
            if i in lost:
                of = zip(("stiffness", "mass"), "KM", lost[i], strict=True)
                without = (f"{key}: {keep(f'{mark}_without_{_slug(group.name)}', matrix)}" for key, mark, matrix in of)
                files.append(f"missing: {{{', '.join(without)}}}")
            lines.append(f"    {word(group.name)}: {{{', '.join(files)}, nodes: {wrapped(_ranges(nodes), 6)}}}")
    return lines


def _parameters(model: InputModel, parts: Parts, keep, system: str) -> list[str]:
    """E and density of each material, springs by their sets."""
    lines = ["", "parameters:"]
    known = {"SI": ("Pa", "kg/m3", "N/m"), "mm-t-N": ("MPa", "t/mm3", "N/mm"),
             "in-lbf": ("psi", "lbf s2/in4", "lbf/in")}  # fmt: skip
    other = tuple(SYSTEMS[system].of(unit) for unit in known["SI"]) if system else ("", "", "")
    pressure, density, of_length = known.get(system, other)
    for name, material in model.materials.items():
        own = [i for i, group in enumerate(model.groups) if group.material is material]
        K, M = (sum(each[i] for i in own) if own else None for each in (parts.K, parts.M))
        value, unit = (material.E, pressure) if material.isotropic else (1.0, "1")
        if own and K.nnz:
            lines.append(
                _parameter(E_OF.format(name), value, unit, E_SD, "stiffness", keep(f"E_{_slug(name)}", K / value))
            )
        if own and M.nnz and material.rho:
            file = keep(f"rho_{_slug(name)}", M / material.rho)
            lines.append(_parameter(DENSITY_OF.format(name), material.rho, density, DENSITY_SD, "mass", file))
    for i, group in enumerate(model.groups):
        if group.owner.keyword == "SPRING" and parts.K[i].nnz:
            k = group.constant
            file = keep(f"spring_{_slug(group.name)}", parts.K[i] / k)
            lines.append(_parameter(OF_SPRING.format(group.name), k, of_length, SPRING_SD, "stiffness", file))
    return lines if len(lines) > 2 else []


def _by_power(one: Thickness, name: str, keep) -> str:
    """What a set gives to K and M by powers of its thickness."""
    of = f", unit: {one.unit}" if one.unit else ""
    powers = [f"{n:g}: {{{', '.join(_of_power(one, n, name, keep, 1.0))}}}" for n in one.powers]
    return f"{{nominal: {real(one.nominal)}{of}, powers: {{{', '.join(powers)}}}}}"


def _of_power(one: Thickness, n: float, name: str, keep, scale: float) -> list[str]:
    return [f"{key}: {keep(f'{mark}_t{n:g}_{_slug(name)}', by[n] / scale)}"
            for key, mark, by in (("stiffness", "K", one.K), ("mass", "M", one.M)) if n in by]  # fmt: skip


def _thick(model: InputModel, thick: dict[int, Thickness], shells: Iterable[Card], keep) -> Iterable[str]:
    """A parameter for the thickness of each of the sections `shells`, and its other powers."""
    for card in shells:
        one = total(thick[i] for i, group in enumerate(model.groups) if group.owner is card)
        section = card.options["ELSET"]
        name = THICKNESS.format(section)
        for n in one.powers:
            of = f", unit: {one.unit}" if one.unit else ""
            if n == 1:
                own = f"{word(name)}, nominal: {real(one.nominal)}{of}, sd: {_THICKNESS_SD}, transform: log"
            else:
                own = f"{word(name + TO_THE_POWER.format(f'{n:g}'))}, power_of: [{word(name)}, {n:g}]"
            files = _of_power(one, n, f"of_{section}", keep, one.nominal**n)
            yield f"  - {{name: {', '.join([own, *files])}}}"


def _parameter(name: str, value: float, unit: str, sd: str, key: str, file: str) -> str:
    of = f", unit: {word(unit)}" if unit else ""
    return f"  - {{name: {word(name)}, nominal: {real(value)}{of}, sd: {sd}, transform: log, {key}: {file}}}"


def stub(own: np.ndarray, sensor: str) -> list[str]:
    """What to fill in when the test is there; own (m,): frequencies of the model; sensor: one of its degrees of freedom."""
    hz = ", ".join(f"{f:.4g}" for f in own[:_MOST_MODES]) or "..."
    return [
        "",
        "# The test goes here" + ("; the frequencies are those of the model before it." if len(own) else "."),
        "# test:",
        "#   modes:",
        f"#     frequency: [{hz}]",
        "#     frequency_sd: 0.1 %",
        f"#     dofs: [...]         # of the sensors, such as {sensor}",
        "#     shapes: [[...]]     # a row for each sensor",
        "#     shape_sd: 2 %",
    ]


def _dofs(names: np.ndarray) -> str:
    return "node,direction\n" + "".join(f"{node},{_DIRECTIONS[d]}\n" for node, d in names.tolist())


def _nodes(model: InputModel) -> str:
    return "number,x,y,z\n" + "".join(
        f"{n},{','.join(map(repr, at.tolist()))}\n" for n, at in sorted(model.nodes.items())
    )


def _ranges(numbers: list[int]) -> Iterable[str]:
    """Numbers as ranges: 1-4, 7."""
    start = last = numbers[0]
    for n in [*numbers[1:], None]:
        if n is not None and n == last + 1:
            last = n
            continue
        yield str(start) if start == last else f"{start}-{last}"
        start = last = n


def _slug(name: str) -> str:
    return re.sub(r"\W+", "_", name)


def _npz(matrix: Matrix) -> bytes:
    """As scipy.sparse.save_npz writes it, compressed less and four times as fast."""
    from scipy.sparse import csr_matrix

    found, stream = csr_matrix(matrix), io.BytesIO()
    parts = {
        "indices": found.indices,
        "indptr": found.indptr,
        "format": b"csr",
        "shape": found.shape,
        "data": found.data,
    }
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, part in parts.items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as file:
                np.lib.format.write_array(file, np.asanyarray(part), allow_pickle=False)
    return stream.getvalue()
