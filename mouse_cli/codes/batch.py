"""Codes of batches of decks (MD900-MD919)."""

from mouse_cli.codes import Code

CODES = {
    "MD900": Code(
        "name without a deck",
        "A name or a pattern of a manifest, or of the command line, stands for no deck at all. A batch that passed because it "
        "looked at nothing would deceive.",
        "Correct the name. Names in a manifest are from its own folder; a pattern is matched by names of files, `**` by folders.",
    ),
    "MD901": Code(
        "expectation that cannot be read",
        "A line below `expect` names nothing that an answer holds, or gives a number without a tolerance: numbers that are equal "
        "to the last digit on every machine are not to be had.",
        "Write `posterior k1: 83699 +- 20`, `frequency 2: 14.3 +- 1 %`, `probability: > 0.9`, or a word: `status: converged`.",
    ),
    "MD902": Code(
        "a process died",
        "The process that ran the deck ended without an answer: the system stopped it for want of memory, a user ended it, or a "
        "library failed. It was tried again by itself and died again, or was alone from the first. Other jobs are not touched, and "
        "the next batch tries it again.",
        "Run the deck by itself; where memory is short, give fewer `--jobs`.",
    ),
    "MD903": Code(
        "fault of mouse",
        "An unexpected failure within mouse: the message names its kind and its location in the program. Other jobs "
        "of a batch are not touched, and the next batch tries the deck again.",
        "Report it with the deck. With `MOUSE_TRACEBACK=1` in the environment, Python's whole account is printed.",
    ),
    "MD904": Code(
        "folder in use",
        "Another batch writes its answers to this folder. Two at once would do work twice.",
        "Wait for it to end, or give another folder with `-o`.",
    ),
    "MD905": Code(
        "no package for clusters",
        "`--scheduler` and `--cluster` hand jobs to dask.distributed, which a plain installation does not bring.",
        "`pip install 'mouse-cli[cluster]'`, or leave these options out: processes of one machine need nothing.",
    ),
    "MD906": Code(
        "expectation missed",
        "The answer of a job is not what its manifest expects; the batch ends with exit 3.",
        "See the answer of the job: its file is named in the CSV table. Correct the deck, or what is expected of it.",
    ),
    "MD907": Code(
        "unknown candidate",
        "`candidates` of a job names omitted physics that mouse does not know.",
        "Take names from `mouse list candidates`.",
    ),
    "MD910": Code(
        "limit of time",
        "The job was not done within the seconds of `--time-limit` and was ended. Other jobs are not touched, and the next "
        "batch tries it again. A single long call of a library completes first.",
        "Give a longer `--time-limit`, or run the deck by itself to see what takes so long.",
    ),
    "MD909": Code(
        "no process can be started",
        "A process died that had no job yet: memory or the number of processes is at its limit, or mouse was changed while the "
        "batch ran. What is finished is kept.",
        "Mend the cause, and begin again with the same command.",
    ),
    "MD908": Code(
        "no scheduler",
        "No scheduler of dask.distributed answers at the address of `--scheduler`, or it is of a version that does not fit.",
        "See that it runs (`dask scheduler`) and that its address, such as tcp://10.0.0.1:8786, can be reached.",
    ),
}
