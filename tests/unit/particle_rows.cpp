// Which objects are swept in rows, and that rows hold what arrays do.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "fixed_samples.h"
#include "kernels/compiled_kernels.h"
#include "solver/particle_rows.h"
#include "support/builders.h"
#include "wide_kernels.h"

using namespace lks;

namespace {

support::Asset mesh_asset(const support::Mesh& mesh, double damping = 0) {
    lks_cloth_def def = mesh.def();
    def.bend = support::soft(1e-6, damping);
    return support::Asset(def);
}

// An asset as a world of 60 Hz × 20 has it.
struct Known {
    explicit Known(support::Asset description) : described(std::move(description)) {
        REQUIRE(coefficients.build(asset(), make_step_rate(60, 20, 1)));
    }

    const lks_asset& asset() const { return *static_cast<const lks_asset*>(described); }
    std::size_t words() const { return row_words(asset(), coefficients); }
    bool goes_in_rows(const Kernels& kernels) const {
        return is_swept_in_rows(kernels, asset(), coefficients);
    }

    support::Asset described;
    Coefficients coefficients{lks_allocator{}};
};

} // namespace

TEST_CASE("particle rows: irregular meshes go in rows, and no others") {
    const Known irregular(mesh_asset(support::irregular_mesh(24, 2)));
    const Known damped(mesh_asset(support::irregular_mesh(24, 2), 3));
    const Known regular(mesh_asset(support::wavy_mesh(65, 2)));
    const Known small(mesh_asset(support::irregular_mesh(6, 2)));
    const Known grid(support::Net().build());
    support::Chain chain;
    chain.segments = 600;
    const Known rope(chain.build());
    CHECK(irregular.words() == 576 * row_length);
    CHECK(damped.words() == 2 * 576 * row_length);
    for (const Kernels* kernels : test::wide_kernels()) {
        INFO(std::string(simd_name(kernels->level)));
        CHECK(irregular.goes_in_rows(*kernels) == (kernels->rows.take != nullptr));
        for (const Known* other : {&regular, &small, &grid, &rope}) {
            CHECK(!other->goes_in_rows(*kernels));
            CHECK(other->words() == 0);
        }
    }
    CHECK(!irregular.goes_in_rows(kernels_scalar));
}

TEST_CASE("particle rows: taken and given back in parts of any length, nothing is lost") {
    constexpr std::uint32_t room = 96;
    for (const Kernels* kernels : test::wide_kernels()) {
        if (kernels->rows.take == nullptr) {
            continue;
        }
        INFO(std::string(simd_name(kernels->level)));
        test::Random random(47);
        for (std::uint32_t count = 1; count <= 40; ++count) {
            std::vector<std::int64_t> axes(3 * room);
            for (std::int64_t& x : axes) {
                x = static_cast<std::int64_t>(random.bits());
            }
            const std::vector<std::int64_t> before = axes;
            std::vector<std::int64_t> rows(row_length * room);
            const RowTask task{axes.data(), axes.data() + room, axes.data() + 2 * room, rows.data()};
            for (const std::uint32_t first : {0u, 16u, 48u}) {
                kernels->rows.take(task, first, count);
                bool held = true;
                for (std::uint32_t i = first; i < first + count; ++i) {
                    for (std::uint32_t axis = 0; axis < 3; ++axis) {
                        held = held && rows[row_length * i + axis] == before[axis * room + i];
                        rows[row_length * i + axis] ^= 1;
                    }
                }
                CHECK(held);
                kernels->rows.give_back(task, first, count);
                bool given = true;
                for (std::uint32_t i = 0; i < room; ++i) {
                    const bool changed = first <= i && i < first + count;
                    for (std::uint32_t axis = 0; axis < 3; ++axis) {
                        std::int64_t& x = axes[axis * room + i];
                        given = given && x == (before[axis * room + i] ^ (changed ? 1 : 0));
                        x = before[axis * room + i];
                    }
                }
                CHECK(given);
            }
        }
    }
}
