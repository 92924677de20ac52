"""Point mass with rotary inertia about the global axes."""

import numpy as np

from mouse_cli.terms.elements import ElementType, Layout, Matrices, Properties, Property

_INERTIA = ("Jx", "Jy", "Jz")


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """M = diag(m, m, m, Jx, Jy, Jz)."""
    values = [properties["mass"]] * 3 + [properties[name] for name in _INERTIA]
    M = np.zeros((len(layout), 6, 6), np.result_type(*values))
    M[:, range(6), range(6)] = np.stack(values, axis=1)
    return {"M": M}


ELEMENT = ElementType(
    "mass",
    "point mass with rotary inertia",
    (1,),
    {
        "mass": Property("mass", "kg", or_zero=True),
        **{name: Property(f"moment of inertia about global {name[1].upper()}", "kg m2", 0.0) for name in _INERTIA},
    },
    matrices,
    damping=("mass_damping",),
)
