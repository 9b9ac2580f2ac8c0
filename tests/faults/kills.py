"""Kills: at a random part of the processor time that a workflow takes."""

import contextlib
import functools
import random
import signal

import psutil
from damage import DAMAGE, damage, truncate
from harness import CONFIG, FAULTS, IDS, OTHER, Place, Reference, configure, fault
from processes import Running, processor_time, require

TERM, KILL, INT = signal.SIGTERM, signal.SIGKILL, signal.SIGINT


def _send_scripts(running: Running, number: signal.Signals) -> None:
    for process in running.scripts():
        with contextlib.suppress(psutil.NoSuchProcess):  # it has just ended
            process.send_signal(number)


def _stop_simulations(
    place: Place, reference: Reference, random: random.Random, number: signal.Signals
) -> None:
    """A signal to the simulations' scripts: Snakemake says which job failed, and each goes on."""
    ids = random.sample(IDS, random.choice((1, 2)))
    place.forget(*ids)
    with place.unharmed():
        running = place.start()
        moment = random.uniform(0.05, 0.3) * reference.cpu
        if running.wait_for(lambda: processor_time(running.scripts()) >= moment):
            _send_scripts(running, number)
        done = running.end()
        if done.status != 0:  # or the signal came too late
            require(any(f"{id}." in done.output for id in ids), f"no name: {done.output}")
        place.finish()
        for id in ids:
            begun = "starts at the beginning" in place.log(id)
            require(not begun, f"a checkpoint was refused: {place.log(id)}")


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
        moment = random.uniform(0.1, 1.0) * reference.cpu
        place.start().interrupt(number, moment, group=group)
        place.finish()


_stop_all = functools.partial(_stop_snakemake, group=True)

for _name, _stop, _number in (
    ("sigkill_simulation", _stop_simulations, KILL),
    ("sigterm_simulation", _stop_simulations, TERM),
    ("sigint_simulation", _stop_simulations, INT),
    # snakemake alone: its simulation goes on while the next workflow begins
    ("sigkill_snakemake", _stop_snakemake, KILL),
    ("sigkill_snakemake_and_all", _stop_all, KILL),
    ("sigterm_snakemake_and_all", _stop_all, TERM),
    ("ctrl_c", _stop_all, INT),
):
    FAULTS[_name] = functools.partial(_stop, number=_number)


@fault
def damaged_checkpoint(place, reference, random):
    """It is refused, unless the damage is of bits without meaning."""
    id, how = random.choice(IDS), random.choice(DAMAGE)
    place.forget(id)
    with place.unharmed():
        running = place.start()
        running.wait_for(place.checkpoint(id).exists)
        _send_scripts(running, KILL)
        running.end()
        left = place.checkpoint(id).exists()
        if left:
            damage(place.checkpoint(id), how, random)
        place.finish()
    if left and how is truncate:
        said = place.log(id)
        require("the run starts at the beginning" in said, f"it was not refused: {said}")


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
            _send_scripts(running, KILL)
        second = place.run()  # refused by the lock, if the first goes on
        running.signal(TERM)
        running.end()
        place.finish()
    # or by Snakemake, where the first one ends or shows a file while the second looks
    refusals = ("locked", ".snakemake/locks/", "a concurrent process has deleted it")
    refused = any(text in second.output for text in refusals)
    require(second.status == 0 or refused, second.output)


@fault
def scheduler_killed_and_parameters_changed(place, reference, random: random.Random):
    """Its simulation goes on to its end; meanwhile the configuration changes, and back again."""
    place.forget(random.choice(IDS))
    with place.unharmed():
        place.start().interrupt(KILL, random.uniform(0.2, 0.9) * reference.cpu)
        configure(place, OTHER)
        place.finish()
        configure(place, CONFIG)
        place.finish()
        place.prune()
