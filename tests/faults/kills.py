"""Kills. The moment is a random part of the processor time that an undisturbed run takes."""

import contextlib
import functools
import random
import signal

import psutil
from harness import IDS, Place, Reference
from processes import processor_time, require
from registry import FAULTS, fault


def _stop_simulation(
    place: Place, reference: Reference, random: random.Random, number: signal.Signals
) -> None:
    """Signals, up to three times, to a simulation's script, which is then run to its end."""
    id = random.choice(IDS)
    place.forget(id)
    with place.unharmed():
        for _ in range(random.choice((1, 1, 1, 3))):
            moment = random.uniform(0.3, 1.0) * reference.alone
            done = place.start_alone(id).interrupt(number, moment)
            require(done.status != 0 or place.simulation(id).exists(), "it left no result")
            begun = "starts at the beginning" in place.log(id)
            require(not begun, f"a checkpoint was refused: {place.log(id)}")
        if not place.simulation(id).exists():
            place.run_alone(id)


def _stop_snakemake(
    place: Place,
    reference: Reference,
    random: random.Random,
    number: signal.Signals,
    group: bool = False,
) -> None:
    """A signal to snakemake, or to all its processes as from a terminal; then the next steps."""
    place.forget(*random.sample(IDS, random.choice((1, 2))))
    with place.unharmed():
        moment = random.uniform(0.1, 1.0) * reference.workflow
        place.start().interrupt(number, moment, group=group)
        place.finish()


_stop_all = functools.partial(_stop_snakemake, group=True)

for _name, _stop, _number in (
    ("sigkill_simulation", _stop_simulation, signal.SIGKILL),
    ("sigterm_simulation", _stop_simulation, signal.SIGTERM),
    ("sigint_simulation", _stop_simulation, signal.SIGINT),
    ("sighup_simulation", _stop_simulation, signal.SIGHUP),
    # snakemake alone: its simulation goes on while the next workflow begins
    ("sigkill_snakemake", _stop_snakemake, signal.SIGKILL),
    ("sigkill_snakemake_and_all", _stop_all, signal.SIGKILL),
    ("sigterm_snakemake", _stop_snakemake, signal.SIGTERM),
    ("sigterm_snakemake_and_all", _stop_all, signal.SIGTERM),
    ("ctrl_c", _stop_all, signal.SIGINT),
):
    FAULTS[_name] = functools.partial(_stop, number=_number)


@fault
def sigkill_simulation_in_workflow(place, reference, random):
    """Snakemake is told of the failure, and says which job it was."""
    id = random.choice(IDS)
    place.forget(id)
    with place.unharmed():
        running = place.start()
        moment = random.uniform(0.1, 1.0) * reference.alone
        if running.wait_for(lambda: processor_time(running.scripts()) >= moment):
            for process in running.scripts():
                with contextlib.suppress(psutil.NoSuchProcess):  # it has just ended
                    process.kill()
        done = running.end()
        if done.status != 0:  # or the kill came too late
            require(f"{id}." in done.output, f"the failed job is not named: {done.output}")
            place.finish()


@fault
def job_taken_for_failed(place, reference, random):
    """Killed with its result in the store, before Snakemake has heard of it; others start then."""
    ids = random.sample(IDS, random.choice((1, 2)))
    place.forget(*ids)
    running = place.start("lengths", "--cores", "1")
    made = [place.simulation(id) for id in ids]
    running.wait_for(lambda: any(path.exists() for path in made))
    with place.unharmed():
        if random.choice((True, False)):
            for process in running.scripts():
                with contextlib.suppress(psutil.NoSuchProcess):
                    process.kill()
        second = place.run()  # refused by the lock, if the first goes on
        running.signal(signal.SIGTERM)
        running.end()
        place.finish()
    require(second.status == 0 or "locked" in second.output, second.output)


@fault
def killed_before_renaming(place, reference, random):
    """Halves of a checkpoint and of a dataset lie there under temporary names."""
    id = random.choice(IDS)
    dataset, checkpoint = place.simulation(id), place.checkpoint(id)
    place.store.directory.joinpath(".killed.tmp").mkdir()
    checkpoint.parent.mkdir(exist_ok=True)
    for path, half in (
        (dataset, place.store.directory / ".killed.tmp" / dataset.name),
        (
            reference.checkpoints / checkpoint.name,
            checkpoint.with_name(f".{checkpoint.name}.1.tmp"),
        ),
    ):
        content = path.read_bytes()
        half.write_bytes(content[: random.randrange(len(content))])
    place.forget(id)
    found = [finding for finding in place.findings() if "half a file" in finding.reason]
    require(len(found) == 2, "check does not list the halves")
    place.run_alone(id)
