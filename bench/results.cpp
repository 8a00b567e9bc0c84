#include "results.h"

#include <cstdio>

namespace lks_bench {
namespace {

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

} // namespace

const Result* find(const Results& results, const std::string& workload, const std::string& measured,
                   const std::string& variant) {
    for (const Result& result : results) {
        if (result.workload == workload && result.measured == measured && result.variant == variant) {
            return &result;
        }
    }
    return nullptr;
}

std::string to_json(const Results& results) {
    std::string text = "[";
    const char* separator = "\n";
    for (const Result& r : results) {
        text += separator;
        text += R"({"workload": ")" + r.workload + R"(", "measured": ")" + r.measured + R"(", "variant": ")" +
                r.variant + R"(", "value": )" + number(r.value) + R"(, "unit": ")" + r.unit + "\"";
        if (r.ratio != 0) {
            text += R"(, "ratio": )" + number(r.ratio);
        }
        if (r.best != 0) {
            text += R"(, "best": )" + number(r.best);
        }
        if (r.low != 0) {
            text += R"(, "low": )" + number(r.low) + R"(, "high": )" + number(r.high);
        }
        text += "}";
        separator = ",\n";
    }
    return text + "\n]\n";
}

std::string to_csv(const Results& results) {
    std::string text = "workload,measured,variant,value,unit,ratio,best,low,high\n";
    const auto unless_zero = [](double value) { return value != 0 ? number(value) : std::string(); };
    for (const Result& r : results) {
        text += "\"" + r.workload + "\",\"" + r.measured + "\",\"" + r.variant + "\"," + number(r.value) +
                ",\"" + r.unit + "\"," + unless_zero(r.ratio) + "," + unless_zero(r.best) + "," +
                unless_zero(r.low) + "," + unless_zero(r.high) + "\n";
    }
    return text;
}

} // namespace lks_bench
