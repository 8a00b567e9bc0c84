"""No floating point in the SDK but in the files that are there for it: nothing else may round.

usage: integers_only.py sources SDK-SOURCE-FOLDER
       integers_only.py objects OBJECT-FILE...

Files whose name begins with "authoring" take doubles apart bit by bit; files whose name begins with "view"
make floats for drawing. `sources` looks for words that have no place elsewhere; `objects` disassembles what
the compiler made of them: authoring files may carry a double around, but only view files may compute with
one. Kernels may convert an integer to a float to read its leading bit from the exponent, which is exact in
every mode of the unit, and nothing else; and they share no function with other objects, which might then run
it on a processor that has not got its instructions. And no object may have data that can be written: there is
no global state.
"""
import pathlib
import re
import subprocess
import sys

# Each with the reason that is printed. Words of comments and strings don't count.
denied_words = [
    (r"\b(?:float|double|float_t|double_t)\b", "a floating-point type"),
    (r"\b(?:cmath|math\.h|cfloat|float\.h|random|ctime|time\.h|chrono|locale|iostream|thread|mutex)(?=>)",
     "a header of floating point, time, chance, threads or the locale"),
]
denied_everywhere = [
    (r"\b__int128\b", "a type that MSVC and 32-bit targets have not got"),
    (r"\bunordered_(?:map|set|multimap|multiset)\b", "a container whose order is not defined"),
    (r"\b(?:std::hash|rand|srand|getenv|std::clock|gettimeofday)\b",
     "something that differs between two machines"),
    (r"\b(?:throw|try|catch|dynamic_cast|typeid)\b", "an exception or run-time type information"),
    (r"\b_mm\d*_\w+|\b__m\d+i?\b|\bimmintrin\.h|\barm_neon\.h", "an intrinsic outside kernels"),
    (r"\b__(?:attribute__|builtin_\w+|asm__)|\basm\b", "a compiler extension"),
]

# Have products by the compiler's own type where there is one, and by halves beside it, and quotients by the
# processor's own instruction, and by digits; a test compares them.
two_ways = ("fixed/int128.h", "fixed/product_sum.h")

# x86-64: arithmetic, comparison, conversion and rounding of scalar or packed floating point, and all of x87.
# Moves, shuffles and bit operations of the same registers serve integers too.
float_instruction = re.compile(
    r"^v?(?:add|sub|mul|div|sqrt|min|max|rcp|rsqrt|hadd|hsub|addsub|dp|round|rndscale|getexp|getmant|"
    r"scalef|range|reduce|fixupimm|rcp14|rsqrt14)[sp][sdh]$"
    r"|^v?cmp\w*[sp][sdh]$|^v?u?comis[sdh]$|^v?cvt\w+$|^vfn?m(?:add|sub)\w+$|^f(?!s$|xsave|xrstor)[a-z0-9]+$")


def is_view(path):
    return path.name.startswith("view")


def is_authoring(path):
    return path.name.startswith("authoring")


def without_comments(text):
    def blank(match):
        found = match.group(0)
        return '""' if found[0] == '"' else re.sub(r"[^\n]", " ", found)

    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', blank, text, flags=re.S)


def source_problems(path, folder):
    rules = list(denied_everywhere)
    if "kernels" in path.relative_to(folder).parts:
        allowed = ("an intrinsic", "a compiler extension", "something that differs")
        rules = [rule for rule in rules if not rule[1].startswith(allowed)]
    if path.relative_to(folder).as_posix() in two_ways:
        rules = [rule for rule in rules if not rule[1].startswith(("a type that", "a compiler extension"))]
    if not is_view(path) and not is_authoring(path):
        rules += denied_words
    text = without_comments(path.read_text(encoding="utf-8"))
    for number, line in enumerate(text.splitlines(), 1):
        for pattern, reason in rules:
            found = re.search(pattern, line)
            if found:
                yield f"{path}:{number}: '{found.group(0)}' is {reason}."


def check_sources(folder):
    files = sorted(p for p in folder.rglob("*") if p.suffix in (".h", ".cpp"))
    if not files:
        return ["No sources were found."]
    print(f"{len(files)} sources")
    return [problem for path in files for problem in source_problems(path, folder)]


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def float_instructions(path):
    """(function, instruction) pairs."""
    function = ""
    for line in run("objdump", "-d", "-C", "--no-show-raw-insn", str(path)).splitlines():
        header = re.match(r"[0-9a-f]+ <(.*)>:$", line)
        if header:
            function = header.group(1)
            continue
        parts = line.split("\t")
        if len(parts) > 1:
            words = parts[1].split()
            if words and float_instruction.match(words[0]):
                yield function, words[0]


def writable_data(path):
    """Names of objects in .data and .bss; pointers that only the loader writes are in .data.rel.ro."""
    for line in run("objdump", "-t", "-C", str(path)).splitlines():
        found = re.match(r"[0-9a-f]+ .{7} \.t?(?:data|bss)(?:\.(?!rel\.ro)\S*)?\s+([0-9a-f]+)\s+(.*)$", line)
        if found and int(found.group(1), 16) > 0:
            yield found.group(2)


def shared_functions(path):
    """Names of weak functions: of several copies the linker keeps any one."""
    for line in run("objdump", "-t", "-C", str(path)).splitlines():
        found = re.match(r"[0-9a-f]+ (.{7}) (\S+)\s+[0-9a-f]+\s+(.*)$", line)
        if found and "w" in found.group(1) and "F" in found.group(1):
            yield found.group(3)


def check_objects(paths):
    problems, seen_in_view = [], 0
    for path in paths:
        found = list(float_instructions(path))
        if path.name.startswith("kernels_"):
            found = [(function, word) for function, word in found if not re.match(r"v?cvtdq2ps$", word)]
            problems += [f"{path.name}: {name} is a function that other objects may share."
                         for name in shared_functions(path)]
        if is_view(path):
            seen_in_view += len(found)
        else:
            problems += [f"{path.name}: {function} has the instruction {word}." for function, word in found]
        problems += [f"{path.name}: {name} is data that can be written." for name in writable_data(path)]
    print(f"{len(paths)} objects; {seen_in_view} floating-point instructions in view files")
    if seen_in_view == 0:
        problems.append("No floating-point instruction was seen in the view files: the check is blind.")
    return problems


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "sources":
        problems = check_sources(pathlib.Path(sys.argv[2]))
    elif len(sys.argv) > 2 and sys.argv[1] == "objects":
        problems = check_objects([pathlib.Path(name) for name in sys.argv[2:]])
    else:
        sys.exit("usage: integers_only.py sources FOLDER | objects FILE...")
    if problems:
        sys.exit("\n".join(problems))


main()
