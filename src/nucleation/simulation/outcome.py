"""How a run ended. It uses nothing, for what reads records must not load what makes them."""

import enum


class Outcome(enum.Enum):
    """How a run ended."""

    END_TIME = "completed: the end time was reached"
    AFTER_EVENT = "completed: the event and the time asked for after it are covered"
    STEP_UNDERFLOW = "failed: the step size fell below the shortest step allowed"
    TENSION = "failed: the interface came under tension, where the friction law has no meaning"
    NOT_FINITE = "failed: a recorded value is not finite"

    INTERRUPTED = "interrupted: what had been recorded until then"

    @property
    def completed(self) -> bool:
        """Whether the run reached its planned end."""
        return self.value.startswith("completed")
