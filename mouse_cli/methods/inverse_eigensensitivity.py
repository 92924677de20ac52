"""Inverse eigensensitivity (lecture 21): the loop of `mouse run` over eigenvalues and shapes, by the deck's own estimator."""

from mouse_cli.methods import OWN, PARAMETERS, Method
from mouse_cli.methods.by_loop import by_loop
from mouse_cli.model.updated import KEPT, LOST, PARTLY

METHOD = Method(
    "inverse-eigensensitivity",
    "inverse eigensensitivity",
    "T dp = [d lambda, dx], d lambda = x'(dK - lambda dM)x, dx = sum_s x_s x_s'(dK - lambda dM)x / (lambda - lambda_s)",
    "lecture 21; section 3 of the 1972 report",
    (
        (LOST, "the parameters may not be able to reproduce them, and the prior holds them back"),
        (KEPT, "a step to values without real frequencies is not taken"),
        (KEPT, "elements do not resist rigid motion, whatever their properties"),
        (KEPT, "the matrices are those of the same elements"),
        (PARTLY, "every number is a property; what the model left out is put into the wrong one"),
    ),
    (OWN, PARAMETERS),
    by_loop,
)
