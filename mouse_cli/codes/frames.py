"""MD960 and MD961: answers as frames of pandas and datasets of xarray."""

from mouse_cli.codes import Code

CODES = {
    "MD960": Code(
        "frames need pandas, datasets xarray",
        "`mouse_cli.frames` makes frames of the package pandas, and `mouse_cli.dataset` a dataset of xarray. A plain installation "
        "brings neither, and nothing else needs them.",
        "Install both with `pip install 'mouse-cli[frames]'`, or take `mouse_cli.document`, which is plain Python.",
    ),
    "MD961": Code(
        "nothing for a dataset",
        "The answer has nothing that is numbers by parameter, mode, degree of freedom or line.",
        "`mouse_cli.frames` makes frames of any answer.",
    ),
}
