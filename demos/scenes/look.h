// How a scene wants to be seen. Floats are allowed here: nothing of this enters the simulation.
#pragma once

#include <lockstitch/lockstitch.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lks_demo {

// sRGB-encoded, 0 to 1.
struct Rgb {
    float r = 0.8f;
    float g = 0.8f;
    float b = 0.8f;
};

// From 0xRRGGBB.
constexpr Rgb rgb(std::uint32_t hex) {
    return {static_cast<float>(hex >> 16 & 255) / 255.0f, static_cast<float>(hex >> 8 & 255) / 255.0f,
            static_cast<float>(hex & 255) / 255.0f};
}

enum class Pattern { plain, stripes, gingham, weave, tartan };

// One side of a cloth.
struct SideLook {
    Pattern pattern = Pattern::weave;
    Rgb colour;
    Rgb second_colour;
    Rgb accent;
    float repeat = 0.2f; // metres of material
};

struct ClothLook {
    SideLook front;
    SideLook back;
    float thickness = 0.008f;
    float translucency = 0.2f;
    bool turned = false; // the pattern, by a quarter turn: stripes run down
};

struct RopeLook {
    Rgb colour;
    Rgb tracer_colour;
    float tracer = 0.0f; // 0 to 1: how much one strand of the second colour shows
};

enum class ObjectKind { cloth, rope };

struct ObjectLook {
    lks_object_id id{};
    std::string name;
    ObjectKind kind = ObjectKind::cloth;
    std::uint32_t vertex_count = 0;
    ClothLook cloth;
    std::vector<float> texture;           // cloth: u, v a vertex, metres of material
    std::vector<std::uint32_t> triangles; // cloth
    RopeLook rope;
    float radius = 0.0f;         // rope
    std::vector<float> rest_arc; // rope: metres of material from the first point, one a point
};

struct ColliderLook {
    lks_collider_id id{};
    lks_shape_kind shape = LKS_SHAPE_SPHERE;
    float radius = 0.0f;
    float half_length = 0.0f;
    float half_extents[3] = {};
    Rgb colour;
    float marking = 0.0f; // 0 to 1: darker octants that make turning visible
};

// One shape of a body.
struct BodyShapeLook {
    lks_shape_kind shape = LKS_SHAPE_SPHERE;
    float position[3] = {}; // in the body's frame
    float rotation[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    float radius = 0.0f;
    float half_length = 0.0f;
    float half_extents[3] = {};
};

struct BodyLook {
    lks_body_id id{};
    std::string name;
    std::vector<BodyShapeLook> shapes;
    Rgb colour;
    float marking = 0.0f;
};

// A bone of a ragdoll.
struct BoneLook {
    Rgb colour;
    float joint_radius = 0.0f; // metres; of the ball that is drawn where it turns in its parent, 0: none
};

// A flat mark on what was hit.
struct MarkLook {
    lks_vec3 point{};
    lks_vec3 normal{}; // of length one
};

// Relative to the scene's offset, metres.
struct CameraLook {
    float eye[3] = {0.0f, 1.5f, 6.0f};
    float target[3] = {0.0f, 1.0f, 0.0f};
    float vertical_fov_degrees = 35.0f;
    float to_sun[3] = {0.45f, 0.8f, 0.4f};
};

} // namespace lks_demo
