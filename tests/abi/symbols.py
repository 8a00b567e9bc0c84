"""What the shared library shows and what it wants.

usage: symbols.py LIBRARY INCLUDE-FOLDER

It exports every function that the headers declare and nothing else, needs the C library alone and of it only
what is listed here, and has the soname by which a game will look for it.
"""
import pathlib
import re
import subprocess
import sys

library, include = sys.argv[1:3]
allowed_libraries = {"libc.so.6", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
allowed_functions = {
    "malloc", "free", "memcpy", "memmove", "memset", "memcmp", "strlen", "strcmp", "__stack_chk_fail",
    "getenv",  # LOCKSTITCH_SIMD
    # a world's own workers; in the C library since glibc 2.34
    "pthread_create", "pthread_join", "pthread_self", "sched_yield", "pthread_mutex_lock",
    "pthread_mutex_unlock", "pthread_mutex_destroy", "pthread_cond_wait", "pthread_cond_signal",
    "pthread_cond_broadcast", "pthread_cond_destroy",
    # every shared library's own start and end
    "__cxa_finalize", "__gmon_start__", "_ITM_deregisterTMCloneTable", "_ITM_registerTMCloneTable",
}
problems = []


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def symbols(which):
    lines = run("nm", "-D", "--format=posix", which, library).splitlines()
    return {line.split()[0].split("@")[0] for line in lines if line}


declared = set()
for header in pathlib.Path(include, "lockstitch").glob("*.h"):
    text = re.sub(r"/\*.*?\*/", " ", header.read_text(encoding="utf-8"), flags=re.S)
    declared |= set(re.findall(r"LKS_API\s[^;]*?\b(lks_\w+)\s*\(", text))
if not declared:
    problems.append(f"No declaration was found in {include}.")

exported = symbols("--defined-only")
for name in sorted(exported - declared):
    problems.append(f"{name} is exported, and no header declares it.")
for name in sorted(declared - exported):
    problems.append(f"{name} is declared in a header, and the library has not got it.")
for name in sorted(symbols("--undefined-only") - allowed_functions):
    problems.append(f"{name} is needed at run time.")

dynamic = run("readelf", "-d", library)
for name in re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic):
    if name not in allowed_libraries:
        problems.append(f"The library needs {name}.")
soname = re.findall(r"\(SONAME\).*\[(.*)\]", dynamic)
if soname != ["liblockstitch.so.0"]:
    problems.append(f"The soname is {soname}.")

print(f"{len(exported)} functions exported, {len(declared)} declared")
if problems:
    sys.exit("\n".join(problems))
