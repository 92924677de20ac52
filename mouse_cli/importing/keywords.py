"""What each keyword of an Abaqus or CalculiX input means for K and M: read, passed on to the solver, without effect, or refused."""

READ = {
    "NODE", "ELEMENT", "NSET", "ELSET", "MATERIAL", "ELASTIC", "DENSITY", "SOLID SECTION", "SHELL SECTION", "BEAM SECTION",
    "MASS", "SPRING", "BOUNDARY", "STEP", "END STEP", "TRANSFORM",
}  # fmt: skip
TIES = {"EQUATION", "MPC", "COUPLING", "KINEMATIC", "DISTRIBUTING", "DISTRIBUTING COUPLING", "RIGID BODY", "TIE"}
PASSED = TIES | {"ORIENTATION", "SURFACE", "NORMAL"}
WITHOUT_EFFECT = {
    "HEADING", "AMPLITUDE", "EXPANSION", "CONDUCTIVITY", "SPECIFIC HEAT", "PLASTIC", "DAMPING", "CREEP", "PHYSICAL CONSTANTS",
    "NODE PRINT", "EL PRINT", "NODE FILE", "EL FILE", "NODE OUTPUT", "ELEMENT OUTPUT", "OUTPUT", "CONTACT FILE", "PREPRINT",
    "RESTART", "PRINT", "FILE FORMAT", "CLOAD", "DFLUX", "FILM", "RADIATE", "TIME POINTS", "DASHPOT",
    "FREQUENCY", "STATIC", "MODAL DAMPING", "MODAL DYNAMIC", "STEADY STATE DYNAMICS", "DYNAMIC", "BUCKLE", "CONTROLS",
    "DLOAD", "DSLOAD", "TEMPERATURE", "INITIAL CONDITIONS", "FIELD OUTPUT", "ENERGY OUTPUT", "SECTION PRINT", "MONITOR",
    "BASE MOTION", "CFLUX", "CONTACT PRINT", "CYCLIC HARDENING", "RATE DEPENDENT", "SENSITIVITY", "DESIGN RESPONSE",
    "DESIGN VARIABLES", "DESIGNVARIABLES", "FILTER", "HCF",
}  # fmt: skip
OPTIONS = {"REF NODE", "ROT NODE", "CONSTRAINT NAME", "NODAL THICKNESS", "POSITION TOLERANCE", "ENGINEERING CONSTANTS"}
REMEDIES = {
    "ROTARY INERTIA": "CalculiX has none: give the mass to several nodes of a *RIGID BODY",
    "CONTACT PAIR": "replace the contact by *TIE, or leave it out of a linear model",
    "GAP": "a gap has no stiffness of its own: replace it by a spring, or leave it out",
    "PARAMETER": "write numbers instead of parameters",
    "SYSTEM": "give the nodes in the global rectangular system",
    "HYPERELASTIC": "give *ELASTIC: the small vibration of the material",
    "SUBMODEL": "take the submodel's own supports",
}
RELEVANT = {  # cards of a step that make K another one than that of the model at rest
    "DLOAD": ("CENTRIF", "CORIO"),
}

NODES = {  # of each element that is read
    "C3D4": 4, "C3D6": 6, "C3D8": 8, "C3D8I": 8, "C3D8R": 8, "C3D10": 10, "C3D10T": 10, "C3D15": 15, "C3D20": 20,
    "C3D20R": 20, "S3": 3, "S4": 4, "S4R": 4, "S6": 6, "S8": 8, "S8R": 8, "B31": 2, "B31R": 2, "B32": 3, "B32R": 3,
    "SPRINGA": 2, "SPRING1": 1, "SPRING2": 2, "MASS": 1, "DASHPOTA": 2, "T3D2": 2, "T3D3": 3,
}  # fmt: skip
SHELLS = {"S3": 3, "S4": 4, "S4R": 4, "S6": 3, "S8": 4, "S8R": 4}  # corners of each
EXPANDED = ("S", "B", "T3D")  # elements that CalculiX expands into solids


def expanded(kind: str) -> bool:
    """Whether CalculiX makes solids of an element of this type.

    >>> expanded("S8R"), expanded("B31"), expanded("SPRING1"), expanded("C3D8")
    (True, True, False, False)
    """
    return kind.startswith(EXPANDED) and not kind.startswith("SPRING")


SECTIONS = {"SOLID SECTION": ("C3D", "T3D"), "SHELL SECTION": ("S3", "S4", "S6", "S8"), "BEAM SECTION": ("B31", "B32")}
WORDS = {  # boundary conditions that Abaqus has words for
    "PINNED": (1, 2, 3), "ENCASTRE": (1, 2, 3, 4, 5, 6), "XSYMM": (1, 5, 6), "YSYMM": (2, 4, 6), "ZSYMM": (3, 4, 5),
    "XASYMM": (2, 3, 4), "YASYMM": (1, 3, 5), "ZASYMM": (1, 2, 6),
}  # fmt: skip
