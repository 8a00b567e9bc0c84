#include "golden/recorder.h"

#include <lockstitch/lockstitch.h>

#include "golden/text.h"

namespace lks_golden {
namespace {

constexpr std::uint32_t points_per_object = 5;

// FNV-1a of 64 bits.
class Digest {
public:
    void add(std::uint64_t value) {
        for (int byte = 0; byte < 8; ++byte) {
            sum_ = (sum_ ^ (value >> (8 * byte) & 0xff)) * 0x100000001b3u;
        }
    }
    void add(const lks_vec3& v) {
        for (const lks_fixed part : {v.x, v.y, v.z}) {
            add(static_cast<std::uint64_t>(part));
        }
    }
    std::uint32_t folded() const { return static_cast<std::uint32_t>(sum_ ^ sum_ >> 32); }

private:
    std::uint64_t sum_ = 0xcbf29ce484222325u;
};

// What can be read of it: where it is, without the scene's offset, how it moves, and whether it sleeps.
std::uint32_t digest_of(const lks_world* world, lks_body_id body, const lks_vec3& offset) {
    lks_transform at{};
    lks_vec3 velocity{};
    lks_vec3 spin{};
    lks_body_transform(world, body, &at);
    lks_body_velocity(world, body, &velocity, &spin);
    Digest digest;
    digest.add({at.position.x - offset.x, at.position.y - offset.y, at.position.z - offset.z});
    const lks_rotation& q = at.rotation;
    for (const std::int32_t part : {q.x, q.y, q.z, q.w}) {
        digest.add(static_cast<std::uint64_t>(std::int64_t{part}));
    }
    digest.add(velocity);
    digest.add(spin);
    digest.add(std::uint64_t{lks_body_is_awake(world, body)});
    return digest.folded();
}

} // namespace

Recorder::Recorder(lks_demo::Scene& scene) : scene_(scene) {
    state_.scene = scene.info().name;
    record_parameters();
    record_tick();
}

void Recorder::record_parameters() {
    const lks_world* world = scene_.world();
    const auto add = [this](const std::string& key, const std::string& value) {
        state_.parameters.emplace_back(key, value);
    };
    lks_vec3 gravity{};
    lks_world_gravity(world, &gravity);
    add("solver_version", std::to_string(lks_solver_version()));
    add("tick_rate_hz", std::to_string(lks_world_tick_rate(world)));
    add("substeps", std::to_string(lks_world_substeps(world)));
    add("iterations", std::to_string(lks_world_iterations(world)));
    add("gravity", decimal(gravity));
    for (const lks_demo::ObjectLook& object : scene_.objects()) {
        const lks_asset* asset = lks_object_asset(world, object.id);
        add("object_" + object.name, "vertices " + std::to_string(lks_asset_vertex_count(asset)) +
                                         " constraints " + std::to_string(lks_asset_constraint_count(asset)) +
                                         " colours " + std::to_string(lks_asset_colour_count(asset)) +
                                         " asset " + hexadecimal(lks_asset_fingerprint(asset)));
    }
}

void Recorder::record_tick() {
    const lks_world* world = scene_.world();
    TickRecord record;
    record.tick = lks_world_tick(world);
    if (record.tick % ticks_between_records != 0) {
        return;
    }
    record.state = lks_world_hash(world);
    record.local = lks_world_local_hash(world);
    for (const lks_demo::ObjectLook& object : scene_.objects()) {
        record.objects.push_back({object.id.index, object.name, lks_object_hash(world, object.id)});
    }
    for (const lks_demo::BodyLook& body : scene_.bodies()) {
        record.bodies.push_back(digest_of(world, body.id, scene_.offset()));
    }
    state_.ticks.push_back(record);
}

void Recorder::record_end() {
    record_points();
    record_bodies();
}

void Recorder::record_bodies() {
    for (const lks_demo::BodyLook& body : scene_.bodies()) {
        lks_transform at{};
        lks_body_transform(scene_.world(), body.id, &at);
        const lks_rotation& q = at.rotation;
        state_.bodies.push_back({body.name, decimal(at.position),
                                 std::to_string(q.x) + " " + std::to_string(q.y) + " " + std::to_string(q.z) +
                                     " " + std::to_string(q.w)});
    }
}

void Recorder::record_points() {
    const lks_world* world = scene_.world();
    for (const lks_demo::ObjectLook& object : scene_.objects()) {
        const std::uint32_t count = lks_asset_vertex_count(lks_object_asset(world, object.id));
        for (std::uint32_t i = 0; i < points_per_object; ++i) {
            const auto vertex =
                static_cast<std::uint32_t>(std::uint64_t{count - 1} * i / (points_per_object - 1));
            lks_raw_position raw{};
            lks_vec3 position{};
            lks_object_raw_positions(world, object.id, vertex, 1, &raw);
            lks_object_positions(world, object.id, vertex, 1, &position);
            state_.points.push_back(
                {object.name, vertex,
                 std::to_string(raw.x) + " " + std::to_string(raw.y) + " " + std::to_string(raw.z),
                 decimal(position)});
        }
    }
}

bool record_run(lks_demo::Scene& scene,
                const std::function<bool(std::uint32_t tick, std::string&)>& after_tick, GoldenState& state,
                std::string& error) {
    Recorder recorder(scene);
    for (std::uint32_t tick = 1; tick <= scene.info().golden_ticks; ++tick) {
        if (!scene.step(error)) {
            return false;
        }
        recorder.record_tick();
        if (after_tick && !after_tick(tick, error)) {
            return false;
        }
    }
    recorder.record_end();
    state = recorder.state();
    return true;
}

} // namespace lks_golden
