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
        "Some degrees of freedom are on nodes that `model.nodes` does not define. Programs add nodes of their own, which is "
        "harmless: no sensor is there. Where they are ordinary nodes, the file belongs to another model.",
        "Check that both files are of the same model.",
    ),
    "MD263": Code(
        "degree of freedom without stiffness or mass",
        "A degree of freedom of an imported model has a zero mass, which many programs write for rotations, and no stiffness "
        "either, or it couples to others by mass alone: nothing determines its motion.",
        "Constrain it in the program that wrote the matrices, or leave it out of the export.",
    ),
    "MD265": Code(
        "input of a solver that cannot be read",
        "A line of the input file is not what its keyword expects: a word that is no number, an element with too few nodes, a "
        "name given twice.",
        "Mend the line in the message.",
    ),
    "MD266": Code(
        "missing include",
        "*INCLUDE of keywords, or INCLUDE of bulk data, names a file that stands neither beside the file that names it nor beside "
        "the job.",
        "Put the file there, or mend the name.",
    ),
    "MD267": Code(
        "cyclic include",
        "A file includes itself, directly or by way of others.",
        "Take one of the lines of the chain in the message out.",
    ),
    "MD268": Code(
        "keyword that changes K or M",
        "The input has a keyword, or an option, that changes stiffness or mass in a way that is not read. An import without it "
        "would be another model.",
        "Replace it as the message says. What has no effect on K and M is passed over, and listed by `mouse import`.",
    ),
    "MD269": Code(
        "type of element that is not read",
        "CalculiX could not take the element, or its K and M could not be divided by element sets.",
        "Use one of the types in the message.",
    ),
    "MD270": Code(
        "sections that overlap",
        "Two sections claim one element, a section is for elements of another type, or the element sets divide the model into too "
        "many groups. The solver would take one of the sections in silence.",
        "Give every element one section.",
    ),
    "MD271": Code(
        "material or section missing",
        "An element has no section, a section no material, or a material no *ELASTIC or *DENSITY. As a warning: a material that no "
        "section names.",
        "Complete the input.",
    ),
    "MD272": Code(
        "unknown node, element or set",
        "The input names a node, an element or a set that it does not define above that line.",
        "Mend the name, or define it first.",
    ),
    "MD273": Code(
        "support that cannot be imported",
        "A boundary condition holds rotations of beams, or of shells where they meet or are oblique, which CalculiX makes solids "
        "of and stiffens at such nodes; or a node that a constraint determines; or a direction that is none. As a warning: two "
        "supports hold the same node.",
        "Hold translations, of two rows of nodes for a clamp; hold the reference node of a constraint.",
    ),
    "MD274": Code(
        "solver failed",
        "CalculiX (ccx) is not on the path, or stopped with the error in the message. As a warning: it passed over an option of a "
        "keyword, which may be one that K or M depend on.",
        "Install it, or run the job in it and mend what it objects to.",
    ),
    "MD275": Code(
        "import does not agree with the solver",
        "The matrices of the element sets do not sum to those of the whole, or the imported model on its supports has not the "
        "frequencies that CalculiX finds for the job as it was written. Nothing was written. As a warning: shells, such as curved "
        "ones, do not go by powers of their thickness, and the deck has none for them; or S6, S8 and S8R of several sets meet at "
        "an angle or change their thickness, where CalculiX is softer without one of the sets than K less the K of that set.",
        "Import parts of the model to find which keyword acts otherwise than it is read, and report it.",
    ),
    "MD276": Code(
        "supports or sets of imported matrices",
        "A support names degrees of freedom that the matrices have not, two supports hold the same one, or a set gives neither "
        "stiffness nor mass. As a warning of `mouse import`: which units the job was taken to be in, materials whose E and density "
        "are those of none in these units, and sets that give nothing.",
        "Mend the names, or the constants; give --units.",
    ),
}
