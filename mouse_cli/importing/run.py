"""The whole of an import: read, export, check, write."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from mouse_cli._errors import WARNING, DeckError, Diagnostic
from mouse_cli._span import Span
from mouse_cli.importing import calculix
from mouse_cli.importing.bars.run import ImportedBars, bars_of, imported_bars
from mouse_cli.importing.cards import Card
from mouse_cli.importing.checks import Checked, begin, check
from mouse_cli.importing.deck import write
from mouse_cli.importing.knots import knots
from mouse_cli.importing.material_units import told
from mouse_cli.importing.model import InputModel
from mouse_cli.importing.read import read
from mouse_cli.importing.separate import Parts, parts
from mouse_cli.importing.thickness import chosen, thicknesses
from mouse_cli.importing.without import losses
from mouse_cli.model.held import Thickness
from mouse_cli.model.units import SYSTEMS


@dataclass(frozen=True)
class Imported:
    """What an import made: the model, its matrices, the checks, the files (the deck last), and what is to be known of it."""

    model: InputModel
    parts: Parts
    checked: Checked
    files: list[Path]
    system: str
    remarks: tuple[Diagnostic, ...]
    thick: dict[int, Thickness]

    def text(self) -> str:
        """What was read, checked and written, in a few lines."""
        model, rows = self.model, self.parts.whole.K.shape[0]
        found = [
            f"{len(model.nodes)} nodes, {len(model.elements)} elements, {rows} degrees of freedom; "
            f"units {self.system or 'unknown'}",
            f"element sets: {', '.join(group.name for group in model.groups)}",
            f"supports: {', '.join(f'{s.name} ({len(s.dofs)})' for s in model.supports) or 'none'}",
        ]
        if model.ignored:
            found.append(f"without effect on K and M: {', '.join(f'*{word}' for word in model.ignored)}")
        found += [
            f"{self.parts.jobs} exports; sets sum to the whole to {max(self.parts.error):.1g}",
            *(
                [f"thickness of shells by its powers: {', '.join(self.model.groups[i].name for i in self.thick)}"]
                if self.thick
                else []
            ),
            self.checked.text(),
            f"written: {self.files[-1]} and {len(self.files) - 1} files in {self.files[0].parent}",
        ]
        return "\n".join(found)


def imported(
    path: str, target: Path, system: str | None, cached: bool, say: Callable[[str], None], outside: bool = False,
    thickness: tuple[str, ...] = (),
) -> Imported | ImportedBars:  # fmt: skip
    """Makes the deck `target` of the input file `path`; say: told what is going on. Raises DeckError, WrittenError.

    outside: the file may include others from outside of its folder. thickness: sets of shells whose thickness is a parameter.
    """
    if (bars := bars_of(path, outside)) is not None:
        return imported_bars(bars, path, target, system, thickness)
    model = read(path, outside)
    shells = chosen(model, thickness)
    if not calculix.available():
        message = "CalculiX (ccx) is not on the path: nothing can export K and M"
        help = "install it (Debian, Ubuntu: apt install calculix-ccx), or export by hand as in docs/how-to/import-models.md"
        raise DeckError.of("MD274", message, Span(path, 1), help=help)
    with calculix.Solver(path, calculix.cache_folder() if cached else None, say) as solver:
        found = parts(model, solver, lambda whole: begin(model, whole, solver))
        thick = thicknesses(model, found, solver, shells)
        checked = check(model, found, solver)
        lost, unknown = losses(model, found, solver)
    named, of_units = told(model, system)
    remarks = [*model.remarks, *knots(model, unknown), *_passed_over(model, found), *of_units]
    unit = SYSTEMS[named].length if named else ""
    thick = {i: replace(each, unit=unit) for i, each in thick.items()}
    files = write(target, model, found, checked, named, thick, shells, lost)
    return Imported(model, found, checked, files, named, tuple(remarks), thick)


def _passed_over(model: InputModel, found: Parts) -> Iterator[Diagnostic]:
    """Warnings: options that the solver does not know, and groups that have no part in K and M."""
    help = "take the option out if K and M do not depend on it; else write what it does in a way that CalculiX knows"
    for keyword, option in found.whole.unknown:
        word = keyword.lstrip("*")
        named = [card.head.span for card in model.every if card.keyword in word.split("/") and _has(card, option)]
        message = f"CalculiX passed over {option} of {keyword}, which it does not know"
        yield Diagnostic("MD274", WARNING, message, named[0] if named else Span(model.path, 1), help=help)
    for group, K, M in zip(model.groups, found.K, found.M, strict=True):
        if not K.nnz and not M.nnz:
            message = f"element set {group.name} gives nothing to K and M of CalculiX: nothing there holds its nodes"
            help = "join its nodes to the structure, by *RIGID BODY, *COUPLING or *EQUATION, or delete it"
            yield Diagnostic("MD276", WARNING, message, group.owner.head.span, help=help)


def _has(card: Card, option: str) -> bool:
    return "".join(option.partition("=")[0].split()) in ("".join(name.split()) for name in card.options)
