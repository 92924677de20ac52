"""Words that the sections of a diagnosis share."""

from mouse_cli.model.diagnosis import Cause, Diagnosis, Explanation, Site, Size


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


def place(site: Site) -> str:
    """A place in words.

    >>> place(Site("node", (3,), (1.0, 0.0, 0.0))), place(Site("dof", ("12TY",), text="degree of freedom 12TY"))
    ('node 3', 'degree of freedom 12TY')
    """
    return site.text or f"{site.kind} {', '.join(map(str, site.ids))}".strip()


def where(one: Explanation) -> str:
    """The places of an explanation."""
    return " and ".join(place(cause.site) for cause in one.causes)


def sized(cause: Cause) -> str:
    """Its parameters with their standard deviations."""
    return ", ".join(_size(size) for size in cause.sizes) or "nothing to be sized"


def _size(size: Size) -> str:
    unit = "" if size.unit in ("", "1") else f" {size.unit}"
    edge = "" if size.lower * 1.001 < size.value < size.upper * 0.999 else ", at the end of the range held possible"
    return f"{size.name} {size.value:.4g}{unit} (sd {size.sd:.2g}{edge})"


def nats_over_none(found: Diagnosis, one: Explanation) -> float:
    """ln of the evidence for an explanation over that for no cause."""
    baseline = found.baseline
    return float("nan") if baseline is None else float(one.log_evidence - baseline.log_evidence)
