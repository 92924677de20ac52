"""MD46x and MD56x: methods of updating: what a deck lacks for one, and what an answer is not."""

from mouse_cli.codes import Code

CODES = {
    "MD460": Code(
        "unknown coupling",
        "`couplings` of a generic group names what may differ from zero beside the diagonal of k: k12 between the two ways of "
        "bending, k13 and k23 between these and torsion.",
        "Give some of k12, k13, k23, or leave the key out: a symmetric element has neither k12 nor k13.",
    ),
    "MD461": Code(
        "element in two generic groups",
        "Elements of a group have one stiffness; an element cannot have two.",
        "Give it to one group.",
    ),
    "MD462": Code(
        "element without a generic form",
        "A generic group names an element that is no beam, or a beam of Timoshenko's theory, whose mass matrix the generic "
        "element does not have.",
        "Name beams of Euler and Bernoulli, or give the beam `theory: generic`.",
    ),
    "MD560": Code(
        "mode without frequency or shape",
        "Methods that turn modes into matrices need both of every mode they use.",
        "Give both, hold the mode out, or use a method that fits frequencies alone, such as inverse-eigensensitivity.",
    ),
    "MD561": Code(
        "stiffness matrix that would be full",
        "The method leaves no zeros in K, and the model is too large for a full matrix to be stored and solved.",
        "Reduce the model, or take a method that keeps the pattern of the elements.",
    ),
    "MD562": Code(
        "data reproduced without a physical model",
        "The method changes single elements of K until the measured modes come out. Nothing in it knows of a structure: modes that "
        "were not measured, and the effect of any change of the structure, are what the arithmetic left.",
        "Trust it for the fitted modes alone. `mouse compare` shows its predictive error on held-out data.",
    ),
    "MD563": Code(
        "stiffness that is not definite",
        "The updated K has negative eigenvalues: frequencies that are imaginary. No structure that stands has them.",
        "Do not use this K; take a method that keeps definiteness.",
    ),
    "MD564": Code(
        "rigid-body modes lost",
        "The model could move as a rigid body without force, and after the update it cannot: the method has tied it to the ground.",
        "Give the rigid-body modes as constraints (kabe-rigid), or take a method that keeps them.",
    ),
    "MD565": Code(
        "update that did not settle",
        "Expanded shapes and stiffness take turns until neither changes; they had not settled when the iterations ended.",
        "Tie like elements together, give more or better shapes, or add the remaining change to the uncertainty.",
    ),
    "MD566": Code(
        "method without what it works on",
        "The method revises something that the deck does not have: parameters, beams with a generic stiffness, or measured "
        "frequency response functions.",
        "Add it to the deck, or choose another of `mouse list methods`.",
    ),
    "MD567": Code(
        "properties that equation error does not determine",
        "Some combination of the properties changes none of the forces of the measured modes.",
        "Tie like elements together, measure more modes, or hold some of the properties.",
    ),
    "MD570": Code(
        "method without an answer",
        "The linear algebra of the method fails on the numbers of this deck: values that span too many powers of ten, shapes that "
        "are zero or alike.",
        "Correct the values, or choose another of `mouse list methods`.",
    ),
    "MD568": Code(
        "measured modes not reproduced",
        "The frequency of a fitted mode differs from the test by more than three standard deviations.",
        "The properties that the method may change cannot explain the data: use `mouse diagnose`.",
    ),
    "MD569": Code(
        "held-out data not predicted",
        "Held-out data differ from their prediction by more than one per cent and three standard deviations.",
        "Do not use it beyond the fitted modes; find the missing physics with `mouse diagnose`.",
    ),
}
