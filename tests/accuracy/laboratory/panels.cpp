// The diagrams of speed against error leave no measure out, and draw nothing that a logarithmic axis can't
// show.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "accuracy/experiment_sheet.h"
#include "accuracy/particles.h"
#include "accuracy/spring.h"
#include "accuracy/stairs.h"

using namespace lks_accuracy;

namespace {

const auto silent = [](const std::string&) {};
const Grid single_step{{1}, {1}, 1};
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

Experiment at_a_single_step(MeasuredScene scene) {
    scene.ticks = scene.deviation_tick = 3;
    scene.reference_substeps = 2;
    if (scene.is_regular) {
        scene.later_ticks = {600, 3600};
    }
    return measure_particles(scene, single_step, silent);
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// Of all the panels of both sheets.
void check_panels(const Experiment& experiment, const std::set<std::string>& measures) {
    INFO(experiment.name);
    std::set<std::string> names;
    for (const Quantity& quantity : experiment.quantities) {
        names.insert(quantity.name);
    }
    CHECK(names == measures);
    for (const Across across : {Across::nanoseconds, Across::projections}) {
        const Sheet sheet = sheet_of(experiment, across);
        const std::string svg = drawn(sheet);
        CHECK(contains(svg, sheet.across));
        REQUIRE(sheet.panels.size() == experiment.quantities.size());
        for (std::size_t i = 0; i < sheet.panels.size(); ++i) {
            const Quantity& quantity = experiment.quantities[i];
            INFO(quantity.name);
            CHECK(sheet.panels[i].title == quantity.name + " (" + quantity.unit + ")");
            CHECK(contains(svg, ">" + sheet.panels[i].title + "<"));
            CHECK(sheet.panels[i].meaning == quantity.meaning);
            CHECK(quantity.meaning.size() > 20);
            for (const std::string& line : wrapped(quantity.meaning, 66)) {
                CHECK(contains(svg, ">" + line + "<"));
            }
            for (const Row& row : experiment.rows) {
                if (across == Across::nanoseconds && contains(row.solver, "double")) {
                    continue;
                }
                bool is_there = false;
                for (const Curve& curve : sheet.panels[i].curves) {
                    is_there =
                        is_there || (curve.solver == row.solver && curve.points.front().y == row.errors[i]);
                }
                INFO(row.solver);
                CHECK(is_there == (std::isfinite(row.errors[i]) && row.errors[i] > 0));
            }
        }
    }
}

// One measure, whose errors are those of 1 × 1, 2 × 1, 1 × 2 and 2 × 2.
Experiment made(const std::string& solver, const std::vector<double>& errors) {
    const std::vector<reference::Schedule> schedules{{1, 1}, {2, 1}, {1, 2}, {2, 2}};
    Experiment experiment{"made", "Made", "Made up."};
    experiment.quantities = {{"error", "m", "how far it is"}};
    for (std::size_t i = 0; i < errors.size(); ++i) {
        experiment.rows.push_back({solver, schedules[i], 10.0 + static_cast<double>(i), {errors[i]}});
    }
    return experiment;
}

std::vector<double> drawn_errors(const Panel& panel) {
    std::vector<double> errors;
    for (const Curve& curve : panel.curves) {
        for (const Point& point : curve.points) {
            errors.push_back(point.y);
        }
    }
    return errors;
}

// Where the points of a curve of substeps are across.
std::vector<double> places_across(const std::string& svg, const std::string& colour) {
    std::vector<double> places;
    const std::string line = "stroke=\"" + colour + "\" stroke-width=\"2\"";
    const std::size_t begin = svg.rfind("points=\"", svg.find(line)) + 8;
    const std::string points = svg.substr(begin, svg.find('"', begin) - begin);
    for (std::size_t at = 0; at != std::string::npos; at = points.find(' ', at)) {
        at += at == 0 ? 0 : 1;
        places.push_back(std::strtod(points.c_str() + at, nullptr));
    }
    return places;
}

} // namespace

TEST_CASE("every measure is drawn, with its unit and what it means") {
    const std::set<std::string> free{"stretch, worst", "stretch, mean", "deviation",
                                     "rounding",       "sag",           "energy drift"};
    std::set<std::string> pinned = free;
    pinned.insert({"support force, a tick", "support force, mean"});
    check_panels(at_a_single_step(rope_swing()), pinned);
    std::set<std::string> heavy_rope = pinned;
    heavy_rope.insert({"deviation, 10 s", "rounding, 10 s", "deviation, 60 s", "rounding, 60 s"});
    check_panels(at_a_single_step(rope_heavy_end()), heavy_rope);
    check_panels(at_a_single_step(cloth_drape()), free);
    check_panels(at_a_single_step(cloth_hang()), pinned);
    check_panels(
        measure_spring(single_step, {1, 10, 60}, silent),
        {"period", "height lost", "deviation, 1 s", "deviation, 10 s", "deviation, 60 s", "rounding"});
    check_panels(measure_stairs(single_step, 3, silent), {"joint separation, mean", "joint separation, worst",
                                                          "energy gained", "deviation", "rounding"});
}

TEST_CASE("a setting is on the curve of substeps, of iterations or beside both") {
    const Sheet sheet = sheet_of(made("fixed-point", {8, 4, 2, 1}), Across::projections);
    for (const Curve& curve : sheet.panels[0].curves) {
        std::vector<double> errors;
        for (const Point& point : curve.points) {
            errors.push_back(point.y);
        }
        CHECK(errors == (curve.sweep == Sweep::substeps     ? std::vector<double>{8, 4}
                         : curve.sweep == Sweep::iterations ? std::vector<double>{8, 2}
                                                            : std::vector<double>{1}));
    }
    CHECK(sheet.panels[0].curves.size() == 3);
    // Bullet's ten iterations a step are as few as there are.
    Experiment ten = made("Bullet", {8, 4});
    ten.rows[0].schedule.iterations = ten.rows[1].schedule.iterations = 10;
    const Sheet tens = sheet_of(ten, Across::projections);
    REQUIRE(tens.panels[0].curves.size() == 1);
    CHECK(tens.panels[0].curves[0].points[1].x == 20);
}

TEST_CASE("what is exactly zero or no number is said, not drawn") {
    Experiment experiment = made("fixed-point", {0, 1e-3, undefined, infinite});
    for (const Row& row : made("PBD", {undefined, undefined, undefined, undefined}).rows) {
        experiment.rows.push_back(row);
    }
    const Sheet sheet = sheet_of(experiment, Across::projections);
    CHECK(drawn_errors(sheet.panels[0]) == std::vector<double>{1e-3});
    CHECK(sheet.panels[0].remarks ==
          std::vector<std::string>{"Exactly 0, below any axis: fixed-point at 1 of 4.",
                                   "No finite number: fixed-point at 2 of 4.", "Not defined for: PBD."});
    const std::string svg = drawn(sheet);
    CHECK(contains(svg, ">Exactly 0, below any axis: fixed-point at 1 of 4.<"));
    CHECK_FALSE(contains(svg, "inf"));
    CHECK_FALSE(contains(svg, "nan"));

    const Sheet zeros = sheet_of(made("fixed-point", {0, 0, 0, 0}), Across::projections);
    CHECK(zeros.panels[0].curves.empty());
    CHECK(zeros.panels[0].remarks ==
          std::vector<std::string>{"Exactly 0, below any axis: fixed-point at every setting."});
    CHECK(contains(drawn(zeros), ">nothing that can be drawn<"));
    CHECK_FALSE(contains(drawn(zeros), "nan"));
    CHECK_FALSE(contains(drawn(zeros), "inf"));
}

TEST_CASE("double precision's cost says nothing, its error does") {
    const Experiment experiment = made("double", {8, 4, 2, 1});
    CHECK(sheet_of(experiment, Across::nanoseconds).panels[0].curves.empty());
    CHECK_FALSE(sheet_of(experiment, Across::projections).panels[0].curves.empty());
}

TEST_CASE("rounding is drawn beside what the method itself is off") {
    Experiment experiment = made("double", {8, 4});
    experiment.quantities.push_back({"rounding", "m", "", 0, 0});
    for (Row& row : experiment.rows) {
        row.errors.push_back(undefined);
    }
    const Panel rounding = sheet_of(experiment, Across::projections).panels[1];
    REQUIRE(rounding.curves.size() == 1);
    CHECK(rounding.curves[0].sweep == Sweep::backdrop);
    CHECK(drawn_errors(rounding) == std::vector<double>{8, 4});
}

TEST_CASE("axes are logarithmic, and nothing leaves its panel") {
    Sheet sheet{"Sheet", "across", {{"panel", "meaning", {{"one", "#123456", Sweep::substeps}}}}};
    sheet.panels[0].curves[0].points = {{1, 1e-9}, {10, 1}, {100, 1e9}};
    const std::vector<double> places = places_across(drawn(sheet), "#123456");
    REQUIRE(places.size() == 3);
    CHECK(std::abs((places[2] - places[1]) - (places[1] - places[0])) <= 0.2);
    CHECK(places[0] > 54);
    CHECK(places[2] > places[0]);
    CHECK(places[2] < 450 - 14);
}

TEST_CASE("the largest sheet is a small file, and signs of SVG's own are escaped") {
    Experiment experiment{"large", "Less < more & more", "Made up."};
    for (int i = 0; i < 11; ++i) {
        experiment.quantities.push_back({"error " + std::to_string(i), "m", "how far it is"});
    }
    for (const char* solver : {"fixed-point", "fixed-point, at once", "float32", "float32, at once", "double",
                               "double, at once", "PBD", "Bullet"}) {
        for (int substeps = 1; substeps <= 8; ++substeps) {
            for (int iterations = 1; iterations <= 5; ++iterations) {
                experiment.rows.push_back({solver,
                                           {substeps, iterations},
                                           10.0 * substeps * iterations,
                                           std::vector<double>(11, 1.0 / (substeps * iterations))});
            }
        }
    }
    const std::string svg = drawn(sheet_of(experiment, Across::projections));
    CHECK(svg.size() < 150000);
    CHECK(contains(svg, ">Less &lt; more &amp; more: "));
}

TEST_CASE("text is wrapped between words, by characters") {
    CHECK(wrapped("one two three", 7) == std::vector<std::string>{"one two", "three"});
    CHECK(wrapped("×××× ××", 7) == std::vector<std::string>{"×××× ××"});
    CHECK(wrapped("extraordinary", 5) == std::vector<std::string>{"extraordinary"});
    CHECK(wrapped("", 5).empty());
}
