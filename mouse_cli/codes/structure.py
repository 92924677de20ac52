"""MD4xx: structures made of nodes and elements, and the parameters that are their properties."""

from mouse_cli.codes import Code

CODES = {
    "MD401": Code(
        "no such node",
        "An element, a support or a rigid link names a node that `nodes` does not give.",
        "Correct the number, or give the node.",
    ),
    "MD402": Code(
        "no such material or section",
        "An element or a parameter names a material or a cross section that is not there, or that no element is made of.",
        "Correct the name; the message gives the nearest one.",
    ),
    "MD403": Code(
        "no such element",
        "A parameter names an element that is not there.",
        "Correct the number, or give the element that number.",
    ),
    "MD404": Code(
        "number given twice",
        "Two nodes, or two elements, have the same number, so that nothing could name one of them.",
        "Give each its own number.",
    ),
    "MD405": Code(
        "property missing",
        "An element needs a property that neither the element nor its material nor its section gives.",
        "Give the property, or name a material or section that has it.",
    ),
    "MD407": Code(
        "nodes that do not make these elements",
        "A type of element has a certain number of nodes. A range or plain list of nodes is a chain, which has one node more than "
        "elements; for elements at single nodes it has as many.",
        "Give as many nodes as the type needs, and as many numbers as there are elements.",
    ),
    "MD408": Code(
        "impossible shape or axes",
        "A dimension of a cross section is not positive, or its walls do not fit within it; or two vectors span no plane.",
        "Correct the numbers.",
    ),
    "MD409": Code(
        "impossible range",
        "A range such as 9-3 goes down, or stands for more numbers than any model has.",
        "Give the lower number first.",
    ),
    "MD410": Code(
        "node that nothing holds",
        "No element, rigid link or matrix gives the node stiffness, so it is not part of the model.",
        "Join it to an element, or leave it out.",
    ),
    "MD411": Code(
        "element without length",
        "Both ends of an element that has a length are at the same point.",
        "Move a node, mend an offset, or use a spring or joint, which need no length.",
    ),
    "MD412": Code(
        "orientation along the element",
        "The vector that turns an element about its axis is parallel to it, and so turns nothing.",
        "Give a vector that is not parallel to the element.",
    ),
    "MD413": Code(
        "parameter without its property",
        "A parameter names a property that its elements do not have, or that none of them takes from that material or section.",
        "Correct the name of the property, or name the elements that have it.",
    ),
    "MD414": Code(
        "factor of zero",
        "A parameter multiplies a property that is zero in all its elements: no value of it would change anything.",
        "Leave `factor` out and give the standard deviation as a number, or give the elements a value.",
    ),
    "MD415": Code(
        "property with two values",
        "Two parameters are the value of one property of the same element. Only one can be; factors may come on top.",
        "Give the element to one of the two, or make one `factor: true`.",
    ),
    "MD416": Code(
        "rigid link to itself",
        "A rigid link names one node as leading and following.",
        "Name another independent node.",
    ),
    "MD417": Code(
        "directions held twice",
        "A direction of a node is to follow two others, or follows one and is supported, or links go round in a circle.",
        "Support the independent node, or take the direction out of a link.",
    ),
    "MD418": Code(
        "mechanism",
        "Parts of the structure can move against each other without any stiffness to resist. Whole structures may be free.",
        "Add the stiffness that is missing, or a support. Releases, and springs without rotational stiffness, are usual causes.",
    ),
    "MD419": Code(
        "table that cannot be read",
        "A table of nodes or elements has a line that is not a row of numbers separated by commas, or too few columns.",
        "Give id,x,y,z for nodes; id, nodes and properties that its first line names for elements.",
    ),
    "MD420": Code(
        "parameter of elements, incomplete",
        "A parameter that is a property of elements needs `property` and one of `elements`, `material` and `section`; it cannot "
        "move a matrix as well, and there must be a structure.",
        "Give what is missing, or make two parameters of it.",
    ),
    "MD421": Code(
        "released so that it moves by itself",
        "The releases of an element leave it free to move between its nodes.",
        "Keep each local direction at one end at least.",
    ),
    "MD422": Code(
        "weight without a way to the ground",
        "With `gravity`, the axial forces follow from the weights; some weight gets to no support, or in more than one way that "
        "the elements do not determine.",
        "Support the structure, or give axial forces as `preload` and leave `gravity` out.",
    ),
    "MD423": Code(
        "directions or parts to know of",
        "A part of the structure may move freely, or a direction has mass and no stiffness and was left out. Both may be meant.",
        "Check that it is meant; else add an element or a support.",
    ),
    "MD424": Code(
        "nothing can move",
        "Supports and kept directions leave the structure no degree of freedom.",
        "Take supports away, or keep more directions.",
    ),
    "MD425": Code(
        "impossible value of a property",
        "A property of an element is not finite, or not positive where it must be.",
        "Correct the value, at the element or at the material or section that it comes from.",
    ),
    "MD426": Code(
        "a beam in space without a constant of its section",
        "Without J a beam does not resist torsion, without Iy or Iz it does not bend in that plane; directions that nothing "
        "stiffens are left out of the model without a further word.",
        "Give the constant, or a shape of the section, from which it follows; or keep the directions of a plane alone.",
    ),
}
