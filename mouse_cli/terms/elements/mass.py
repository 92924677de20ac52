"""Point mass with rotary inertia about the global axes, at its node or off it."""

import numpy as np

from mouse_cli.terms.elements import VECTOR, ElementType, Layout, Matrices, Option, Properties, Property
from mouse_cli.terms.elements._axes import arm

INERTIA = ("Jx", "Jy", "Jz")
PRODUCTS = {"Jxy": (3, 4), "Jxz": (3, 5), "Jyz": (4, 5)}  # and where they stand in M, with a minus


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """M = T' diag(m, m, m, J) T, T the rigid arm from the node to the mass, J about axes through the mass."""
    values = [properties["mass"]] * 3 + [properties[name] for name in INERTIA]
    products = {at: properties[name] for name, at in PRODUCTS.items()}
    M = np.zeros((len(layout), 6, 6), np.result_type(*values, *products.values()))
    M[:, range(6), range(6)] = np.stack(values, axis=1)
    for (i, j), value in products.items():
        M[:, i, j] = M[:, j, i] = -value
    offset = layout.options.get("offset")
    if offset is not None:
        T = arm(np.asarray(offset, float))
        M = T.T @ M @ T
    return {"M": M}


ELEMENT = ElementType(
    "mass",
    "point mass with rotary inertia",
    (1,),
    {
        "mass": Property("mass", "kg", or_zero=True),
        **{name: Property(f"moment of inertia about global {name[1].upper()}", "kg m2", 0.0) for name in INERTIA},
        **{
            name: Property(f"product of inertia, the integral of {name[1]} {name[2]} dm", "kg m2", 0.0)
            for name in PRODUCTS
        },
    },
    matrices,
    {"offset": Option("global vector in m from the node to the mass, about which its inertia is", None, form=VECTOR)},
    damping=("mass_damping",),
)
