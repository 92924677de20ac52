"""Codes of files beside a deck (MD260-MD279): those of other programs."""

from mouse_cli.codes import Code

CODES = {
    "MD260": Code(
        "no such matrix in the file",
        "`variable` names a matrix of the file, and the file holds none of that name, or several whose names differ in case "
        "alone; or the format holds a single matrix without a name.",
        "Give one of the names in the message, or delete `variable`.",
    ),
    "MD261": Code(
        "optional package missing",
        "The format is read by a package that a plain installation does not bring.",
        "Install it with the command in the message.",
    ),
    "MD262": Code(
        "degrees of freedom do not fit",
        "The file names the degrees of freedom of its rows, and one of them is no degree of freedom of the model; or the map "
        "of the degrees of freedom has another length than the matrices; or names are given in two ways.",
        "Export all matrices from one model, with the same supports, and give the map that belongs to them.",
    ),
    "MD264": Code(
        "nodes without coordinates",
        "Some degrees of freedom are on nodes that `model.nodes` does not place. Programs add nodes of their own, which is "
        "harmless: no sensor is there. Where they are ordinary nodes, the file belongs to another model.",
        "Check that both files are of the same model.",
    ),
    "MD263": Code(
        "degree of freedom without stiffness or mass",
        "A degree of freedom of an imported model has a zero mass, which many programs write for rotations, and no stiffness "
        "either, or it couples to others by mass alone: nothing determines its motion.",
        "Constrain it in the program that wrote the matrices, or leave it out of the export.",
    ),
}
