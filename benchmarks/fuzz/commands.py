"""What each command is asked of an input: its kinds of inputs and its options, sound ones and others."""

import random
from collections.abc import Callable
from dataclasses import dataclass

from benchmarks.fuzz.mutate import NUMBERS

_LOOP = (
    "--estimator=bayes --estimator=least-squares --estimator=maximum-likelihood --recursion=anchored --recursion=replaced "
    "--scale=none --scale=unit --scale=fitted --pairing=mac --pairing=number --confidence=90 --partials=3 "
    "--passes=3 --cycles=2 --cycles=0 "
    "--convergence=fraction --legacy-extra-update --step=second-order --limit-sd=2 --fix-total-mass --print-partials --exact "
    "--print-covariance"
).split()  # fmt: skip
_READ = "--legacy --strip-73-80 --allow-outside --allow-outside --set=NPARD=5 --set=NM=99999".split()
_SHOWN = "--json --json --markdown --numbers=legacy --numbers=modern -q".split()
_RECORDED = (
    "--estimator=h1 --estimator=hv --window=flattop --window=exponential --window=uniform --lines=16 --lines=2 --overlap=0.95 "
    "--impact --force-window=-1 --force-window=10 --period=16 --skip=5 --kind=mobility --sample-rate=100 --sample-rate=1e-300 "
    "--force=1 --force=f --force=force --response=2 --response=acc --unit=acc=g --time=t --pretrigger=3"
).split()  # fmt: skip
_DECKS = ("deck", "deck", "deck", "large", "records")


@dataclass(frozen=True)
class Asked:
    """kinds: of inputs, often as often as they are named; options: some of them are given; always: what is given each time.

    cost: of an input, by which there are fewer of them.
    """

    kinds: tuple[str, ...]
    options: tuple[str, ...] = ()
    always: tuple[str, ...] = ()
    most: int = 2
    cost: int = 1


COMMANDS: dict[str, Asked] = {
    "check": Asked((*_DECKS, "couple", "modify", "manifest"), (*_READ, "--brief", "--strict", "--stacked")),
    "show": Asked((*_DECKS, "couple", "modify"), tuple(_READ)),
    "convert": Asked(
        (*_DECKS, "couple"), (*_READ, "--to=cards", "--to=yaml", "--lossy", "-o=out/a.dat", "-o=out/a.yaml")
    ),
    "modes": Asked(_DECKS, (*_READ, *_SHOWN, "-n=2", "-n=99999999")),
    "correlate": Asked(_DECKS, (*_READ, *_SHOWN, "--expand=serep", "--expand=guyan", "--expand=dynamic", "--exact")),
    "run": Asked(
        _DECKS,
        (*_LOOP, *_READ, *_SHOWN, "--method=baruch", "--method=generic", "--stacked", "-o=out/answer"),
        most=3,
        cost=5,
    ),
    "compare": Asked(("deck",), (*_READ, *_SHOWN, "--method=baruch", "--method=kabe", "--expand=serep")),
    "sample": Asked(
        ("deck",), (*_READ, *_SHOWN, "--walkers=16", "--seed=0", "--chain=out/chain"), ("--steps=100",), cost=3
    ),
    "bootstrap": Asked(
        ("deck",),
        (
            *_LOOP,
            *_SHOWN,
            "--over=functions",
            "--over=records",
            "--over=sensors",
            "--over=both",
            "--jackknife",
            "--csv=out/t.csv",
        ),
        ("--replicates=3", "-j=1", "-o=out/b", "--time-limit=8"),
        cost=5,
    ),
    "sweep": Asked(
        ("deck",),
        (*_LOOP, *_SHOWN, "--points=3", "--design=latin-hypercube", "--csv=out/t.csv"),
        ("-j=1", "-o=out/s", "--time-limit=8"),
    ),
    "batch": Asked(
        ("deck", "deck", "manifest", "manifest", "couple"),
        (
            "--command=check",
            "--command=run",
            "--csv=out/t.csv",
            "--junit=out/j.xml",
            "--markdown=out/t.md",
            "--github",
            *_LOOP,
        ),
        ("-j=1", "-o=out/r", "--time-limit=8"),
        cost=10,
    ),
    "diagnose": Asked(
        (*["deck"] * 15, "records"), (*_READ, *_SHOWN, "--without=crack", "-o=out/new.yaml"), ("--causes=1",), cost=8
    ),
    "couple": Asked(("couple",), (*_SHOWN, "--functions=out/f.npz", "--functions=out/f.unv", "--truncate=0.01")),
    "modify": Asked(
        ("modify", "deck"),
        (
            *_READ,
            *_SHOWN,
            "--mass=1=2",
            "--spring=1,2=100",
            "--dashpot=1=3",
            "--absorber=1=0.1,mode1,0.1",
            "--target=1<2",
            "-n=3",
            "--sweep=1:mass=0.1",
            "--by=spring",
            "--place=1",
            "--mass=7TX=-1",
            "--mass=1=-1e30",
        ),
        most=4,
    ),
    "spectra": Asked(
        ("data", "data", "records"), (*_RECORDED, *_SHOWN, "-o=out/f.npz", "-o=out/f.unv", "--segment 0 20"), most=4
    ),
    "identify": Asked(
        ("data", "data", "records"),
        (*_RECORDED, *_SHOWN, "--output-only", "--orders=8", "--band 1 200", "-o=out/t.yaml"),
        most=4,
    ),
    "report": Asked(("result",), ("--markdown", "-o=out/page.html")),
    "plot": Asked(("result",), ("--figure=frequencies", "--figure=mac"), ("-o=out/figures",), cost=4),
    "prior": Asked(("result",), (*_SHOWN, "--loosen=k1=5 %", "--loosen=k1=1e308")),
    "export": Asked(
        ("deck", "deck", "inp", "large"),
        (
            "--shapes=out/a.unv",
            "--shapes=out/a.vtk",
            "--modes=3",
            "--first=0",
            "--first=1e9",
            "--for=ansys",
            "--for=nastran",
        ),
        ("--for=calculix", "-o=out/model"),
    ),
    "import": Asked(("inp",), (), ("-o=out/new.yaml",)),
    "explain": Asked(()),
    "list": Asked(()),
}
_VARIED = ("k1 k2 k k1.sd confidence cycles recursion estimator test.modes.frequency_sd test.modes.shape_sd frequency_sd* "
           "shape_sd* parameters.0.sd parameters[0].sd model.mass title passes partials limit_sd "
           "test.modes.frequency").split()  # fmt: skip
_TOPICS = "MD104 MD903 NPARD KONF O-2 bayes anchored exit cards yaml schema converged crack beam table-3-1 elements methods".split()
_LISTS = "candidates codes commands elements estimators methods plots statuses".split()


def arguments(rng: random.Random, command: str, main: str) -> list[str]:
    """A command line for `in/MAIN`."""
    asked = COMMANDS[command]
    if not asked.kinds:
        topic = rng.choice(_LISTS if command == "list" else _TOPICS)
        at = rng.randrange(len(topic) + 1)
        if rng.random() < 0.3:
            return [command, topic]
        return [
            command,
            topic[:at] + rng.choice(("", "x", "-", "9" * 20, "€", "\n", "[", "*")) + topic[at + rng.randrange(3) :],
        ]
    given = [
        *asked.always,
        *rng.sample(asked.options, min(len(asked.options), rng.choice((0, *range(asked.most + 1))))),
    ]
    words = [word for option in given for word in _words(option)]
    if command == "sweep":
        for _ in range(rng.choice((1, 1, 2))):
            words += ["--vary", f"{rng.choice(_VARIED)}={_values(rng)}"]
    if command == "prior":
        return ["run", "in/sound_chain.yaml", "--prior", f"in/{main}", *words]
    return [command, f"in/{main}", *words]


def _words(option: str) -> list[str]:
    if option.startswith("--segment ") or option.startswith("--band "):
        return option.split()
    if option.startswith("-") and not option.startswith("--") and "=" in option:
        return option.split("=", 1)
    return [option]


def _values(rng: random.Random) -> str:
    some: list[Callable[[], str]] = [
        lambda: ",".join(rng.choice(NUMBERS) for _ in range(rng.randint(1, 3))),
        lambda: f"{rng.choice(NUMBERS)}:{rng.choice(NUMBERS)}:{rng.choice((1, 3))}",
        lambda: f"log:{rng.choice(NUMBERS)}:{rng.choice(NUMBERS)}:2",
        lambda: "1e5:2e5:2",
        lambda: "1 %,2 %",
        lambda: rng.choice(("bayes,least-squares", "anchored,replaced", "", "::", "log:")),
    ]
    return rng.choice(some)()
