"""`make bench`: where the time of one optimisation goes, case by case, side by side in one run."""

import argparse
import socket
import statistics
import subprocess
import sys
import time
import urllib.error
import urllib.request
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.table import Table

from tests.benchmarks import discrete, outputs, plates
from tests.benchmarks.cases import CASES
from tests.benchmarks.phases import PHASES, measure

READY_WITHIN_S = 60.0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=60, help="warm repeats of every case")
    repeats = parser.parse_args().repeats
    console = Console(width=120)
    phases(console, repeats)
    by_output(console, max(repeats // 3, 5))
    choices(console, max(repeats // 12, 3))
    shapes(console, repeats)
    console.print(f"service, from start to ready: {start_to_ready():.2f} s")
    # each in a process of its own, which stays on one core or starts its own workers
    for module in ("whole_turn", "wire", "sweep", "sweep_limits", "sweep_scaling"):
        subprocess.run([sys.executable, "-m", f"tests.benchmarks.{module}"], check=True)


def phases(console: Console, repeats: int) -> None:
    """Warm medians; the cases take turns, so that a slow moment of the machine meets them all."""
    bodies = {name: build() for name, build in CASES.items()}
    samples: dict[str, list[dict[str, float]]] = {name: [] for name in bodies}
    for body in bodies.values():
        measure(body)
    for _ in range(repeats):
        for name, body in bodies.items():
            samples[name].append(measure(body))
    table = Table(title=f"warm median of {repeats}, milliseconds, in process")
    for heading in ("case", *PHASES):
        table.add_column(heading, justify="left" if heading == "case" else "right")
    for name, taken in samples.items():
        table.add_row(name, *(f"{statistics.median(fields[phase] for fields in taken):.2f}" for phase in PHASES))
    console.print(table)


def by_output(console: Console, repeats: int) -> None:
    """What each output costs on a small and on a large machine."""
    machines = {"2D12, 2 rows": outputs.two_rows(), "16 rows": outputs.sixteen_rows()}
    times = {name: outputs.times_by_output(machine, repeats) for name, machine in machines.items()}
    table = Table(title=f"analyze by output at 1 degree, warm median of {repeats}, milliseconds")
    table.add_column("output")
    for name in machines:
        table.add_column(name, justify="right")
    for scene in outputs.SCENES:
        table.add_row(scene, *(f"{times[name][scene]:.2f}" for name in machines))
    console.print(table)
    for name, machine in machines.items():
        residual_with_and_without_gas = outputs.residual_with_and_without_gas(machine, repeats)
        console.print(
            f"residual alone, {name}:",
            ", ".join(f"{key} {value:.2f} ms" for key, value in residual_with_and_without_gas.items()),
        )
    for name, value in outputs.scroll_pins(repeats).items():
        console.print(f"scroll pins, {name}: {value:.2f} ms")
    loop, block = outputs.broadcasting()
    console.print(f"1,000 machines: one by one {loop:.3f} s, in one call {block:.3f} s, ratio {loop / block:.0f}")


def choices(console: Console, repeats: int) -> None:
    """Choices from a catalogue and matched parts beside SCIP, and what else is chosen from few possibilities."""
    table = Table(
        title=f"choices to a gap of 1e-4, seconds of one core: median of {repeats}, and SCIP once, at most 60 or 10 s",
        caption="a larger gap is open; matching needs no tree; all orders of cranks, below, are more than one program",
    )
    for heading in ("case", "ours", "gap", "nodes", "SCIP", "gap", "nodes", "SCIP's less ours"):
        table.add_column(heading, justify="left" if heading == "case" else "right")
    cases = {name: partial(discrete.beside, body, repeats, 60.0) for name, body in discrete.CHOICES.items()}
    cases |= {
        name: partial(discrete.matched_beside, request, repeats, 10.0) for name, request in discrete.MATCHES.items()
    }
    for name, case in cases.items():
        instance = case()
        nodes = "" if instance.ours_nodes is None else str(instance.ours_nodes)
        ours = (f"{instance.ours_s:.3f}", f"{instance.ours_gap:.1e}", nodes)
        theirs = (f"{instance.theirs_s:.2f}", f"{instance.theirs_gap:.1e}", str(instance.theirs_nodes))
        table.add_row(name, *ours, *theirs, f"{instance.apart:.1e}")
    console.print(table)
    for name, seconds in discrete.rival_seconds(repeats).items():
        console.print(f"{name}: {seconds:.3f} s")


def shapes(console: Console, repeats: int) -> None:
    """Counterweights cut from plates beside those at the radii that they come to."""
    table = Table(title=f"counterweights cut from plates, least of {repeats}, milliseconds of the processor")
    for heading in ("case", "plates", "radii", "ratio"):
        table.add_column(heading, justify="left" if heading == "case" else "right")
    for name, body in plates.KINDS.items():
        plate, radius = plates.seconds(body, repeats)
        table.add_row(name, f"{plate * 1e3:.2f}", f"{radius * 1e3:.2f}", f"{plate / radius:.2f}")
    console.print(table)


def start_to_ready() -> float:
    """Seconds from starting the service to its first positive answer on /readyz."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [str(Path(sys.executable).with_name("counterweight")), "serve", "--port", str(port)]
    start = time.perf_counter()
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as service:
        try:
            while time.perf_counter() - start < READY_WITHIN_S:
                if ready(port):
                    return time.perf_counter() - start
                time.sleep(0.02)
            raise TimeoutError(f"the service was not ready within {READY_WITHIN_S} s")
        finally:
            service.terminate()


def ready(port: int) -> bool:
    try:
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/readyz", timeout=5) as answer:
            return bool(answer.status == 200)
    except (urllib.error.URLError, ConnectionError):
        return False


if __name__ == "__main__":
    main()
