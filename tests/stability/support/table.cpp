#include "stability/support/table.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <vector>

namespace stability {
namespace {

struct Row {
    std::string scene, figure, bound, measured, margin, single;
};

std::vector<Row>& rows() {
    static std::vector<Row> all;
    return all;
}

std::string text(double value, const std::string& unit) {
    if (!std::isfinite(value)) {
        return "not finite";
    }
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.3g", value);
    return unit.empty() ? digits : digits + (" " + unit);
}

// How many times what was measured fits into the bound.
std::string margin_of(double greater, double less) {
    if (greater == less) {
        return "exact";
    }
    if (!(less > 0)) {
        return "∞";
    }
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.2g ×", greater / less);
    return digits;
}

void keep(const std::string& scene, const std::string& figure, const std::string& unit,
          const std::string& bound, const std::string& margin, double measured, const Twin& single) {
    const std::string twin = single.why_none() == nullptr ? text(single.figure(), unit)
                                                          : std::string("none: ") + single.why_none();
    rows().push_back({scene, figure, bound, text(measured, unit), margin, twin});
}

// Prints the rows after the last test.
class Printer : public doctest::IReporter {
public:
    explicit Printer(const doctest::ContextOptions&) {}

    void test_run_end(const doctest::TestRunStats&) override {
        if (rows().empty()) {
            return;
        }
        std::cout << "| scene | figure | bound | measured | margin | float32 |\n|---|---|---|---|---|---|\n";
        std::string scene;
        for (const Row& row : rows()) {
            std::cout << "| " << (row.scene == scene ? "" : row.scene) << " | " << row.figure << " | "
                      << row.bound << " | " << row.measured << " | " << row.margin << " | " << row.single
                      << " |\n";
            scene = row.scene;
        }
        std::cout << std::flush;
    }

    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_case_start(const doctest::TestCaseData&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_end(const doctest::CurrentTestCaseStats&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}
};

DOCTEST_REGISTER_LISTENER("stability_table", 1, Printer);

} // namespace

void expect_at_most(const std::string& scene, const std::string& figure, const std::string& unit,
                    double bound, double measured, const Twin& single) {
    INFO(scene << ": " << figure << ", " << unit);
    CHECK(measured <= bound);
    keep(scene, figure, unit, "≤ " + text(bound, unit), margin_of(bound, measured), measured, single);
}

void expect_at_least(const std::string& scene, const std::string& figure, const std::string& unit,
                     double bound, double measured, const Twin& single) {
    INFO(scene << ": " << figure << ", " << unit);
    CHECK(measured >= bound);
    keep(scene, figure, unit, "≥ " + text(bound, unit), margin_of(measured, bound), measured, single);
}

void tell(const std::string& scene, const std::string& figure, const std::string& unit, double measured,
          const Twin& single) {
    keep(scene, figure, unit, "", "", measured, single);
}

} // namespace stability
