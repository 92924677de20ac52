"""Response function method (lecture 21): the loop of `mouse run` over frequency response functions, by the deck's own estimator."""

from mouse_cli.methods import FUNCTIONS, PARAMETERS, Method
from mouse_cli.methods.by_loop import by_loop
from mouse_cli.model.updated import KEPT, LOST, PARTLY

METHOD = Method(
    "response-function",
    "response function method",
    "dH/dp = -H (dK/dp + i w dC/dp - w^2 dM/dp) H line by line; T dp = dH by an estimator",
    "lecture 21",
    (
        (LOST, "the parameters may not be able to reproduce them, and the prior holds them back"),
        (KEPT, "a step to values without real frequencies is not taken"),
        (KEPT, "elements do not resist rigid motion, whatever their properties"),
        (KEPT, "the matrices are those of the same elements"),
        (PARTLY, "every number is a property; what the model left out is put into the wrong one"),
    ),
    (FUNCTIONS, PARAMETERS),
    by_loop,
)
