"""mouse sample: the posterior of a deck by samples, where the normal density of a run is doubtful."""

import click

from mouse_cli.cli._answers import deliver_answer
from mouse_cli.cli._options import PRIOR, QUIET, READING, answer, earlier, options


@click.command()
@click.argument("deck")
@click.option(
    "--steps",
    type=click.IntRange(100, 10_000_000),
    default=20_000,
    show_default=True,
    help="Most steps of each walker.",
)
@click.option(
    "--walkers", type=click.IntRange(4, 100_000), help="Walkers.  [default: four for each property, sixteen at least]"
)
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True, help="Of the random numbers.")
@click.option(
    "-j", "--jobs", type=click.IntRange(1, 1024), default=1, show_default=True, help="Processes, for large models."
)
@click.option(
    "--chain",
    metavar="FILE",
    help="Write the samples to FILE.npz. An interrupted chain resumes from FILE.npz.part.",
)
@options(answer("mouse.sample/1"), PRIOR, QUIET, READING)
def command(deck: str, steps: int, walkers: int | None, seed: int, jobs: int, chain: str | None) -> int:
    """Sample the posterior of DECK (MCMC).

    Of its prior and the likelihood of its test, as `mouse run` has them. Checks the standard deviations of `mouse run`
    against the posterior. Needs the extra `sampling`.

    Exit 0: the chain is long enough, and the model explains the data. 1: do not trust it. 4: deck rejected. 5: no answer.
    """
    from mouse_cli.campaigns.sampling.sample import sample
    from mouse_cli.cli._decks import read_problem, without_laws
    from mouse_cli.cli._terminal import progress, warn
    from mouse_cli.model.sampled import Sampling

    problem = read_problem(deck, **earlier())
    warn((*problem.warnings, *without_laws(problem)))
    with progress() as (_, say):
        found = sample(problem, Sampling(steps, walkers or 0, seed, jobs), say, chain)
    if chain:
        from mouse_cli.campaigns.sampling.chain_file import write

        write(chain, found)
    deliver_answer(found, deck, None)
    return found.exit_code
