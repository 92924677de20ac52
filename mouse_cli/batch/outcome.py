"""One line of the summary: how a job ended, and what it missed."""

from dataclasses import dataclass, replace
from typing import Any

from mouse_cli._errors import ERROR, Diagnostic
from mouse_cli.batch.expectation import EXIT, VERDICT
from mouse_cli.batch.job import CHECK, Job
from mouse_cli.batch.record import Answer

MISSED = 3  # exit code of a batch in which an expectation was missed
_ASKED = "MD906"
_MOST = 50  # findings of one job that are kept in memory


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a job ended: `ended` in a word or two, `missed` the expectations that it did not meet, of `expected`.

    resumed: its answer was there already. settles: an expectation that was met asked for the exit code or the verdict.
    answered: the file `result` has the document of an answer.
    """

    deck: str
    command: str
    exit_code: int
    ended: str
    diagnostics: tuple[Diagnostic, ...]
    expected: int
    missed: tuple[Diagnostic, ...]
    settles: bool
    seconds: float
    resumed: bool
    result: str
    residual_p: float | None = None
    answered: bool = False

    @property
    def counted(self) -> int:
        """Exit code with which the job counts in that of the batch."""
        return 0 if self.settles and not self.missed else self.exit_code

    @property
    def errors(self) -> tuple[Diagnostic, ...]:
        """Findings that are errors."""
        return tuple(each for each in self.diagnostics if each.severity == ERROR)


def outcome(job: Job, answer: Answer, result: str, resumed: bool = False) -> Outcome:
    """The outcome of `job`, its expectations judged anew."""
    sentences = [(each, each.missed(answer.document, answer.exit_code)) for each in job.expected]
    missed = tuple(
        Diagnostic(_ASKED, ERROR, f"{job.deck}: {sentence}", each.span) for each, sentence in sentences if sentence
    )
    settles = any(each.quantity in (EXIT, VERDICT) and not sentence for each, sentence in sentences)
    residual = (answer.document or {}).get("residual") or {}
    return Outcome(
        job.deck, job.command, answer.exit_code, _ended(job, answer), answer.diagnostics[:_MOST], len(job.expected), missed,
        settles, answer.seconds, resumed, result, residual.get("p"), answer.document is not None,
    )  # fmt: skip


def unwritten(found: Outcome, diagnostics: tuple[Diagnostic, ...]) -> Outcome:
    """The same with the news that its answer could not be kept."""
    return replace(
        found, exit_code=5, ended=f"not written {diagnostics[0].code}", diagnostics=diagnostics, settles=False
    )


def exit_code(outcomes: list[Outcome]) -> int:
    """3 where an expectation was missed, else the highest of the jobs': 5, 4, 1, 0."""
    if any(each.missed for each in outcomes):
        return MISSED
    return max((each.counted for each in outcomes), default=0)


def _ended(job: Job, answer: Answer) -> str:
    document: dict[str, Any] = answer.document or {}
    errors = [each.code for each in answer.diagnostics if each.severity == ERROR]
    if answer.document is None and answer.exit_code:
        return f"{'rejected' if answer.exit_code == 4 else 'no answer'} {errors[0] if errors else ''}".rstrip()
    if job.command == CHECK:
        return f"sound, {len(answer.diagnostics)} warnings" if answer.diagnostics else "sound"
    verdict = document.get("verdict")
    if verdict:
        return f"{verdict['kind']}: {verdict['physics']}" if verdict.get("physics") else verdict["kind"]
    form = ", model form rejected" if document.get("model_form") == "rejected" else ""
    return f"{document.get('status')}{form}"
