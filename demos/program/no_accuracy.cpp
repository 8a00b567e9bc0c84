// In place of accuracy.cpp where the program was built without the reference solvers.
#include "program/commands.h"
#include "program/messages.h"

namespace lks_program {

int accuracy(const AccuracyOptions&) {
    return complain(
        "This build has no reference solvers; install Eigen (libeigen3-dev) and configure it with "
        "-DLOCKSTITCH_BENCH=ON.",
        exit_failed);
}

} // namespace lks_program
