"""Keys of a manifest, which stands in a file of its own: jobs of `mouse batch`."""

from mouse_cli.formats.yaml_deck.kinds import VERSION, Key, Section

_COMMAND = Key("choice", "command for each deck", "run", choices=("run", "check", "diagnose"))
SECTIONS = {
    "manifest": Section(
        "Many decks and what is expected of them, in a file of its own; `mouse batch` reads it.",
        {
            "mouse": Key("whole", "version of the format", required=True, low=VERSION, high=VERSION),
            "title": Key("text", "what the jobs are", "empty"),
            "command": _COMMAND,
            "options": Key("section run", "instead of those of the decks", "those of the decks"),
            "batch": Key("list job", "the jobs", required=True),
        },
    ),
    "job": Section(
        "Decks with the same command.",
        {
            "decks": Key(
                "word or words",
                "files, folders or patterns such as `chains/*.yaml`, from the manifest's folder",
                required=True,
            ),
            "command": Key("choice", "command for each deck", "that of the manifest", choices=_COMMAND.choices),
            "options": Key("section run", "instead of those of the decks and of the manifest", "those of the manifest"),
            "candidates": Key("texts", "a diagnosis considers these alone", "all"),
            "causes": Key("whole", "largest number of mechanisms together in a diagnosis", "2", low=1, high=2),
            "expect": Key("expectations", "what the answer must be: exit 3 where it is not", "nothing"),
        },
    ),
}
