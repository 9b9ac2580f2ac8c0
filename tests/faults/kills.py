"""Kills. The moment is a random part of the processor time that an undisturbed run takes."""

from __future__ import annotations

import random
import signal

from harness import IDS, Place, Reference, processor_time, require
from registry import CLEAR_ERROR, RECOVERED, fault


def _stop_alone(
    place: Place, reference: Reference, random: random.Random, number: signal.Signals
) -> str:
    """Signals, up to three times, to a simulation's script, which is then run to its end."""
    id = random.choice(IDS)
    place.simulation(id).unlink()
    with place.unharmed():
        for _ in range(random.choice((1, 1, 1, 3))):
            running = place.start_alone(id)
            if running.spend(random.uniform(0.3, 1.0) * reference.alone):
                running.signal(number)
            done = running.end()
            require(done.status != 0 or place.simulation(id).exists(), "it left no result")
            begun = "starts at the beginning" in place.log(id)
            require(not begun, f"a checkpoint was refused: {place.log(id)}")
        if not place.simulation(id).exists():
            require((done := place.run_alone(id)).status == 0, done.output + place.log(id))
    return RECOVERED


@fault("SIGKILL of a simulation")
def sigkill_simulation(place, reference, random):
    return _stop_alone(place, reference, random, signal.SIGKILL)


@fault("SIGTERM")
def sigterm_simulation(place, reference, random):
    return _stop_alone(place, reference, random, signal.SIGTERM)


@fault("Ctrl-C")
def sigint_simulation(place, reference, random):
    return _stop_alone(place, reference, random, signal.SIGINT)


@fault("SIGHUP")
def sighup_simulation(place, reference, random):
    return _stop_alone(place, reference, random, signal.SIGHUP)


def _stop_workflow(
    place: Place, reference: Reference, random: random.Random, number: signal.Signals, group: bool
) -> str:
    """A signal to snakemake, or to all its processes as from a terminal; then the next steps."""
    gone = random.sample(IDS, random.choice((1, 2)))
    for id in gone:
        place.simulation(id).unlink()
    with place.unharmed():
        running = place.start()
        if running.spend(random.uniform(0.1, 1.0) * reference.workflow):
            running.signal(number, group=group)
        running.end()
        place.finish()
    return RECOVERED


@fault("SIGKILL of a simulation")
def sigkill_simulation_in_workflow(place, reference, random):
    """Snakemake is told of the failure, and says which job it was."""
    id = random.choice(IDS)
    place.simulation(id).unlink()
    with place.unharmed():
        running = place.start()
        moment = random.uniform(0.1, 1.0) * reference.alone
        if running.wait_for(lambda: processor_time(running.scripts()) >= moment):
            for process in running.scripts():
                process.kill()
        done = running.end()
        if done.status == 0:
            return RECOVERED  # the kill came too late
        require(f"{id}.nc" in done.output, f"the failed job is not named: {done.output}")
        place.finish()
    return CLEAR_ERROR


@fault("SIGKILL of snakemake")
def sigkill_snakemake(place, reference, random):
    """Snakemake alone: its simulation goes on while the next workflow begins."""
    return _stop_workflow(place, reference, random, signal.SIGKILL, group=False)


@fault("SIGKILL of snakemake")
def sigkill_snakemake_and_all_its_processes(place, reference, random):
    return _stop_workflow(place, reference, random, signal.SIGKILL, group=True)


@fault("SIGTERM")
def sigterm_snakemake(place, reference, random):
    return _stop_workflow(place, reference, random, signal.SIGTERM, group=False)


@fault("SIGTERM")
def sigterm_snakemake_and_all_its_processes(place, reference, random):
    return _stop_workflow(place, reference, random, signal.SIGTERM, group=True)


@fault("Ctrl-C")
def ctrl_c(place, reference, random):
    return _stop_workflow(place, reference, random, signal.SIGINT, group=True)


@fault("SIGHUP")
def closed_terminal(place, reference, random):
    return _stop_workflow(place, reference, random, signal.SIGHUP, group=True)


@fault("SIGKILL between writing and renaming")
def killed_before_renaming(place, reference, random):
    """Halves of a checkpoint and of a dataset lie there under temporary names."""
    id = random.choice(IDS)
    dataset, checkpoint = place.simulation(id), reference.checkpoints / place.checkpoint(id).name
    for path in (dataset, checkpoint):
        content = path.read_bytes()
        half = dataset.with_name(f".{path.name}.{random.randrange(1, 99999)}.tmp")
        half.write_bytes(content[: random.randrange(len(content))])
    dataset.unlink()
    found = [finding for finding in place.findings() if "half a file" in finding.reason]
    require(len(found) == 2, "check does not list the halves")
    require((done := place.run_alone(id)).status == 0, done.output + place.log(id))
    return RECOVERED
