"""The benchmark runs, and says of each workload what it is and of each variant what it costs.

usage: bench.py LOCKSTITCH [LOCKSTITCH-BENCH]
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

program = sys.argv[1]


def run(*arguments, expected=0, **settings):
    done = subprocess.run(arguments, capture_output=True, text=True, **settings)
    if done.returncode != expected:
        sys.exit(f"{arguments} ended with {done.returncode}: {done.stderr}")
    return done


def measure(*parts):
    return json.loads(run(program, "bench", *parts, "--rounds", "1", "--json").stdout)


def result(results, measured, variant):
    found = [r for r in results if (r["measured"], r["variant"]) == (measured, variant)]
    if not found or found[0]["value"] <= 0:
        sys.exit(f"{measured} of '{variant}' was not measured: {found}")
    return found[0]


def value(results, measured, variant):
    return result(results, measured, variant)["value"]


constraints = {
    "cloth_64": 23938,
    "cloth_64_area": 23938,
    "cloth_50": 14502,
    "mesh_10k": 29642,
    "mesh_10k_area": 29642,
    "ropes_200": 19800,
}
# Peers refuse to be measured where they don't share corrections out by the asset's masses.
for name, count in constraints.items():
    if value(measure(name), "constraints", "") != count:
        sys.exit(f"{name} has not {count} constraints.")
listed = run(program, "bench", "--list").stdout.split()
for base in "cloth_64", "cloth_256", "mesh_10k", "ropes_200", "ropes_1000":
    for name in base, base + "_1x20", base + "_5x4", base + "_colliders":
        if name not in listed:
            sys.exit(f"{name} is not among the workloads.")
over = measure("ropes_1000_colliders")
for variant in "scalar", "float32 runs, scalar", "float32 plain, coloured":
    value(over, "tick", variant)
# What is measured as lying on spheres does: points are in reach of a surface, and none far below it.
lying = measure("cloth_64_colliders")
deepest = {"scalar": 0.01, "float32 runs, scalar": 0.01, "float32 plain, coloured": 0.01}
if any(r["variant"] == "Bullet soft body" for r in lying):
    deepest["Bullet soft body"] = 4
for variant, most in deepest.items():
    points = value(lying, "resting", variant)
    depth = [r["value"] for r in lying if (r["measured"], r["variant"]) == ("deepest", variant)]
    if points < 100 or not depth or depth[0] > most:
        sys.exit(f"{variant} lies on spheres with {points} points, the deepest of them {depth} mm below.")
for variant in "scalar", "scalar, 2 workers":
    value(over, "threads", variant)
ratios = measure("ratios")
for measured in "soft / stiff", "damped / stiff", "damped / soft", "256² / 64²", "ropes / cloth":
    found = result(ratios, measured, "scalar")
    if not 0 < found["low"] == found["value"] == found["high"]:
        sys.exit(f"Of one round the quartiles are not the median: {found}")
snapshots = measure("snapshots")
for measured in "save", "load", "hash", "memcpy":
    value(snapshots, measured, "scalar")
cloth = measure("cloth_50")
for measured in "projection", "tick":
    for variant in "scalar", "float32 runs, scalar", "float32 plain, by index":
        of_one_round = result(cloth, measured, variant)
        if of_one_round["best"] != of_one_round["value"]:
            sys.exit(f"Of one round the best is not the median: {of_one_round}")
value(cloth, "in runs", "")
value(measure("overhead"), "tick", "empty world")
value(measure("sleep"), "tick", "100 humanoids asleep")
queries = measure("queries")
for measured in "ray", "overlap of 50 cm", "nearest within 1 m":
    for variant in "a plane", "100 humanoids", "10,000 balls", "4,000 boxes that stay", "a cloth of 256²":
        value(queries, measured, variant)
lying = measure("contacts")
for support in "plane", "box", "15 capsules that turn":
    value(lying, support, "scalar")
for fall in "ragdolls_100", "ragdolls_pile":
    results = measure(fall)
    value(results, "ticks of the 300 of a fall: no figures to compare", "")
    for measured in "whole tick", "slowest tick", "snapshot, save", "snapshot, load":
        value(results, measured, "8 substeps")
    for measured in "joint error, worst", "beyond limits, worst", "contacts, mean":
        if (measured, "8 substeps") not in [(r["measured"], r["variant"]) for r in results]:
            sys.exit(f"{measured} of {fall} was not measured.")  # nought in the air
dressed = measure("ragdolls_dressed")
for variant in "coupled", "attached only", "side by side", "bodies alone", "coupled, two workers":
    value(dressed, "whole tick", f"20 substeps, {variant}")
for measured in "joint error, worst", "attachment error, mean", "attachment error, worst":
    value(dressed, measured, "8 substeps, coupled")
balls = measure("bodies_growth")
for count in 1250, 20000:
    value(balls, "tick", f"{count} balls")
ropes = measure("ropes_swing")
for variant in "swept, 10 substeps", "at once, 10 substeps":
    value(ropes, "tick a segment, 1:10,000", variant)
    value(ropes, "worst stretch, 1:10,000", variant)

refused = run(program, "bench", "clot_64", expected=2)
if "'clot_64'" not in refused.stderr:
    sys.exit("An unknown workload was not refused by name.")
if "--list" not in run(program, "bench", "--list", "cloth_50", expected=2).stderr:
    sys.exit("What is to be measured was left out beside --list.")
if "--report" not in run(program, "bench", "cloth_50", "--report", "", expected=2).stderr:
    sys.exit("A report without a folder was not refused.")
with tempfile.NamedTemporaryFile() as file:
    for folder in "/dev/null/report", "/proc/report", file.name:
        refused = run(program, "bench", "cloth_50", "--rounds", "1", "--report", folder, expected=1)
        if folder not in refused.stderr or "bench: cloth_50" in refused.stderr:
            sys.exit(f"{folder} was not refused by name before anything was measured: {refused.stderr}")
with tempfile.TemporaryDirectory() as folder:
    told = run(program, "bench", "cloth_50", "--rounds", "1", "--report", folder,
               expected=1, env={"PATH": ""})
    if not 0 <= told.stderr.find("gnuplot") < told.stderr.find("bench: cloth_50"):
        sys.exit(f"That gnuplot is missing was not said before anything was measured: {told.stderr}")

with tempfile.TemporaryDirectory() as folder:
    drawn = shutil.which("gnuplot") is not None
    run(program, "bench", "cloth_50", "--rounds", "1", "--report", folder, expected=0 if drawn else 1)
    made = {path.name for path in pathlib.Path(folder).iterdir()}
    plots = {"cost-against-simd.svg", "ours-against-peers.svg"} if drawn else set()
    if made != {"report.md", "results.json", "results.csv"} | plots:
        sys.exit(f"The report consists of {sorted(made)}.")
    text = pathlib.Path(folder, "report.md").read_text()
    if not re.search(r"\| cloth_50 \| .*14502 \|", text) or "float32 plain, coloured" not in text:
        sys.exit("The report doesn't tell of cloth_50.")
    if not re.search(r"solver version \d+; \d{4}-\d\d-\d\d UTC", text):
        sys.exit("The report doesn't say of what solver it is, and when it was made.")
    json.loads(pathlib.Path(folder, "results.json").read_text())
    table = pathlib.Path(folder, "results.csv").read_text().splitlines()
    if table[0] != "workload,measured,variant,value,unit,ratio,best,low,high":
        sys.exit(f"The columns of results.csv are {table[0]}.")

if len(sys.argv) > 2:
    lines = run(sys.argv[2], "--benchmark_filter=^cloth_50/tick/scalar$", "--benchmark_min_time=0.01").stdout
    if "cloth_50/tick/scalar" not in lines or "s/projection=" not in lines:
        sys.exit(f"lockstitch-bench said: {lines}")
    run(sys.argv[2], "--benchmark_filter=no_such_thing", expected=2)
print("measured, refused and reported")
