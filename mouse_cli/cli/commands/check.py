"""mouse check: look for errors in many decks, compute nothing but the eigensolution that judges the mode numbers."""

import click

from mouse_cli.cli._options import READING, options, outside


@click.command()
@click.argument("decks", nargs=-1, required=True)
@click.option("--brief", is_flag=True, help="One line for each finding, without the card.")
@click.option("--strict", is_flag=True, help="Warnings count as errors.")
@click.option("--stacked", is_flag=True, help="Files of cards may hold several decks, one after another.")
@click.option("-q", "--quiet", is_flag=True, help="Errors only, no warnings.")
@options(READING)
def command(decks: tuple[str, ...], brief: bool, strict: bool, stacked: bool, quiet: bool) -> int:
    """Report errors in DECKS without running them.

    DECKS are files, folders, or '-' for standard input. Findings go to standard error, a count line to standard output.

    Exit 0: every deck is sound. 4: at least one was rejected.
    """
    from mouse_cli.cli._decks import expanded
    from mouse_cli.cli._terminal import show_diagnostics

    checked = rejected = warned = 0
    for path, folder in expanded(decks):
        findings = _unread(path, folder) or _findings(path, stacked)
        errors = any(d.severity == "error" for d in findings) or (strict and bool(findings))
        checked, rejected, warned = checked + 1, rejected + errors, warned + (bool(findings) and not errors)
        show_diagnostics((d for d in findings if d.severity == "error" or not quiet), brief)
    decks_checked = f"{checked} deck{'s' if checked != 1 else ''} checked"
    click.echo(f"{decks_checked}: {checked - rejected} sound, {rejected} rejected, {warned} with warnings")
    return 4 if rejected else 0


def _unread(path: str, folder: str) -> tuple:
    """Why a file that was found in a folder is not read; empty for all others."""
    from mouse_cli.batch.decks import refused

    return tuple(refused(folder, path, outside())) if folder else ()


def _records(problem) -> tuple:
    """What keeps recordings from judging a deck that has nothing else."""
    if not problem.recordings:
        return ()
    from mouse_cli.diagnosis.names import by_records
    from mouse_cli.updating.recordings.records import cannot_judge

    return cannot_judge(problem) if by_records(problem) else ()


def _findings(path: str, stacked: bool) -> tuple:
    """Everything found in one file."""
    from mouse_cli._errors import MouseError
    from mouse_cli.batch.decks import is_manifest
    from mouse_cli.cli._decks import read_drafts, read_other
    from mouse_cli.formats.assemble import assemble
    from mouse_cli.updating.prior_model import examine

    found: tuple = ()
    try:
        if is_manifest(path):
            from mouse_cli.batch import manifest

            manifest.read(path, outside())
            return found
        other = read_other(path)
        if other is not None:
            return other.warnings
        for draft in read_drafts(path, stacked):
            problem = assemble(draft)
            found += problem.warnings
            found += examine(problem)
            found += _records(problem)
    except MouseError as error:
        return found + error.diagnostics
    return found
