"""Measures, fits and predicts how spincat scales: see experiments/scaling."""

import argparse
import dataclasses
import json
import math
import os
import pathlib
import statistics
import struct
import subprocess
import sys
import tempfile
import time

import scaling_page

BUILD = pathlib.Path("build")
COMMAND = str((BUILD / "release/spincat").resolve())
IMAGE_WIDTH = 20
LARGE_OBJECT = 500_000  # points: predicted, too
IMAGE_BYTES = IMAGE_WIDTH * IMAGE_WIDTH * 4
POINT_BYTES = 24
LAUNCHERS = {
    "openmpi": ["mpirun.openmpi", "--oversubscribe", "--bind-to", "none"],
    "mpich": ["mpirun.mpich"],
}
# What the predictions assume of machines that were not at hand.
HOST_CORES = 16            # one rank a host, a thread a core
NETWORK_BYTES = 1.0e9      # bytes a second from host to host
HOST_START = 0.05          # seconds of launching, for each doubling of the hosts


@dataclasses.dataclass
class Size:
    """What a problem takes."""
    units: float           # done by one process
    work: float            # distributed among all
    sent: float            # bytes to each other process
    returned: float        # bytes from all that are not the first process
    training: float = 0.0  # distributed, too, where processes are sent the table of features and its inner products:
    table: float = 0.0     # so many bytes each


def log(text):
    print(text, file=sys.stderr, flush=True)


def torus(file, count):
    """Writes a binary PLY mesh of about `count` vertices, the same every time."""
    rings = int(math.sqrt(count / 2))
    sides = 2 * rings
    vertices = bytearray()
    for i in range(rings):
        u = 2 * math.pi * i / rings
        for j in range(sides):
            v = 2 * math.pi * j / sides
            r = 1 + 0.4 * math.cos(u) + 0.05 * math.cos(7 * v) * math.sin(3 * u)
            vertices += struct.pack("<3f", r * math.cos(v), r * math.sin(v), 0.4 * math.sin(u))
    faces = bytearray()
    for i in range(rings):
        for j in range(sides):
            a, b = i * sides + j, i * sides + (j + 1) % sides
            c, d = (i + 1) % rings * sides + (j + 1) % sides, (i + 1) % rings * sides + j
            faces += struct.pack("<B3iB3i", 3, a, b, c, 3, a, c, d)
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {rings * sides}\nproperty float x\n"
            f"property float y\nproperty float z\nelement face {2 * rings * sides}\n"
            "property list uchar int vertex_indices\nend_header\n")
    pathlib.Path(file).write_bytes(head.encode() + vertices + faces)
    return rings * sides


def run(arguments, ranks, threads, mpi):
    """Seconds that the whole command takes, launcher included, and what it says on standard error."""
    line = [COMMAND, *arguments, "--threads", str(threads), "--journal", "none"]
    environment = dict(os.environ)
    if ranks > 1:
        line = [*LAUNCHERS[mpi], "-n", str(ranks), *line]
        if os.geteuid() == 0:
            environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    start = time.monotonic()
    result = subprocess.run(line, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, text=True, check=False)
    seconds = time.monotonic() - start
    if result.returncode != 0:
        sys.exit(f"{' '.join(line)}: {result.stderr}")
    if ranks > 1 and f"{ranks} ranks" not in result.stderr:
        sys.exit(f"{' '.join(line)}: did not run on {ranks} ranks: {result.stderr}")
    return seconds, result.stderr.strip().splitlines()[-1:] if ranks > 1 else []


def dense(file, folder, more=(), bin_size="0.1rel", width=IMAGE_WIDTH):
    """An image at each point of the object; the usual bins see the whole of it."""
    return ["spin", str(file), "-o", str(folder / "out.npy"), "--bin-size", bin_size, "--image-width", str(width),
            *more]


def described(file, folder, points, more=()):
    """The feature vector of images at so many points of the object's surface."""
    return ["describe", str(file), "-o", str(folder / "out.npy"), "--points", str(points), "--spin-points", str(points),
            "--plain-samples", "false", "--bin-size", "0.1rel", "--image-width", "16", *more]


def training(objects, folder, more=()):
    return ["train", *objects, "-o", str(folder / "out.spincat"), "--all", *more]


def measure(name, arguments, layouts, rounds, mpi):
    """Medians of the layouts (ranks, threads); they take turns, so that a noisy minute hits all of them."""
    times = {layout: [] for layout in layouts}
    last = {}
    for _ in range(rounds):
        for layout in layouts:
            seconds, report = run(arguments, *layout, mpi)
            times[layout].append(seconds)
            last[layout] = report
    for (ranks, threads), seconds in times.items():
        log(f"{name}: {ranks} ranks of {threads} threads: {statistics.median(seconds):.2f} s "
            f"({min(seconds):.2f} to {max(seconds):.2f}) {' '.join(last[ranks, threads])}")
    return {layout: statistics.median(seconds) for layout, seconds in times.items()}


def least_squares(rows, values):
    """Non-negative least squares of relative errors: terms that would be negative are left out, one by one."""
    columns = [c for c in range(len(rows[0])) if any(row[c] for row in rows)]
    while True:
        n = len(columns)
        matrix = [[0.0] * (n + 1) for _ in range(n)]
        for row, value in zip(rows, values):
            for a in range(n):
                for b in range(n):
                    matrix[a][b] += row[columns[a]] * row[columns[b]] / value**2
                matrix[a][n] += row[columns[a]] / value
        for a in range(n):  # Gauss
            pivot = max(range(a, n), key=lambda r: abs(matrix[r][a]))
            matrix[a], matrix[pivot] = matrix[pivot], matrix[a]
            if abs(matrix[a][a]) < 1e-30:
                matrix[a][a] = 1e-30
            for r in range(n):
                if r != a:
                    factor = matrix[r][a] / matrix[a][a]
                    matrix[r] = [x - factor * y for x, y in zip(matrix[r], matrix[a])]
        found = [matrix[a][n] / matrix[a][a] for a in range(n)]
        if min(found) >= 0:
            result = [0.0] * len(rows[0])
            for column, value in zip(columns, found):
                result[column] = value
            return result
        del columns[found.index(min(found))]


def fit(samples, size_of):
    """T = constant + per_unit units + (per_work work + per_training training) / p + launch (ranks > 1) + per_byte bytes

    Samples: (problem, ranks, threads, seconds); size_of gives a Size."""
    rows, values = [], []
    for problem, ranks, threads, seconds in samples:
        size = size_of(problem)
        many = ranks > 1
        moved = (size.sent + size.table) * (ranks - 1) + size.returned * (ranks - 1) / ranks
        workers = ranks * threads
        rows.append([1.0, size.units, size.work / workers, size.training / workers, float(many), float(moved)])
        values.append(seconds)
    names = ["constant", "per_unit", "per_work", "per_training", "launch", "per_byte"]
    model = dict(zip(names, least_squares(rows, values)))
    errors = [abs(sum(c * x for c, x in zip(model.values(), row)) / value - 1) for row, value in zip(rows, values)]
    model["largest_error"] = max(errors)
    return model


def predict(model, size, workers):
    """Training stays on the first host: with so many cores there, sending others the table takes longer."""
    hosts = max(1, math.ceil(workers / HOST_CORES))
    seconds = (model["constant"] + model["per_unit"] * size.units + model["per_work"] * size.work / workers
               + model["per_training"] * size.training / min(workers, HOST_CORES))
    if hosts > 1:
        bytes_moved = size.sent * (hosts - 1) + size.returned * (hosts - 1) / hosts
        seconds += model["launch"] + HOST_START * math.log2(hosts) + bytes_moved / NETWORK_BYTES
    return seconds


def svg(curves, file):
    """Speed-up over workers, both axes logarithmic."""
    width, height, left, bottom = 640, 420, 60, 50
    most = max(w for _, curve in curves for w, _ in curve)
    colours = ["#1b6ca8", "#c8553d", "#588157", "#6d597a"]

    def place(workers, gain):
        x = left + (width - left - 150) * math.log2(workers) / math.log2(most)
        y = height - bottom - (height - bottom - 20) * math.log2(max(gain, 0.5) / 0.5) / math.log2(most / 0.5)
        return f"{x:.1f},{y:.1f}"

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
             f'font-size="12"><rect width="{width}" height="{height}" fill="white"/>']
    tick = 1
    while tick <= most:
        x, y = place(tick, 0.5).split(",")
        parts.append(f'<text x="{x}" y="{float(y) + 18:.1f}" text-anchor="middle">{tick}</text>')
        x, y = place(1, tick).split(",")
        parts.append(f'<text x="{float(x) - 8:.1f}" y="{float(y) + 4:.1f}" text-anchor="end">{tick}</text>')
        parts.append(f'<polyline points="{place(1, tick)} {place(most, tick)}" fill="none" stroke="#ddd"/>')
        tick *= 4
    parts.append(f'<text x="{(left + width - 150) / 2}" y="{height - 12}" text-anchor="middle">workers (threads)</text>')
    parts.append(f'<text x="14" y="{height / 2}" transform="rotate(-90 14 {height / 2})" text-anchor="middle">'
                 "speed-up over one</text>")
    parts.append(f'<polyline points="{place(1, 1)} {place(most, most)}" fill="none" stroke="#999" stroke-dasharray="4"/>')
    for (name, curve), colour in zip(curves, colours):
        points = " ".join(place(w, g) for w, g in curve)
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>')
        x, y = place(*curve[-1]).split(",")
        parts.append(f'<text x="{float(x) + 6:.1f}" y="{float(y) + 4:.1f}" fill="{colour}">{name}</text>')
    pathlib.Path(file).write_text("\n".join(parts) + "\n</svg>\n")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def layouts_up_to(workers):
    """(ranks, threads): ranks alone, threads alone, and both."""
    found = [(1, 1)]
    p = 2
    while p <= workers:
        found += [(1, p), (p, 1)] + ([(2, p // 2)] if p >= 4 else [])
        p *= 2
    return found


def study_dense(options, folder):
    samples = []
    for count in options.points:
        file = folder / f"torus-{count}.ply"
        points = torus(file, count)
        for (ranks, threads), seconds in measure(f"{points} points", dense(file, folder), options.layouts, options.rounds,
                                                 options.mpi).items():
            samples.append((points, ranks, threads, seconds))
    size = lambda n: Size(units=n, work=n * n, sent=2 * POINT_BYTES * n, returned=IMAGE_BYTES * n)
    return "dense object", samples, fit(samples, size), size, max(s[0] for s in samples)


def study_training(options, folder):
    """The number of stretched copies makes the problem larger: describing grows with it, training with its square."""
    samples = []
    objects, features = 0, 0
    for copies in (1, 3, 6):
        arguments = training(options.objects, folder, ["--copies", str(copies)])
        for (ranks, threads), seconds in measure(f"training, {copies} copies", arguments, options.layouts,
                                                 options.rounds, options.mpi).items():
            samples.append((copies + 1, ranks, threads, seconds))
        model = json.loads(subprocess.run([COMMAND, "info", "--json", str(folder / "out.spincat")], check=True,
                                          stdout=subprocess.PIPE).stdout)
        objects, features = sum(model["object_counts"].values()), model["features"]

    def size(views):
        table = 4 * objects * features * views
        return Size(units=views, work=views, training=views * views, sent=100.0, returned=table,
                    table=table / 2 + 4 * (objects * views) ** 2)

    return "training", samples, fit(samples, size), size, 7


def divisions(options, folder):
    """The paper's division against ours, the same work."""
    file = folder / "torus-divide.ply"
    points = torus(file, options.points[0])
    rows = []
    workers = (options.most_workers, 1)
    for name, make in [(f"one object of {points} points, encoded",
                        lambda divide: described(file, folder, points, ["--divide", divide]))] + (
            [("training", lambda divide: training(options.objects, folder, ["--copies", "1", "--divide", divide]))]
            if options.objects else []):
        times = {}
        for divide in ("images", "sums"):
            times[divide] = measure(f"{name}, {divide} returned", make(divide), [workers], options.rounds,
                                    options.mpi)[workers]
        rows.append((name, f"{times['images']:.2f} s", f"{times['sums']:.2f} s",
                     f"{times['images'] / times['sums']:.2f}"))
    return rows


def report(studies, division_rows, options):
    text = ""
    curves = []
    predicted = {}
    for name, samples, model, size, largest in studies:
        alone = {problem: s for problem, ranks, threads, s in samples if (ranks, threads) == (1, 1)}
        text += f"## {name}: measured\n\n" + table(
            ["problem", "ranks", "threads each", "seconds", "speed-up"],
            [(p, r, t, f"{s:.2f}", f"{alone[p] / s:.2f}") for p, r, t, s in samples])
        text += "\n" + ", ".join(f"{k} = {v:.3g}" for k, v in model.items()) + "\n\n"
        for problem in [largest] + ([LARGE_OBJECT] if name == "dense object" else []):
            one = predict(model, size(problem), 1)
            counts = [2**k for k in range(0, 11)]
            curve = [(p, one / predict(model, size(problem), p)) for p in counts]
            curves.append((f"{name}, {problem}", curve))
            if problem == largest:
                predicted[name] = [(p, max(1, math.ceil(p / HOST_CORES)), one / gain) for p, gain in curve]
            text += f"## {name} ({problem}): predicted\n\n" + table(
                ["workers", "hosts", "seconds", "speed-up"],
                [(p, max(1, math.ceil(p / HOST_CORES)), f"{one / gain:.2f}", f"{gain:.1f}")
                 for p, gain in curve if p >= 8])
            text += "\n"
    text += "## The paper's division and ours\n\n" + table(
        ["work", "images returned (paper)", "sums returned", "ratio"], division_rows)
    (BUILD / "scaling.md").write_text(text)
    svg(curves, BUILD / "scaling.svg")
    (BUILD / "scaling.json").write_text(json.dumps(
        {"mpi": options.mpi, "rounds": options.rounds, "load": os.getloadavg(),
         "studies": [{"name": n, "samples": s, "model": m, "problem": largest, "predicted": predicted[n]}
                     for n, s, m, _, largest in studies],
         "divisions": division_rows}, indent=1))
    scaling_page.write(BUILD / "scaling.json", BUILD / "scaling.html")
    print(text)


def acceptance(options, folder):
    """Two ranks of one thread against one rank of one thread."""
    file = folder / "torus-500k.ply"
    points = torus(file, 500_000)
    works = [(f"{points} points, an image at each, support distance the object's radius",
              dense(file, folder, bin_size="0.05rel"))]
    if options.objects:
        works.append(("training", training(options.objects, folder)))
    for name, arguments in works:
        times = measure(name, arguments, [(1, 1), (2, 1)], options.rounds, options.mpi)
        print(f"{name}: {times[1, 1]:.2f} s on one rank, {times[2, 1]:.2f} s on two: "
              f"speed-up {times[1, 1] / times[2, 1]:.3f}", flush=True)


def main():
    parser = argparse.ArgumentParser(prog="experiments/scaling")
    parser.add_argument("--objects", nargs="+", default=[], help="a data set to train on")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--points", type=lambda text: [int(n) for n in text.split(",")], default=[20_000, 40_000, 80_000])
    parser.add_argument("--mpi", choices=sorted(LAUNCHERS), default="openmpi")
    parser.add_argument("--most-workers", type=int, default=os.cpu_count())
    parser.add_argument("--acceptance", action="store_true")
    options = parser.parse_args()
    options.layouts = layouts_up_to(options.most_workers)
    log(f"Load: {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
    with tempfile.TemporaryDirectory(dir=BUILD) as name:
        folder = pathlib.Path(name)
        if options.acceptance:
            acceptance(options, folder)
            return
        studies = [study_dense(options, folder)]
        if options.objects:
            studies.append(study_training(options, folder))
        report(studies, divisions(options, folder), options)


if __name__ == "__main__":
    main()
