// The game of game.c as a C++ game writes it: the headers in C++, ids and definitions as values, owners that
// release.
#include <lockstitch/lockstitch.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <vector>

namespace {

void check(lks_result result) {
    if (result != LKS_OK) {
        throw std::runtime_error(lks_result_text(result));
    }
}

struct Release {
    void operator()(lks_world* world) const { lks_world_destroy(world); }
    void operator()(lks_asset* asset) const { lks_asset_release(asset); }
};

void step(lks_world* world, int ticks) {
    for (int i = 0; i < ticks; ++i) {
        check(lks_world_step(world));
    }
}

void print_state(const lks_world* world) {
    std::printf("tick %llu state %016llx\n", static_cast<unsigned long long>(lks_world_tick(world)),
                static_cast<unsigned long long>(lks_world_hash(world)));
}

void play() {
    lks_world_def world_def = lks_default_world_def();
    lks_world* new_world = nullptr;
    check(lks_world_create(&world_def, &new_world));
    const std::unique_ptr<lks_world, Release> world(new_world);

    lks_cloth_def cloth_def = lks_default_cloth_def();
    cloth_def.columns = 9;
    cloth_def.rows = 7;
    lks_asset* new_cloth = nullptr;
    check(lks_asset_create_cloth(&cloth_def, &new_cloth));
    const std::unique_ptr<lks_asset, Release> cloth(new_cloth);

    lks_object_def object_def = lks_default_object_def();
    object_def.asset = cloth.get();
    lks_object_id id{};
    check(lks_world_add_object(world.get(), &object_def, &id));
    check(lks_object_pin(world.get(), id, 0));
    check(lks_object_pin(world.get(), id, cloth_def.columns - 1));
    check(lks_object_apply_impulse(world.get(), id, 40, {LKS_FIXED_ONE / 4, 0, LKS_FIXED_ONE / 2}));

    step(world.get(), 60);
    print_state(world.get());
    std::size_t size = 0;
    check(lks_world_save_size(world.get(), &size));
    std::vector<std::uint64_t> image((size + 7) / 8);
    check(lks_world_save(world.get(), image.data(), size, nullptr));

    // The image goes into another world, which has only heard of the asset.
    lks_world* other_world = nullptr;
    check(lks_world_create(&world_def, &other_world));
    const std::unique_ptr<lks_world, Release> other(other_world);
    check(lks_world_register_asset(other.get(), cloth.get()));
    check(lks_world_load(other.get(), image.data(), size));
    step(other.get(), 30);
    print_state(other.get());
}

} // namespace

int main() {
    try {
        play();
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
    return 0;
}
