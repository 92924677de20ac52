"""`test: frf:` of a YAML deck."""

from dataclasses import replace

import numpy as np

from mouse_cli._errors import ERROR
from mouse_cli.formats.channels import column
from mouse_cli.formats.frf_merge import merged
from mouse_cli.formats.frf_values import scaled, variance
from mouse_cli.formats.own_names import own_sensor
from mouse_cli.formats.record_drafts import FrfDraft
from mouse_cli.formats.recording_files import Contents, Function
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.channel_maps import Known, pairs, placed
from mouse_cli.formats.yaml_deck.frf_parts import Parts, gain_sd, listed, parts
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Document, Node
from mouse_cli.formats.yaml_deck.recordings import Files, contents, title
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.block_window import BlockWindow
from mouse_cli.model.frf_test import FORMS, MOST_LINES
from mouse_cli.model.units import Units

FREQUENCY_NAMES = ("f", "freq", "freqs", "frequency", "frequencies", "freq_hz", "f_hz", "frequency_hz", "hz")

Placed = tuple[SensorDraft, SensorDraft, Function]  # a function, with the sensors of its response and of its force


def functions(test: Section, named: list[SensorDraft], files: Files, units: Units) -> list[FrfDraft]:
    """The measurements that could be read; entries of one title are one, and each file is read once."""
    known = {sensor.name: sensor for sensor in named}
    found = [_entry(section, known, files, units) for section in test.listed("frf")]
    return merged([one for one in found if one is not None], test.document) if found else []


def _entry(section: Section, known: Known, files: Files, units: Units) -> FrfDraft | None:
    document, before = section.document, len(section.document.diagnostics)
    held = contents(section, files) if "file" in section else Contents()
    if held is None:
        return None
    lines = _own(section, held, known) if held.functions else _columns(section, held, known)
    if not lines or any(d.severity == ERROR for d in document.diagnostics[before:]):
        return None
    whole = _draft(section, lines, units)
    form, most = section.value("form", FORMS[0]), section.value("lines", MOST_LINES)
    return None if whole is None else replace(whole, form=form, lines=most, gain_sd=gain_sd(section) or 0.0)


def _own(section: Section, held: Contents, known: Known) -> list[Placed]:
    """Functions of a file that names response and force of each; `inputs` and `outputs` choose and rename."""
    chosen = {
        key: _renamed(section, key, known, {getattr(f, key[:-1]) for f in held.functions})
        for key in ("outputs", "inputs")
    }
    found = []
    for each in held.functions:
        output, force = (
            _sensor(section, key, chosen[key], name, known)
            for key, name in (("outputs", each.output), ("inputs", each.input))
        )
        if output is not None and force is not None:
            found.append((output, force, each))
    if not found and not section.document.incomplete:
        section.error("MD600", "chooses no function of the file", "correct inputs and outputs")
    return found


def _renamed(section: Section, key: str, known: Known, names: set[str]) -> dict[str, SensorDraft] | None:
    """Sensors by the names that the file has for them; None where all keep their names."""
    if key not in section:
        return None
    found = {}
    for sensor, item in pairs(section, key, known, "function"):
        node = item.nodes.get("value", item.node) if isinstance(item, Section) else item
        name = node.value if isinstance(node.value, str) else ""
        if name not in names:
            note = f"it names {', '.join(sorted(names)[:12])}"
            section.document.error(
                "MD600", node, f"the file has no function of '{name[:40]}'", "name one that is there", note
            )
        found[name] = sensor
    return found


def _sensor(
    section: Section, key: str, chosen: dict[str, SensorDraft] | None, name: str, known: Known
) -> SensorDraft | None:
    """The sensor that a file calls `name`."""
    if chosen is not None:
        return chosen.get(name)
    where = section.document.span(section.node)
    own = known.get(name) or own_sensor(name, where, f"sensor {name} of {section.called}")
    return own or SensorDraft(
        name, where, {int(name) if name.isdecimal() else name: 1.0}, words=f"sensor {name} of {section.called}"
    )


def _columns(section: Section, held: Contents, known: Known) -> list[Placed]:
    """Functions in channels of a file, or given in the deck."""
    document = section.document
    for key in ("inputs", "kind")[:1]:
        if key in section:
            section.wrong(
                key, "MD210", "names forces of a file that does not name any", "give input: the sensor of the force"
            )
    absent = [key for key in ("input", "outputs") if key not in section] + (
        [] if "file" in section or "frequency" in section else ["frequency"]
    )
    for key in absent:
        message = f"{section.what(key)} is missing"
        document.error("MD211", section.node, message, f"give {key}: {section.definition.keys[key].meaning}")
    if absent:
        return []
    force = placed(section, section.nodes["input"], section.what("input"), known)
    hz = _frequency(section, held)
    found = [(output, parts(section, item, held)) for output, item in pairs(section, "outputs", known, "function")]
    if force is None or hz is None or any(each is None for _, each in found):
        return []
    return [
        (output, force, Function(output.name, force.name, hz, each.values, coherence=each.coherence))
        for output, each in found
        if _fits(section, output, each, hz)
    ]


def _frequency(section: Section, held: Contents) -> np.ndarray | None:
    node, document = section.nodes.get("frequency"), section.document
    if node is not None:
        return listed(section, node, held, section.what("frequency"))
    own = [each for each in held.columns if each.name.strip().lower() in FREQUENCY_NAMES]
    found = own[0] if own else column(held, "1", document, document.span(section.node))
    return None if found is None else found.values.real


def _fits(section: Section, output: SensorDraft, each: Parts, hz: np.ndarray) -> bool:
    if len(each.values) == len(hz):
        return True
    message = f"the function of {output.name} has {len(each.values)} lines; there are {len(hz)} frequencies"
    section.document.error("MD608", section.node, message, "give one value for each frequency")
    return False


def _draft(section: Section, lines: list[Placed], units: Units) -> FrfDraft | None:
    """One measurement of all lines of an entry, in the units of the deck."""
    document, where = section.document, section.document.span(section.nodes.get("file", section.node))
    kind, spelled, averages = section.value("kind", ""), section.value("unit", ""), section.value("averages")
    relative, absolute = _accuracy(section)
    hz = lines[0][2].frequency_hz
    windows = {stated: _window(section, stated, hz) for stated in {line.window for _, _, line in lines}}
    found = []
    for output, force, line in lines:
        scale = scaled(kind, spelled, line.unit, line.kind, units, document, where)
        if scale is None:
            return None
        H = line.values * scale[1]
        each = variance(H, line.coherence, averages) if line.variance is None else line.variance * scale[1] ** 2
        if relative is not None or absolute is not None:
            each = 2 * ((absolute or 0.0) * scale[1] + (relative or 0.0) * np.abs(H)) ** 2
        coherence = None if line.coherence is None else line.coherence[:, None]
        shape = (len(H), 1, 1)
        found.append(FrfDraft(
            title(section), section.nodes["file"].value if "file" in section else "", scale[0], line.frequency_hz, H.reshape(shape),
            each.reshape(shape), (output,), (force,), coherence, where,
            decay_rate=section.value("decay_rate", line.decay_rate), window=windows[line.window],
        ))  # fmt: skip
    whole = merged(found, document)
    return _banded(section, whole[0]) if len(whole) == 1 else None


def _window(section: Section, stated: BlockWindow | None, hz: np.ndarray) -> BlockWindow | None:
    """The window that the deck states of functions at lines hz (f,), or the file, `stated`."""
    name = section.value("window", stated.name if stated else None)
    alone = [key for key in ("block", "burst") if key in section and name is None]
    if alone:
        section.wrong(
            alone[0], "MD215", "belongs to a window, which neither deck nor file states", "give window: hann, ..."
        )
    burst = section.value("burst", stated.burst if stated else 1.0)
    if burst > 1:
        section.wrong(
            "burst", "MD215", f"is {burst:g}; it must be between 0 and 1", "give the share of a block, such as 0.5"
        )
    if name is None or len(hz) < 2:
        return None
    spaced = (
        1 / float(np.median(np.diff(hz))) if (np.diff(hz) > 0).all() else 1.0
    )  # lines that do not ascend are an error
    seconds = section.value("block", stated.seconds if stated else spaced)
    if not seconds > 0:
        section.wrong("block", "MD215", f"is {seconds:g}; it must be positive", "give the length of a block in s")
        return None
    return BlockWindow(name, seconds, burst)


def _accuracy(section: Section) -> tuple[float | None, float | None]:
    """Relative and absolute standard deviation of each part; None where not given."""
    node = section.nodes.get("sd")
    if node is None:
        return None, None
    parts = node.value if yaml_values.is_list(node) else [node]
    relative = [yaml_values.as_percent(part) is not None for part in parts]
    if yaml_values.is_list(node) and sorted(relative) != [False, True]:
        text = "is a list of other values than a percentage and a number"
        section.wrong("sd", "MD215", text, "give a percentage of the magnitude and the floor of the noise, such as [3 %, 1e-4]")
        return None, None
    values = [yaml_values.share(section.document, part, section.what("sd"), KINDS["accuracy"].words) for part in parts]
    for value in values:
        if value is not None and not 0 < value < np.inf:
            section.wrong("sd", "MD215", f"is {value}; it must be positive and finite", "give what the repeats show")
    found = dict(zip(relative, values, strict=True))
    return found.get(True), found.get(False)


def _banded(section: Section, whole: FrfDraft) -> FrfDraft | None:
    """The lines of `band`, all without one."""
    node, document, what = section.nodes.get("band"), section.document, section.what("band")
    if node is None:
        return whole
    band = pair(document, node, what)
    if band is None:
        return None
    keep = (whole.frequency_hz >= band[0]) & (whole.frequency_hz <= band[1])
    if not keep.any():
        hz = whole.frequency_hz
        message = f"{what} [{band[0]:g}, {band[1]:g}] Hz holds no line; there are lines from {hz[0]:g} to {hz[-1]:g} Hz"
        return document.error("MD614", node, message, "give a band that holds lines")
    cut = {key: getattr(whole, key)[keep] for key in ("frequency_hz", "H", "variance")}
    return replace(whole, **cut, coherence=None if whole.coherence is None else whole.coherence[keep])


def pair(document: Document, node: Node, what: str) -> tuple[float, float] | None:
    """[lowest, highest]; None after an error."""
    found = yaml_values.numbers(document, node, what, KINDS["pair"].words)
    if found is not None and (len(found) != 2 or not found[0] <= found[1]):
        return yaml_values.mistyped(document, node, what, f"{KINDS['pair'].words}, ascending")
    return None if found is None else (float(found[0]), float(found[1]))
