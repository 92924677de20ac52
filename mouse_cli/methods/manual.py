"""The reference of the methods, made of what each says of itself."""

from mouse_cli._texts import capital
from mouse_cli.methods import Method, registry


def manual() -> str:
    """Every method with its equation, source and guarantees, in Markdown."""
    lines = [
        "# Methods of updating",
        "",
        "`mouse run --method METHOD` updates a model by one of them, `mouse compare` by all that serve the deck. Guarantees hold",
        "for any data; `in part` says on what they depend.",
        "",
    ]
    for key, method in registry().items():
        lines += [f"## {key}", "", about(method), ""]
    return "\n".join(lines)


def about(method: Method) -> str:
    """One method, in Markdown."""
    own = method.about
    lines = [f"{capital(own.title)}: {own.source}.", "", f"    {own.equation}", ""]
    lines += ["| what a structure has | guaranteed | because |", "|---|---|---|"]
    lines += [f"| {g.aspect} | {g.given} | {_cell(g.why)} |" for g in own.guarantees]
    return "\n".join([*lines, "", f"Needs: {', '.join(_NEEDS[need] for need in method.needs)}."])


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


_NEEDS = {
    "modes": "measured modes",
    "shapes": "measured modes with shapes, all of them",
    "functions": "measured frequency response functions",
    "elements": "beams of Euler and Bernoulli, or generic ones",
    "parameters": "parameters with an sd",
}
