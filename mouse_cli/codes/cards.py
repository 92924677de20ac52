"""MD100 to MD199: what can be wrong with a card deck as such."""

from mouse_cli.codes import Code

CODES = {
    "MD100": Code(
        "The deck ends too early",
        "All twelve groups are always present, in order. A group read by INPUT (6, 7, 9, 11 and "
        "12) ends with its own blank card, and so does the last one of the deck. A missing blank "
        "card makes two groups one, and the last is then missing.",
        "Look for a missing blank card before the group named, and add the blank card at the end of the deck.",
    ),
    "MD101": Code(
        "A field cannot be read",
        "The columns of the field do not hold a number that FORTRAN would read: `I` fields take a"
        " sign and digits; `E` fields take digits, a point, and an exponent written E5, E+05, D5 "
        "or +05. A blank after an exponent is refused because it would multiply the exponent by "
        "ten.",
        "Retype the number inside its columns, right justified.",
    ),
    "MD102": Code(
        "Text beyond column 80",
        "A card has 80 columns. The 1972 reader did not see what stands after them.",
        "Delete it, or move it to its columns.",
    ),
    "MD103": Code(
        "A character that no card can hold",
        "A card holds printable ASCII, one character a column. A tab would shift the columns by an unknown amount.",
        "Replace tabs with blanks and retype other characters.",
    ),
    "MD104": Code(
        "A control integer is out of range or conflicts with another",
        "The second card holds ten integers in fields of eight columns. A blank inside or after a"
        " number is the digit zero, so a 4 punched one column early reads 40. ITERMX and NPARD "
        "below 1 are refused (taken as 1 under --legacy).",
        "Right justify the integer in its eight columns; check it against the groups that it counts.",
    ),
    "MD105": Code(
        "Sequence numbers in columns 73-80",
        "All 80 columns of these cards are data. Card numbers there would be read as NPARD, as a "
        "mode number, or as the end of a measured value, in silence.",
        "Blank the columns with --strip-73-80, and give NPARD and what else stood there.",
    ),
    "MD106": Code(
        "The heading holds a character that cannot be punched",
        "The heading is free text of printable ASCII. Other characters become a question mark.",
        "Use plain ASCII in the heading.",
    ),
    "MD107": Code(
        "A field past the end of a list is not blank",
        "A count on the control card states how many values a list has. Fields after the last one "
        "would be ignored by FORTRAN in silence; something in them means that the count or the "
        "columns are wrong.",
        "Blank the field, or mend the count (NM, NRS, IROW) on the control card.",
    ),
    "MD108": Code(
        "The pair 0 0 of group 4 is missing or repeated",
        "Group 4 is one list of NRS+1 pairs: stiffness elements, one pair 0 0, mass elements. "
        "Without mass elements the pair comes last, and a blank field serves; without stiffness "
        "elements it comes first.",
        "Give NRS pairs and one pair 0 0, or mend NRS.",
    ),
    "MD109": Code(
        "INDIC does not hold IROW positions, or does not end where it must",
        "Cards of twenty positions are read until a 20th value is zero, or seven cards have been "
        "read. With IROW = 20, 40, ... 120 a blank card must follow.",
        "Punch IROW positions without gaps, and the blank card where it is needed.",
    ),
    "MD110": Code(
        "An element lies outside its matrix",
        "The indices of an INPUT element are two fields of three columns, right justified: "
        "trailing blanks are zeros. An element that would fit the next matrix means that the "
        "blank card between the two groups is missing.",
        "Right justify the indices, or insert the missing blank card.",
    ),
    "MD111": Code(
        "An element without indices",
        "A value stands in an element whose row or column is zero or blank. When the whole card "
        "reads as one of the next group, the blank card that ends this group is missing.",
        "Give both indices, or insert the missing blank card.",
    ),
    "MD112": Code(
        "An element is given twice",
        "Whether the first, the last or the sum was meant cannot be known. In M and K an element "
        "and its mirror image are one element. Equal values are only a warning.",
        "Delete one of the two, or insert a missing blank card.",
    ),
    "MD113": Code(
        "A component of a test eigenvector is not punched",
        "Card decks have no mark for a missing datum: what is not punched at a position of INDIC is a measured zero.",
        "Punch the component; convert the deck to YAML if it was not measured.",
    ),
    "MD114": Code(
        "The first element of a card is empty",
        "Only a wholly blank card ends a group here. A reader that looks at the first row index "
        "alone would end it earlier.",
        "Start each card with its first element.",
    ),
    "MD115": Code(
        "A card of zeros ends a group",
        "A blank field is a zero, so a card of zeros is a blank card.",
        "Use a blank card.",
    ),
    "MD116": Code(
        "A matrix has no elements",
        "A, M or K ended before its first element: there is a blank card too many, and what follows belongs to it.",
        "Delete the blank card.",
    ),
    "MD117": Code(
        "The rows of the test eigenvectors can be read in two ways",
        "The row of X is a degree of freedom of INDIC. It is read as a position in INDIC (1 to "
        "IROW) only when no other reading is possible.",
        "Punch the degree of freedom in the row field.",
    ),
    "MD118": Code(
        "The columns of the test eigenvectors are not 1 to NM",
        "The column of X is the position of the mode in MODE. System mode numbers are accepted "
        "with a warning when all columns are in MODE; all rows within NM suggest that X was "
        "transposed.",
        "Punch the degree of freedom first, then the position of the mode.",
    ),
    "MD119": Code(
        "A test eigenvector has a component outside INDIC",
        "The test eigenvectors are known at the degrees of freedom listed in INDIC, and nowhere else.",
        "Add the degree of freedom to INDIC, or delete the component.",
    ),
    "MD120": Code(
        "VAR runs on",
        "VAR is one list of NM(1+IROW) values, five a card. The eigenvector values follow the "
        "frequencies on the same card.",
        "Punch the list without a break, or mend NM and IROW.",
    ),
    "MD121": Code(
        "A limit of the 1972 program is exceeded",
        "The program held 140 degrees of freedom, 140 properties, 140 variable elements, 140 "
        "positions and 10 modes. The limits are errors under --legacy only.",
        "Nothing, unless the old program is to read the deck.",
    ),
    "MD122": Code(
        "COV has an element off the diagonal",
        "Group 6 holds standard deviations of uncorrelated properties. The manual announces "
        "correlation for a later edition without giving a form.",
        "Delete the element; give correlated properties in a YAML deck.",
    ),
    "MD123": Code(
        "The mass matrix is not diagonal",
        "The 1972 program was restricted to a diagonal mass matrix; --legacy keeps that rule.",
        "Read the deck without --legacy.",
    ),
    "MD124": Code(
        "A real number without a decimal point",
        "The last d digits of an Ew.d field are then the fraction, also when an exponent is "
        "punched: 85000 under E14.8 is 0.00085.",
        "Punch the decimal point.",
    ),
    "MD125": Code(
        "Blanks after an integer",
        "A blank after a digit is a zero: each one multiplies the number by ten.",
        "Right justify the number.",
    ),
    "MD126": Code(
        "A blank inside a number",
        "A blank between two digits is a zero: `1 2.5` is 102.5.",
        "Close the gap, or punch the zero.",
    ),
    "MD127": Code(
        "A value was lost with columns 73-80",
        "--strip-73-80 blanks eight columns that hold data on every card: NPARD, MODE(10), the "
        "tenth pair of RS, two positions of INDIC and the end of the last number of other cards.",
        "Give the value otherwise, or remove the card numbers from the deck by hand.",
    ),
    "MD128": Code(
        "Too many errors",
        "Reading stopped, since so many errors usually have one reason.",
        "Mend the first few and read the deck again.",
    ),
    "MD129": Code(
        "Cards after the end of the deck",
        "After the blank card of group 12 only blank cards may follow, unless stacked cases are asked for.",
        "Delete the cards, look for a blank card too many, or read with --stacked.",
    ),
    "MD130": Code(
        "A value is given for a field that the deck does not have",
        "Values may replace fields by name: a control integer such as NPARD, or an item of a list such as MODE(10).",
        "Use a name that `mouse show` prints for the deck.",
    ),
    "MD140": Code(
        "Cards need a modal test",
        "Groups 3, 5, 8, 9 and 10 are always present in a card deck.",
        "Keep the deck in YAML.",
    ),
    "MD141": Code(
        "Cards hold no prior values",
        "A card deck knows only the changes of the properties; there is no card for their values.",
        "Keep the deck in YAML, or set the nominal values to 0.",
    ),
    "MD142": Code(
        "Cards hold no limits",
        "A card deck cannot restrain a property.",
        "Keep the deck in YAML, or drop the limits.",
    ),
    "MD143": Code(
        "Cards hold no transform",
        "A property of a card deck is estimated as it stands, never as its logarithm.",
        "Keep the deck in YAML, or use transform: identity.",
    ),
    "MD144": Code(
        "Cards hold no correlated prior",
        "Group 6 holds standard deviations only.",
        "Keep the deck in YAML, or drop the correlations.",
    ),
    "MD145": Code(
        "Cards hold no missing data",
        "What is not punched is a measured zero, and every mode has a frequency.",
        "Keep the deck in YAML, or leave out the mode or the degree of freedom.",
    ),
    "MD146": Code(
        "The problem does not fit the cards",
        "Indices have three columns, so matrices end at 999; at least one variable element and "
        "one property are needed.",
        "Keep the deck in YAML.",
    ),
    "MD147": Code(
        "A number does not fit its columns",
        "No form of the number that the field can hold reads back as the same value.",
        "Round the number, or keep the deck in YAML.",
    ),
    "MD148": Code(
        "Cards cannot hold the total mass fixed",
        "The constraint is no part of the 1972 program.",
        "Keep the deck in YAML, or drop fix_total_mass.",
    ),
    "MD149": Code(
        "The title does not fit the heading card",
        "The heading is 80 printable ASCII characters.",
        "Shorten the title.",
    ),
    "MD150": Code(
        "Names, or data held out, are lost",
        "Cards number the properties and the degrees of freedom, give no units, and hold only the test that is fitted.",
        "Keep the YAML deck beside the cards.",
    ),
    "MD151": Code(
        "A run option is lost",
        "A card deck runs as the 1972 program did. Only KONF, NPARD, ITERMX and JFLAG are punched.",
        "Give the option on the command line.",
    ),
    "MD152": Code(
        "structure that cards cannot hold",
        "The model is made of nodes and elements, whose properties move the matrices in their own way. Cards hold K, M and "
        "elements of them that follow the properties in proportion.",
        "Keep the deck in YAML.",
    ),
}
