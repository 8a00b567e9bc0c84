// The crowd of `lockstitch bench` for JavaScript: what it is, so that other engines can be given the same,
// and ours to step and to look at.
#include <emscripten/emscripten.h>

#include "../our_crowd.h"

using lks_bench::Crowd;
using lks_bench::CrowdBlock;
using lks_bench::CrowdPile;
using lks_bench::OurCrowd;

namespace {

// Numbers one after the other; what they are stands in lockstitch_crowd.mjs.
class Writer {
public:
    explicit Writer(double* numbers) : next_(numbers) {}

    void put(double number) { *next_++ = number; }
    void put(const lks_vec3& v) {
        for (const lks_fixed coordinate : {v.x, v.y, v.z}) {
            put(lks_fixed_to_double(coordinate));
        }
    }
    void put(const lks_transform& transform) {
        put(transform.position);
        const lks_rotation& r = transform.rotation;
        for (const std::int32_t coordinate : {r.x, r.y, r.z, r.w}) {
            put(double(coordinate) / LKS_ROTATION_ONE);
        }
    }

private:
    double* next_;
};

std::unique_ptr<Crowd> make_crowd(std::uint32_t pile) {
    if (pile != 0) {
        return std::make_unique<CrowdPile>();
    }
    return std::make_unique<CrowdBlock>();
}

} // namespace

extern "C" {

// The 100 on a plane, or else the 30 in a pit.
EMSCRIPTEN_KEEPALIVE Crowd* crowd_create(std::uint32_t pile) {
    return make_crowd(pile).release();
}
EMSCRIPTEN_KEEPALIVE std::uint32_t crowd_bone_count(const Crowd* crowd) {
    return crowd->bone_count;
}
EMSCRIPTEN_KEEPALIVE std::uint32_t crowd_place_count(const Crowd* crowd) {
    return static_cast<std::uint32_t>(crowd->places.size());
}
EMSCRIPTEN_KEEPALIVE std::uint32_t crowd_wall_count(const Crowd* crowd) {
    return static_cast<std::uint32_t>(crowd->walls.size());
}
EMSCRIPTEN_KEEPALIVE void crowd_bones(const Crowd* crowd, double* numbers) {
    Writer out(numbers);
    for (std::uint32_t i = 0; i < crowd->bone_count; ++i) {
        const lks_bone& bone = crowd->bones[i];
        const lks_body_shape& shape = crowd->shapes[i];
        out.put(bone.parent == LKS_NO_PARENT ? -1.0 : double(bone.parent));
        out.put(bone.joint_kind == LKS_JOINT_HINGE);
        out.put(shape.shape == LKS_SHAPE_BOX);
        out.put(lks_fixed_to_double(shape.radius));
        out.put(lks_fixed_to_double(shape.half_length));
        out.put(shape.half_extents);
        for (const lks_fixed number :
             {bone.body.mass, bone.body.static_friction, bone.swing_limit, bone.twist_min, bone.twist_max}) {
            out.put(lks_fixed_to_double(number));
        }
        out.put(bone.body.transform);
        out.put(bone.joint_frame);
    }
}
EMSCRIPTEN_KEEPALIVE void crowd_places(const Crowd* crowd, double* numbers) {
    Writer out(numbers);
    for (const lks_transform& place : crowd->places) {
        out.put(place);
    }
}
EMSCRIPTEN_KEEPALIVE void crowd_walls(const Crowd* crowd, double* numbers) {
    Writer out(numbers);
    for (const lks_bench::CrowdWall& wall : crowd->walls) {
        out.put(wall.position);
        out.put(wall.half_extents);
    }
}

EMSCRIPTEN_KEEPALIVE OurCrowd* our_crowd_create(const Crowd* crowd, std::uint32_t substeps) {
    return new OurCrowd(*crowd, substeps);
}
EMSCRIPTEN_KEEPALIVE void our_crowd_destroy(OurCrowd* ours) {
    delete ours;
}
EMSCRIPTEN_KEEPALIVE void our_crowd_step(OurCrowd* ours) {
    ours->tick();
}
// Of each body where it is and its velocities.
EMSCRIPTEN_KEEPALIVE void our_crowd_states(const OurCrowd* ours, double* numbers) {
    Writer out(numbers);
    for (const lks_body_id body : ours->bodies()) {
        lks_transform transform{};
        lks_vec3 velocity{};
        lks_vec3 spin{};
        lks_body_transform(ours->world(), body, &transform);
        lks_body_velocity(ours->world(), body, &velocity, &spin);
        out.put(transform);
        out.put(velocity);
        out.put(spin);
    }
}
// As the SDK itself has them: metres, degrees of swing, degrees of twist.
EMSCRIPTEN_KEEPALIVE void our_crowd_joints(const OurCrowd* ours, double* numbers) {
    Writer out(numbers);
    for (const lks_joint_id joint : ours->joints()) {
        lks_vec3 measured{};
        lks_joint_error(ours->world(), joint, &measured.x);
        lks_joint_angles(ours->world(), joint, &measured.y, &measured.z);
        out.put(measured);
    }
}
EMSCRIPTEN_KEEPALIVE double our_crowd_energy(const OurCrowd* ours) {
    return ours->energy();
}
// Of the whole state, in two halves: JavaScript's numbers have 53 bits.
EMSCRIPTEN_KEEPALIVE std::uint32_t our_crowd_hash_low(const OurCrowd* ours) {
    return static_cast<std::uint32_t>(lks_world_hash(ours->world()));
}
EMSCRIPTEN_KEEPALIVE std::uint32_t our_crowd_hash_high(const OurCrowd* ours) {
    return static_cast<std::uint32_t>(lks_world_hash(ours->world()) >> 32);
}
} // extern "C"
