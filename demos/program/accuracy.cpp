#include "accuracy/accuracy_command.h"

#include <cstdio>

#include "program/commands.h"
#include "program/messages.h"

namespace lks_program {

int accuracy(const AccuracyOptions& options) {
    lks_accuracy::AccuracyOptions passed;
    passed.parts = options.parts;
    passed.quick = options.quick;
    passed.long_times = options.long_times;
    passed.list = options.list;
    passed.json = options.json;
    passed.report = options.report;
    return lks_accuracy::run_accuracy(
        passed, [](const std::string& sentence) { complain(sentence, exit_failed); },
        [](const std::string& part) { std::fprintf(stderr, "accuracy: %s ...\n", part.c_str()); });
}

} // namespace lks_program
