"""Words that the sections of a diagnosis share."""

from mouse_cli.model.diagnosis import NAMED, Cause, Diagnosis, Explanation, Site, Size
from mouse_cli.model.units import Units


def probable(p: float) -> str:
    """A probability as people read it.

    >>> probable(0.98), probable(0.0042), probable(0.99999), probable(1e-9), probable(float("nan"))
    ('0.98', '0.004', '> 0.999', '< 0.001', '')
    """
    if p != p:
        return ""
    return "> 0.999" if p > 0.999 else "< 0.001" if p < 0.001 else f"{p:.2f}" if 0.01 <= p < 0.995 else f"{p:.3f}"


def with_p(p: float) -> str:
    """The same with its letter.

    >>> with_p(0.98), with_p(0.99999)
    ('P = 0.98', 'P > 0.999')
    """
    shown = probable(p)
    return f"P {shown}" if shown[:1] in "<>" else f"P = {shown}"


def nats(value: float) -> str:
    """A difference of logarithms, as finely as it means something.

    >>> nats(2649.17), nats(-0.0221), nats(95.2), nats(float("nan"))
    ('2649', '0.0', '95.2', '')
    """
    return (
        "" if value != value else f"{value:.0f}" if abs(value) >= 100 else f"{value + 0.0:.1f}".replace("-0.0", "0.0")
    )


def separation(value: float) -> str:
    """A predicted separation; what is far above the bar is not worth its digits.

    >>> separation(5.21), separation(1258.2), separation(0.0003)
    ('5.2', 'over 100', '0.0003')
    """
    return "over 100" if value > 100 else f"{value:.1f}" if value >= 0.95 else f"{value:.1g}"


def per_cent(value: float) -> str:
    """A difference in per cent to two digits that count.

    >>> per_cent(-11.6713), per_cent(0.0166), per_cent(float("nan"))
    ('-11.67', '0.017', '')
    """
    return "" if value != value else f"{value:.2f}" if abs(value) >= 0.1 else f"{value:.2g}"


def likeness(mac: float) -> str:
    """A MAC; blank where no shape was measured.

    >>> likeness(0.98931), likeness(0.99996), likeness(float("nan"))
    ('0.9893', '1.0000', '')
    """
    return "" if mac != mac else f"{mac:.4f}"


def place(site: Site) -> str:
    """A place in words.

    >>> place(Site("node", (3,), (1.0, 0.0, 0.0))), place(Site("dof", ("12TY",), text="degree of freedom 12TY"))
    ('node 3', 'degree of freedom 12TY')
    """
    return site.text or f"{site.kind} {', '.join(map(str, site.ids))}".strip()


def where(one: Explanation) -> str:
    """The places of an explanation."""
    return " and ".join(place(cause.site) for cause in one.causes)


def whereabouts(one: Explanation, units: Units) -> str:
    """The same with coordinates, and other places that hold a share of the probability.

    >>> mass = Cause("mass", "mass", "a mass", Site("node", (3,), (1.0, 0.5, 0.0)), ())
    >>> whereabouts(Explanation((mass,), 1, 1, 1, 0, None, 1.0, (((Site("node", (7,)),), 0.12),)), Units("mm", "t", "N"))
    'node 3 at (1, 0.5, 0) mm; or, to 12 %, node 7'
    """
    first = " and ".join(f"{place(cause.site)}{_at(cause.site, units)}" for cause in one.causes)
    others = [f"; or, to {100 * share:.0f} %, {' and '.join(map(place, sites))}" for sites, share in one.elsewhere]
    return "".join([first, *others])


def _at(site: Site, units: Units) -> str:
    if site.position is None:
        return ""
    unit = f" {units.of('m')}" if units.declared else ""
    return f" at ({', '.join(f'{x + 0.0:.4g}' for x in site.position)}){unit}"


def sized(cause: Cause) -> str:
    """Its parameters with their standard deviations, and the law by which its spring loses energy."""
    law = f"; its damping is {cause.law}" if cause.law else ""
    return (", ".join(_size(size) for size in cause.sizes) or "nothing to be sized") + law


def _size(size: Size) -> str:
    unit = "" if size.unit in ("", "1") else f" {size.unit}"
    edge = "" if size.lower * 1.001 < size.value < size.upper * 0.999 else ", at the end of the range held possible"
    return f"{size.name} {size.value:.4g}{unit} (sd {size.sd:.2g}{edge})"


def nats_over_none(found: Diagnosis, one: Explanation) -> float:
    """ln of the evidence for an explanation over that for no cause."""
    baseline = found.baseline
    return float("nan") if baseline is None else float(one.log_evidence - baseline.log_evidence)


def standing(found: Diagnosis) -> list[Explanation]:
    """The explanation named, or the first of each group that is left, none among them."""
    if found.kind == NAMED:
        return [found.best]
    return [next(one for one in found.explanations if one.group == name) for name, _ in found.rivals]


def leaders(found: Diagnosis) -> list[Explanation]:
    """The same without none."""
    return [one for one in standing(found) if one.causes]


def with_cause(found: Diagnosis) -> str:
    """How the model with a cause is called at the head of a column."""
    return "extended model" if found.kind == NAMED or found.best is None else f"with {found.best.title}"
