"""MD440 to MD449: what an earlier run found, as the prior of another test."""

from mouse_cli.codes import Code

CODES = {
    "MD440": Code(
        "no result of an earlier run",
        "`--prior` takes the answer of `mouse run --json`: values of the properties and their covariance. The file is none, or "
        "the run had no answer, or left a property at a limit, where it has no standard deviation, or had too many properties "
        "for the covariance to be kept.",
        "Write the earlier result with `mouse run deck.yaml --json -o result.json`.",
    ),
    "MD441": Code(
        "properties that the two decks do not share",
        "An earlier result has information on the properties of the same names in this deck. None does; or one that "
        "`--loosen` names is not among those taken over.",
        "Give the properties of both decks the same names.",
    ),
    "MD442": Code(
        "the same data twice",
        "The earlier result was fitted to the very frequencies that this deck would fit again. A posterior is a prior for new "
        "data only: used on its own data it counts them twice, and its standard deviations shrink for nothing.",
        "Run the deck without --prior; or give it the frequencies of another test.",
    ),
    "MD443": Code(
        "an earlier result that was not to be trusted",
        "The run whose answer becomes the prior ended with another exit code than 0: it did not converge, or the data rejected "
        "the form of its model. Its covariance does not cover that.",
        "Mend the earlier run first, or state in --loosen how far its values may be wrong.",
    ),
}
