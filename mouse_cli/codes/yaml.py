"""Codes of YAML decks (MD200-MD249) and of matrix files (MD250-MD299)."""

from mouse_cli.codes import Code

CODES = {
    "MD200": Code(
        "not text",
        "A deck in YAML is UTF-8 text. A byte that is not UTF-8, or a control character, stands in it; "
        "often the file "
        "was saved in another encoding, or is no deck at all.",
        "Save the deck as UTF-8 without control characters.",
    ),
    "MD201": Code(
        "not YAML, or not readable",
        "The text does not follow the rules of YAML here, or the file could not be opened. The "
        "cause is often "
        "a line above: a bracket that was not closed, a missing comma, a colon without a blank after it.",
        "Check brackets, commas, colons and indentation (blanks, no tabs) here and above.",
    ),
    "MD202": Code(
        "beyond the limits of a deck",
        "The deck is larger, or nested deeper, than any deck needs; or its aliases (*name) stand for more "
        "values than "
        "memory holds. The limits keep a damaged or hostile file from exhausting the machine.",
        "Put large matrices in files: {file: k.mtx}; close open brackets; write aliases out.",
    ),
    "MD203": Code(
        "tag",
        "YAML tags (!!python/object, !include, ...) are not read: the key determines the type of its value.",
        "Delete the tag.",
    ),
    "MD204": Code(
        "several documents",
        "A line '---' begins a second document. One file holds one deck.",
        "Write each deck to its own file.",
    ),
    "MD205": Code(
        "no keys",
        "The deck is empty, or holds a list or a single value where keys such as 'model:' were expected.",
        "Begin the deck with 'mouse: 1', 'title:' and 'model:'.",
    ),
    "MD207": Code(
        "key given twice",
        "The same key stands twice in one mapping. YAML would silently let the last one win.",
        "Delete one of the two.",
    ),
    "MD210": Code(
        "unknown key",
        "The key is not one of those that this section has. It would be without effect, which is never what was meant.",
        "Correct the spelling; the message names the nearest key. `mouse explain schema` lists all.",
    ),
    "MD211": Code(
        "missing key",
        "A key that this section needs was not given, or was given without a value.",
        "Give the key.",
    ),
    "MD213": Code(
        "wrong kind of value",
        "The value is not of the kind that its key expects, for instance a word for a number or a number "
        "for a list. "
        "Numbers in quotes are text; FORTRAN's exponent letter D is not read.",
        "Give a value of the kind that the message names.",
    ),
    "MD214": Code(
        "not one of the choices",
        "The key allows only certain words or numbers, and this is none of them.",
        "Give one of those that the message lists.",
    ),
    "MD215": Code(
        "number outside its limits",
        "The number cannot be meant: a version that does not exist, an order below 1 or beyond a million, "
        "a negative count.",
        "Give a number within the limits that the message names.",
    ),
    "MD216": Code(
        "wrong count",
        "A list has more or fewer values than another part of the deck requires. Shapes have one row for "
        "each of dofs "
        "and one column for each mode.",
        "Give as many values as the message states.",
    ),
    "MD217": Code(
        "no form, or several forms",
        "A matrix is given as entries with order, dense, diagonal, identity or file, and the prior as "
        "correlation, "
        "correlations or covariance: exactly one of them.",
        "Give one form.",
    ),
    "MD220": Code(
        "stiffness and mass of different order",
        "K and M describe the same degrees of freedom, so they have the same number of rows.",
        "Give both matrices the same order.",
    ),
    "MD221": Code(
        "matrix not symmetric",
        "K and M are symmetric, but an element and its mirror image differ by more than rounding.",
        "Make the two equal.",
    ),
    "MD222": Code(
        "element not listed",
        "`elements:` lists the varying elements, but a parameter moves one that it does not list.",
        "Add the element to the list, or leave the list out.",
    ),
    "MD223": Code(
        "percentage of nothing",
        "A standard deviation is given as a percentage of a value that is 0.",
        "Give the standard deviation as a number, or give the nominal value.",
    ),
    "MD224": Code(
        "standard deviation missing or given twice",
        "A parameter needs a prior standard deviation: how far its value may be from the nominal one. It "
        "comes from sd "
        "or from the diagonal of prior.covariance; when both are given and differ, the covariance is used.",
        "Give sd, or prior.covariance; sd: 0 holds the parameter at its nominal value.",
    ),
    "MD225": Code(
        "unknown label",
        "A degree of freedom is named by a label that the model does not have.",
        "Give its number, counted from 1, or one of model.labels.",
    ),
    "MD226": Code(
        "label given twice",
        "Two degrees of freedom have the same label, so it names neither.",
        "Give each degree of freedom its own name.",
    ),
    "MD228": Code(
        "decimal comma",
        "In a list, a comma parts two values: 94,343 is 94 and 343. A list that has such a pair, blanks after other commas, and "
        "values that do not ascend was meant otherwise.",
        "Write decimal points.",
    ),
    "MD227": Code(
        "shapes turned",
        "The list has one row for each mode, where one row for each degree of freedom was expected. As "
        "the counts "
        "differ there is no ambiguity, and it was read transposed. With as many modes as sensors it could not be "
        "noticed.",
        "Write one row for each of dofs, one column for each mode, as Table 5-3 prints the modal matrix.",
    ),
    "MD229": Code(
        "unknown parameter",
        "A correlation names a parameter that the deck does not have.",
        "Give names as they stand under parameters.",
    ),
    "MD230": Code(
        "impossible correlation",
        "Correlations lie within -1 to 1, that of a parameter with itself is 1, and each pair is given once.",
        "Give correlations, not covariances; a covariance matrix goes under prior.covariance.",
    ),
    "MD231": Code(
        "file outside the folder of the deck",
        "A deck, a manifest or a job to import may name only files in its own folder or below, so that one from elsewhere reads "
        "nothing else. "
        "Absolute paths, '..' and links out of it are refused; so are links out of a folder in which decks were "
        "searched.",
        "Put the file beside the deck and give its name alone; or, where you know what the deck reads, allow it: "
        "`--allow-outside`.",
    ),
    "MD232": Code(
        "not a power of that parameter",
        "A parameter with power_of is another one to an exponent: the other has transform: log, stays positive, and says "
        "nominal value, sd and limits of both.",
        "Give the other transform: log, an exponent within -10 to 10 that is not 0, and delete what follows from it.",
    ),
    "MD250": Code(
        "matrix file missing",
        "The file does not exist, is not a regular file, or cannot be read. Paths are relative to the deck.",
        "Check the name and the permissions.",
    ),
    "MD251": Code(
        "unknown matrix format",
        "The suffix determines the format; the message lists those that are read, "
        "and the how-to `Models from other programs` has details.",
        "Convert the file to one of these.",
    ),
    "MD252": Code(
        "damaged matrix file",
        "The file does not hold what its format demands: a wrong first line, fewer entries than promised "
        "(truncated), "
        "a row of another length, a word where a number should be.",
        "Write the file again.",
    ),
    "MD253": Code(
        "matrix not real",
        "The file holds complex numbers, a bare pattern, text or objects. K and M are real.",
        "Write real numbers.",
    ),
    "MD254": Code(
        "matrix not square",
        "K and M, and the parts of them that parameters move, have as many rows as columns.",
        "Write all rows and columns.",
    ),
    "MD255": Code(
        "matrix file not symmetric",
        "An element and its mirror image differ by more than rounding, or the file declares it "
        "skew-symmetric or "
        "Hermitian. Perhaps only one triangle was written under the word 'general'.",
        "Write both triangles; in Matrix Market, or the lower triangle and the word 'symmetric'.",
    ),
    "MD256": Code(
        "matrix file holds NaN or infinity",
        "K and M consist of finite numbers.",
        "Find out why the program that wrote the file had none, and write it again.",
    ),
    "MD257": Code(
        "matrix file of another order",
        "The matrix has another number of rows than the model that it belongs to.",
        "Give a matrix of the order of the model.",
    ),
    "MD258": Code(
        "matrix file too large",
        "The file, or what it unpacks to, takes more than half of the memory that there is; or it promises more rows, columns or "
        "channels than are read. Orders up to a million are read. Memory is that of the machine, its group, or `ulimit -v`.",
        "Condense the model, divide the recording, or take a machine with more memory.",
    ),
    "MD259": Code(
        "several arrays",
        "The file holds several matrices and none is selected; or it holds none.",
        "Name it: {file: ..., variable: NAME}.",
    ),
    "MD290": Code(
        "file not written",
        "The file could not be written: a missing folder, no permission, a full disk. What stood there "
        "before is untouched.",
        "Check the folder, its permissions and the free space.",
    ),
}
