"""What a recursion leaves behind: its cycles, the state it ended in, and why it ended."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from mouse_cli.model.result import Cycle, Status
from mouse_cli.terms.elements import registry
from mouse_cli.updating.convergence import ExceedanceTest
from mouse_cli.updating.state import Setting, State
from mouse_cli.updating.statuses import status

Progress = Callable[[Cycle], None]
_LISTED = 3  # properties that a status names
_NOTHING = 1e-6  # share of its prior value that a property must keep to be more than nothing


def _positive(element: str, name: str) -> bool:
    """Whether a property of a type of element is positive by its nature."""
    return name == "density" or registry()[element].properties[name].positive


@dataclass
class Trace:
    """Grows by one cycle at a time; `state` is the last good one. guess (p,): values of the parameters that may be near the end.

    enough: the share of its cost that a step must promise and gain.
    """

    setting: Setting
    test: ExceedanceTest
    progress: Progress
    state: State
    cycles: list[Cycle] = field(default_factory=list)
    guess: np.ndarray | None = None
    enough: float = 0.0

    def record(self, state: State, cost: float, damping: float = 0.0) -> Cycle:
        """Accept `state` as the result of the next cycle."""
        exceeding = self.test.exceeding(state.residual, self.setting.sd)
        allowed = self.test.allowed(len(exceeding))
        cycle = Cycle(len(self.cycles), state.theta, state.chi2, int(exceeding.sum()), allowed, cost, damping)
        self.state = state
        self.cycles.append(cycle)
        self.progress(cycle)
        return cycle

    @property
    def passed(self) -> bool:
        """Whether the last cycle passes the exceedance test."""
        last = self.cycles[-1]
        return last.exceedances <= last.allowed

    def end(self, key: str, **facts: object) -> Status:
        """The status `key` with the facts of this trace."""
        first, last = self.cycles[0], self.cycles[-1]
        return status(
            key,
            cycles=last.index,
            exceedances=last.exceedances,
            data=len(self.setting.y),
            allowed=last.allowed,
            chi2_first=first.chi2,
            chi2_last=last.chi2,
            **facts,
        )

    def unphysical(self, u: np.ndarray, message: str) -> Status:
        """The status for a step to coordinates u (p,) where K or M is not physical: which properties it drives below zero."""
        theta, parameters = self.setting.coordinates.value(u), self.setting.problem.parameters
        lost = [i for i, parameter in enumerate(parameters) if parameter.nominal > 0 >= theta[i]]
        values = [f"{parameters[i].name} {theta[i]:.6g}, {parameters[i].nominal:.6g} before" for i in lost[:_LISTED]]
        more = [f"and {len(lost) - _LISTED} more"] if len(lost) > _LISTED else []
        return self.end("indefinite", cycle=len(self.cycles), reason="; ".join([message, *values, *more]))

    def sound(self, status: Status) -> Status:
        """`status`, or where a property that is positive by its nature has come to zero or below: that, and which one it is.

        A parameter of matrix entries may be negative; one that is Young's modulus, an area or a density may not.
        """
        problem = self.setting.problem
        lost = sorted(
            {
                b.parameter
                for b in problem.bindings
                if _positive(problem.mesh.elements[b.set].type, b.property)
                and problem.parameters[b.parameter].nominal > 0
                and not self.state.theta[b.parameter] > _NOTHING * problem.parameters[b.parameter].nominal
            }
        )
        if not lost or not status.answered:
            return status
        named = [(problem.parameters[i], self.state.theta[i]) for i in lost[:_LISTED]]
        values = [f"{p.name} became {value:.6g}{p.unit and ' ' + p.unit}, {p.nominal:.6g} before" for p, value in named]
        return self.end("impossible", reason="; ".join(values))

    def unobservable(self, message: str, loose: np.ndarray) -> Status:
        """The status for properties (mask `loose`) that the data do not determine."""
        parameters = self.setting.problem.parameters
        names = [p.name for p, is_loose in zip(parameters, loose, strict=True) if is_loose]
        listed = ", ".join(names[:10]) + (f" and {len(names) - 10} more" if len(names) > 10 else "")
        return self.end("unobservable", reason=message, names=listed)
