"""The measured data of a YAML deck that are no modes: frequency response functions and recordings."""

from mouse_cli.formats.record_drafts import FrfDraft, RecordingDraft
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.units import Units


def records(test: Section | None, units: Units) -> tuple[tuple[FrfDraft, ...], tuple[RecordingDraft, ...]]:
    """Both, as far as they could be read; their readers are loaded only where there are any."""
    if test is None or not ("frf" in test or "recordings" in test):
        return (), ()
    from mouse_cli.formats.yaml_deck.frf import functions
    from mouse_cli.formats.yaml_deck.recordings import recordings
    from mouse_cli.formats.yaml_deck.sensors import sensors

    document = test.document
    told = len(document.diagnostics)
    named, files = sensors(test), {}
    del document.diagnostics[told:]  # findings on sensors were noted with the modes
    return tuple(functions(test, named, files, units)), tuple(recordings(test, named, files, units))
