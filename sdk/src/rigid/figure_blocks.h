// Goes through the contacts and figures of a substep, cut into blocks that a team works off at the same time.
#pragma once

#include <algorithm>
#include <cstdint>

#include "rigid/articulation.h"
#include "rigid/figures.h"
#include "rigid/rigid_scene.h"
#include "rigid/wide_trees.h"
#include "threads/blocks.h"

namespace lks {

class FigureBlocks {
public:
    // team: null, or who helps.
    FigureBlocks(RigidScene& scene, Team* team) : scene_(scene), team_(team) {}

    // Of `count` numbers: use(first, end)
    template <typename Use>
    void in_contact_blocks(std::size_t count, const Use& use) const {
        run_blocks(team_, static_cast<std::uint32_t>(count), contacts_a_block,
                   [&](std::uint32_t first, std::uint32_t end, std::uint32_t) { use(first, end); });
    }

    // use(body, worker)
    template <typename Use>
    void in_bodies(const Use& use) const {
        run_each(team_, scene_.bodies.size(), bodies_a_block, use);
    }

    // use(bundle)
    template <typename Use>
    void in_bundles(const Use& use) const {
        const Array<FigureBundle>& bundles = scene_.figure_bundles;
        const auto begin_of = [this](const FigureBundle& bundle) {
            return scene_.figure_ranges[bundle.first].begin();
        };
        // A block has the bundles whose parts begin in it.
        run_blocks(team_, static_cast<std::uint32_t>(scene_.figure_parts.size()), parts_a_block,
                   [&](std::uint32_t first, std::uint32_t end, std::uint32_t) {
                       const FigureBundle* bundle = std::lower_bound(
                           bundles.begin(), bundles.end(), first,
                           [&](const FigureBundle& b, std::uint32_t part) { return begin_of(b) < part; });
                       for (; bundle != bundles.end() && begin_of(*bundle) < end; ++bundle) {
                           use(*bundle);
                       }
                   });
    }

    // use(figure)
    template <typename Use>
    void for_each_figure(const FigureBundle& bundle, const Use& use) const {
        for (std::uint32_t i = bundle.first; i < bundle.end; ++i) {
            use(scene_.figure_ranges[i]);
        }
    }

    // use(figure)
    template <typename Use>
    void in_figures(const Use& use) const {
        in_bundles([&](const FigureBundle& bundle) { for_each_figure(bundle, use); });
    }

    // use(joint, body a, body b)
    template <typename Use>
    void for_each_joint(const FigureRange& figure, const Use& use) const {
        for_each_part(scene_, figure, Part::joint, [&](std::uint32_t i) { use_joint(i, use); });
    }

    // The same from the last one to the first.
    template <typename Use>
    void for_each_joint_back(const FigureRange& figure, const Use& use) const {
        for_each_part_back(scene_, figure, Part::joint, [&](std::uint32_t i) { use_joint(i, use); });
    }

    // A bundle's trees side by side, or those of its one figure one by one.
    void in_trees(const FigureBundle& bundle, void (*wide)(RigidScene&, const FigureBundle&),
                  void (*plain)(RigidScene&, const ArticulatedTree&)) const {
        if (bundle.is_wide()) {
            wide(scene_, bundle);
            return;
        }
        for_each_part(scene_, scene_.figure_ranges[bundle.first], Part::tree,
                      [&](std::uint32_t i) { plain(scene_, scene_.trees[i]); });
    }

private:
    // Some tens of microseconds of work: enough to be worth another thread's while.
    static constexpr std::uint32_t bodies_a_block = 64;
    static constexpr std::uint32_t contacts_a_block = 64;
    static constexpr std::uint32_t parts_a_block = 128;

    template <typename Use>
    void use_joint(std::uint32_t index, const Use& use) const {
        Joint& joint = scene_.joints[index];
        use(joint, scene_.bodies[joint.description.body_a], scene_.bodies[joint.description.body_b]);
    }

    RigidScene& scene_;
    Team* team_;
};

} // namespace lks
