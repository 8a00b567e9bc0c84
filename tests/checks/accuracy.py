"""`lockstitch accuracy` runs, says what each solver is off and what it costs, and refuses by name.

usage: accuracy.py LOCKSTITCH
"""
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

program = sys.argv[1]


def run(*arguments, expected=0):
    done = subprocess.run([program, "accuracy", *arguments], capture_output=True, text=True)
    if done.returncode != expected:
        sys.exit(f"{arguments} ended with {done.returncode}: {done.stderr}")
    return done


def measure(*parts):
    return json.loads(run(*parts, "--quick", "--json").stdout)


def value(results, measured, variant):
    found = [r["value"] for r in results if (r["measured"], r["variant"]) == (measured, variant)]
    if len(found) != 1 or not math.isfinite(found[0]):
        sys.exit(f"{measured} of '{variant}' was not measured: {found}")
    return found[0]


rope = measure("rope_swing")
if len({(r["measured"], r["variant"]) for r in rope}) != len(rope):
    sys.exit("A result is there twice.")
ours = "fixed-point", "float32", "double"
for solver in *ours, *(f"{one}, at once" for one in ours):
    if value(rope, "cost", f"{solver}, 20 × 1") <= 0:
        sys.exit(f"{solver} costs nothing.")
    # More work, less error.
    few, many = (value(rope, "stretch, worst", f"{solver}, {n} × 1") for n in (5, 20))
    if not many < few:
        sys.exit(f"{solver} does not gain by substeps.")
if not value(rope, "rounding", "fixed-point, 20 × 1") < value(rope, "rounding", "float32, 20 × 1"):
    sys.exit("Fixed-point rounds more than float32.")
# Of a rope, all segments at once leave less than a hundredth of what sweeps do.
swept, at_once = (
    value(rope, "stretch, worst", f"fixed-point{suffix}, 20 × 1") for suffix in ("", ", at once"))
if not at_once < swept / 100:
    sys.exit("A rope that is solved at once stretches like one that is swept.")
stairs = measure("ragdoll_stairs")
if not 0 < value(stairs, "joint separation, mean", "fixed-point, 20 × 1") < 0.01:
    sys.exit("Joints on the stairs are not together.")

if "'rope_swin'" not in run("rope_swin", expected=2).stderr:
    sys.exit("An unknown experiment was not refused by name.")
if "paper_balloon" not in run("--list").stdout:
    sys.exit("--list does not list the balloon.")
if "--list" not in run("--list", "paper_spring", expected=2).stderr:
    sys.exit("What is to be measured was left out beside --list.")
if "--report" not in run("paper_spring", "--report", "", expected=2).stderr:
    sys.exit("A report without a folder was not refused.")
with tempfile.NamedTemporaryFile() as file:
    for folder in "/dev/null/report", "/proc/report", file.name:
        refused = run("paper_spring", "--report", folder, expected=1)
        if folder not in refused.stderr or "accuracy: paper_spring" in refused.stderr:
            sys.exit(f"{folder} was not refused by name before anything was measured: {refused.stderr}")

with tempfile.TemporaryDirectory() as folder:
    drawn = shutil.which("gnuplot") is not None
    parts = ("paper_spring", "paper_cloth", "paper_balloon", "spring")
    done = run(*parts, "--quick", "--report", folder, expected=0 if drawn else 1)
    if "accuracy: spring" not in done.stderr:
        sys.exit("There was no progress.")
    made = {path.name for path in pathlib.Path(folder).iterdir()}
    # Those of the paper's experiments are gnuplot's.
    plots = {"paper-spring.svg", "paper-cloth.svg", "paper-balloon.svg"} if drawn else set()
    if drawn and "the paper" not in pathlib.Path(folder, "paper-cloth.svg").read_text():
        sys.exit("The plot of the paper's cloth has not the paper's figures.")
    sheets = {"spring.svg", "spring-projections.svg"}
    plots |= sheets
    if made != {"report.md", "results.json", "results.csv"} | plots:
        sys.exit(f"The report consists of {sorted(made)}.")
    text = pathlib.Path(folder, "report.md").read_text()
    if "## The paper's spring" not in text or "| fixed-point | 60.0 | 10 |" not in text:
        sys.exit("The report doesn't tell of the spring.")
    rows = [row.split("|")[-2].strip() for row in text.splitlines()
            if row.startswith("| fixed-point | 160 |")]
    if rows != ["5.65"]:
        sys.exit(f"The paper's cloth takes {rows} ms there, not 5.65.")
    results = json.loads(pathlib.Path(folder, "results.json").read_text())
    if len(results) < 50:
        sys.exit("The results are too few.")
    measures = {f"{r['measured']} ({r['unit']})" for r in results
                if r["workload"] == "spring" and r["measured"] not in ("cost", "passes")}
    for name in sheets:
        picture = xml.etree.ElementTree.parse(pathlib.Path(folder, name))
        left_out = measures - {element.text for element in picture.iter()}
        if left_out or len(measures) < 5:
            sys.exit(f"{name} leaves out {sorted(left_out)} of {sorted(measures)}.")
        if f"({name})" not in text:
            sys.exit(f"The report doesn't show {name}.")
print("measured, refused and reported")
