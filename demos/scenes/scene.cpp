#include "scenes/scene.h"

#include "scenes/time_curves.h"

namespace lks_demo {

Scene::~Scene() {
    lks_world_destroy(world_);
    for (lks_asset* asset : assets_) {
        lks_asset_release(asset);
    }
}

bool Scene::create(const SceneOptions& options, std::string& error) {
    options_ = options;
    lks_world_def def = lks_default_world_def();
    configure(def);
    def.simd = static_cast<std::uint32_t>(options.simd);
    def.worker_count = options.worker_count;
    def.tasks = options.tasks;
    def.tick_rate_hz = options.tick_rate_hz != 0 ? options.tick_rate_hz : def.tick_rate_hz;
    def.substeps = options.substeps != 0 ? options.substeps : def.substeps;
    def.iterations = options.iterations != 0 ? options.iterations : def.iterations;
    def.max_ticks_per_advance =
        options.max_ticks_per_advance != 0 ? options.max_ticks_per_advance : def.max_ticks_per_advance;
    def.keep_previous_positions = 1;
    def.before_tick = {&Scene::on_tick, this};
    def.allocator = options.allocator;
    def.log = options.log;
    def.error = &refusal_;
    const bool good = accept(lks_world_create(&def, &world_)) && build();
    if (!good) {
        error = "The scene " + std::string(info_.name) + " can't be made: " + error_;
    }
    return good;
}

bool Scene::step(std::string& error) {
    const bool good = accept(lks_world_step(world_)) && error_.empty();
    see_events();
    if (!good) {
        error = error_;
    }
    return good;
}

bool Scene::advance(std::int64_t elapsed_ns, std::string& error) {
    const bool good = accept(lks_world_advance(world_, elapsed_ns, nullptr)) && error_.empty();
    see_events();
    if (!good) {
        error = error_;
    }
    return good;
}

void Scene::see_events() {
    const lks_event* const events = lks_world_events(world_);
    for (std::uint32_t i = 0; most_marks_ != 0 && i < lks_world_event_count(world_); ++i) {
        if (events[i].kind != LKS_EVENT_CONTACT_HIT) {
            continue;
        }
        if (marks_.size() == most_marks_) {
            marks_.erase(marks_.begin());
        }
        marks_.push_back({events[i].point, events[i].normal});
    }
}

bool Scene::apply_inputs(lks_fixed) {
    return true;
}

void Scene::on_tick(void* user, lks_world* world, std::uint64_t tick) {
    Scene& scene = *static_cast<Scene*>(user);
    if (scene.before_inputs) {
        scene.before_inputs(world);
    }
    // A hook can't stop the tick; step and advance look at the error afterwards.
    scene.apply_inputs(seconds_at(tick, lks_world_tick_rate(world)));
}

bool Scene::accept(lks_result result) {
    if (result != LKS_OK && error_.empty()) {
        const lks_error* error = &refusal_;
        if (error->result == LKS_OK && world_ != nullptr) {
            error = lks_world_last_error(world_);
        }
        error_ = error->result != LKS_OK ? error->message : lks_result_text(result);
    }
    return result == LKS_OK;
}

lks_vec3 Scene::place(lks_vec3 position) const {
    return {position.x + options_.offset.x, position.y + options_.offset.y, position.z + options_.offset.z};
}

} // namespace lks_demo
