// Masses of eight links on ball joints and hinges: heavy and light in turn, at random, and with a light end.
// Points hold at any of them; axes of hinges that carry a load across them do not.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "stability/support/jointed.h"
#include "stability/support/table.h"
#include "support/sanitised.h"

using namespace support;
using namespace stability;

namespace {

constexpr int links = 8;
constexpr double link_length = 0.3;

enum class Order { in_turn, at_random, light_end, heavy_end };

std::string name_of(Order order) {
    switch (order) {
    case Order::in_turn:
        return "in turn";
    case Order::at_random:
        return "at random";
    case Order::light_end:
        return "the end light";
    case Order::heavy_end:
        break;
    }
    return "the end heavy";
}

// Kilograms.
std::vector<double> masses_of(Order order, double ratio) {
    std::vector<double> masses;
    Random random(3);
    for (int i = 0; i < links; ++i) {
        const bool heavy = order == Order::in_turn     ? i % 2 == 1
                           : order == Order::at_random ? random.between(0, 1) == 1
                           : order == Order::light_end ? i + 1 < links
                                                       : i + 1 == links;
        masses.push_back(heavy ? 0.1 * ratio : 0.1);
    }
    return masses;
}

// What the links hang by: axes of hinges are level, across the chain, or upright, so that nothing may turn.
enum class Link { ball, level_hinge, upright_hinge };

std::string name_of(Link link) {
    return link == Link::ball ? "ball joints" : link == Link::level_hinge ? "level hinges" : "upright hinges";
}

// A level chain on an anchor.
void add_chain(Jointed& scene, Link kind, const std::vector<double>& masses) {
    std::size_t above = scene.add_anchor({});
    for (int i = 0; i < links; ++i) {
        lks_body_def def = lks_default_body_def();
        def.transform = turned(at(link_length * (i + 0.5), 0, 0), 0, 0, 1, -90);
        def.mass = support::fixed(masses[static_cast<std::size_t>(i)]);
        const std::size_t link = scene.add(capsule_shape(0.05, 0.1), def);
        lks_joint_def joint = lks_default_joint_def();
        joint.frame_a.position = support::fixed(0, i == 0 ? 0 : link_length / 2, 0);
        joint.frame_b.position = support::fixed(0, -link_length / 2, 0);
        if (kind != Link::ball) {
            joint.kind = LKS_JOINT_HINGE;
            // The links lie on their sides, the anchor stands.
            const lks_rotation upright = lks_transform_identity().rotation;
            const lks_rotation lying = turned(lks_transform_identity(), 0, 0, 1, 90).rotation;
            const lks_rotation across = turned(lks_transform_identity(), 1, 0, 0, 90).rotation;
            const bool level = kind == Link::level_hinge;
            joint.frame_a.rotation = level ? across : i == 0 ? upright : lying;
            joint.frame_b.rotation = level ? across : lying;
        }
        scene.join(joint, above, link);
        above = link;
    }
}

// At all ratios, the worst. `gap` in millimetres.
void swing(Link kind, Order order, std::uint32_t substeps, double gap) {
    Worst apart, gained;
    for (const double ratio : {10.0, 1e3, 1e6}) {
        if (support::sanitised && ratio == 1e3) {
            continue;
        }
        Jointed scene(world_def(60, substeps));
        add_chain(scene, kind, masses_of(order, ratio));
        const JointCourse course = run(scene, 300);
        apart.add(1000 * course.gap.fixed, 1000 * course.gap.single);
        gained.add(100 * course.gained_share.fixed, 100 * course.gained_share.single);
    }
    const std::string name =
        named("8 links on ", name_of(kind), ", 1:10 to 1:1e6 ", name_of(order), ", 60 Hz × ", substeps);
    expect_at_most(name, "joints apart, worst", "mm", gap, apart.fixed, apart.single);
    expect_at_most(name, "energy gained, of the greatest motion", "%", 0.1, gained.fixed, gained.single);
}

struct Cantilever {
    Order order;
    double ratio;
    std::uint32_t substeps;
    double gap;   // mm
    double droop; // m, of the end's middle
    double angle; // degrees between two neighbours, or the first one and the level
};

// Hinges about the vertical: the chain stays level by their axes alone.
void cantilever(const Cantilever& row) {
    Jointed scene(world_def(60, row.substeps));
    add_chain(scene, Link::upright_hinge, masses_of(row.order, row.ratio));
    Worst gap, droop, angle;
    const auto bent = [](const std::vector<Vector>& middles) {
        double worst = 0;
        for (std::size_t i = 1; i < middles.size(); ++i) {
            const Vector before = i == 1 ? Vector{1, 0, 0} : middles[i - 1] - middles[i - 2];
            const Vector way = middles[i] - middles[i - 1];
            const double slope = std::atan2(way.y, std::hypot(way.x, way.z));
            const double slope_before = std::atan2(before.y, std::hypot(before.x, before.z));
            const double turn = std::abs(slope - slope_before) * 180 / std::numbers::pi;
            worst = turn <= worst ? worst : turn; // also where it is no number
        }
        return worst;
    };
    for (int tick = 0; tick < 300; ++tick) {
        scene.step();
        gap.add(1000 * scene.gap(), 1000 * scene.twin_gap());
        std::vector<Vector> middles{{0, 0, 0}}, twin_middles{{0, 0, 0}};
        for (std::size_t i = scene.size() - links; i < scene.size(); ++i) {
            middles.push_back(scene.position(i));
            twin_middles.push_back(scene.twin_position(i));
        }
        droop.add(-middles.back().y, -twin_middles.back().y);
        angle.add(bent(middles), bent(twin_middles));
    }
    const std::string name = named("level cantilever of 8 links on upright hinges, 1:", row.ratio, " ",
                                   name_of(row.order), ", 60 Hz × ", row.substeps);
    expect_at_most(name, "joints apart, worst", "mm", row.gap, gap.fixed, gap.single);
    expect_at_most(name, "end below the anchor, worst", "m", row.droop, droop.fixed, droop.single);
    expect_at_most(name, "links bent against each other, worst", "°", row.angle, angle.fixed, angle.single);
}

} // namespace

TEST_CASE("eight links on ball joints and on level hinges hold at any masses") {
    for (const Link kind : {Link::ball, Link::level_hinge}) {
        for (const Order order : {Order::in_turn, Order::at_random, Order::light_end}) {
            swing(kind, order, 1, 0.02);
            swing(kind, order, 4, 0.001);
            swing(kind, order, 20, 2e-5);
        }
    }
}

TEST_CASE("a level cantilever of upright hinges holds up to 1:10^3, and at 1:10^6 in turn droops, its points "
          "together") {
    cantilever({Order::in_turn, 10, 20, 0.02, 0.03, 0.5});
    cantilever({Order::in_turn, 1e3, 20, 0.02, 0.05, 0.5});
    cantilever({Order::light_end, 1e3, 20, 0.001, 0.03, 0.5});
    cantilever({Order::heavy_end, 1e3, 20, 0.02, 0.06, 0.5});
    cantilever({Order::in_turn, 1e6, 20, 40, 2.3, 180});
    cantilever({Order::in_turn, 1e6, 4, 40, 2.3, 180});
}
