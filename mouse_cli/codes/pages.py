"""MD920 to MD922: documents that pages are made of."""

from mouse_cli.codes import Code

CODES = {
    "MD920": Code(
        "no document of mouse",
        "`mouse report` reads the JSON that `mouse run --json` and `mouse diagnose --json` write. The file is no JSON, or has no "
        "`schema` of mouse.",
        "Write the answer with --json and give that file; a deck is not an answer.",
    ),
    "MD921": Code(
        "a document that no page is made of",
        "The document is of mouse, but of another kind, or of another version of its schema.",
        "Give a document mouse.result/1, mouse.diagnosis/1 or mouse.arrangements/1; "
        "one of another version needs the mouse that wrote it.",
    ),
    "MD922": Code(
        "a document that does not follow its schema",
        "A value of the document is of another type than in its schema: the file was changed, or made by something else.",
        "Write the document again; its keys are listed in docs/reference/json.md.",
    ),
}
