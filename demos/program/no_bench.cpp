// In place of bench.cpp where the program was built without the benchmark.
#include "program/commands.h"
#include "program/messages.h"

namespace lks_program {

int bench(const BenchOptions&) {
    return complain("This build has no benchmark; configure it with -DLOCKSTITCH_BENCH=ON.", exit_failed);
}

} // namespace lks_program
