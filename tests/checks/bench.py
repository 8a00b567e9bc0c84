"""The benchmark runs, and says of each workload what it is and of each instruction set what it costs.

usage: bench.py LOCKSTITCH-BENCH
"""
import json
import subprocess
import sys

program = sys.argv[1]


def lines(*arguments):
    done = subprocess.run([program, *arguments], check=True, capture_output=True, text=True)
    return done.stdout.splitlines()


counts = {"cloth_64": "23938 constraints", "cloth_50": "14502 constraints", "ropes_200": "19800 constraints"}
for name, count in counts.items():
    printed = lines("--rounds", "1", name)
    if count not in printed[0]:
        sys.exit(f"{name} has not {count}: {printed[0]}")
results = [json.loads(line) for line in lines("--rounds", "1", "--json", "cloth_50")]
measured = {(result["measured"], result["variant"]) for result in results}
for wanted in ("projection", "scalar"), ("tick", "scalar"), ("projection", "float32 plain, by index"):
    if wanted not in measured:
        sys.exit(f"{wanted} was not measured.")
if not all(result["ns"] > 0 and result["ratio"] > 0 for result in results):
    sys.exit("Something took no time.")
refused = subprocess.run([program, "clot_64"], capture_output=True, text=True)
if refused.returncode != 2 or "'clot_64'" not in refused.stderr:
    sys.exit("An unknown workload was not refused by name.")
print(f"{len(results)} results of cloth_50")
