// What is to be drawn: one picture's worth of plain data, metres and floats, y up, right-handed.
//
// The renderer takes nothing else, so that a picture is a pure function of its frame (and of the driver).
// Positions are relative to any point near the camera; whoever draws a world 8,000 km from its origin
// subtracts that first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render/colour.h"

namespace render {

struct Camera {
    glm::vec3 eye{0.0f, 1.5f, 5.0f};
    glm::vec3 target{0.0f, 1.0f, 0.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float vertical_fov_degrees = 40.0f;
    float near_plane = 0.05f;
    float far_plane = 500.0f;
};

enum class Pattern : std::uint32_t {
    plain = 0,
    stripes = 1, // bands across v, colour and second colour
    gingham = 2, // both colours in squares, and their mixture where bands of one direction cross
    weave = 3,   // visible threads of the colour, panes of the second colour
    tartan = 4   // broad bands in both directions with a thin line of the accent
};

// One side of a cloth.
struct ClothSide {
    Colour colour = palette::crimson;
    Colour second_colour = palette::cream;
    Colour accent = palette::ochre;
    Pattern pattern = Pattern::weave;
    float repeat = 0.2f; // metres of material in one repeat of the pattern
};

// A sheet of triangles. Texture coordinates belong to the material, in metres at rest, so a stretched cloth
// shows a stretched pattern.
struct Cloth {
    std::vector<float> positions;         // x, y, z a vertex
    std::vector<float> normals;           // x, y, z a vertex, unit; empty: from the triangles, area-weighted
    std::vector<float> texture;           // u, v a vertex, metres
    std::vector<std::uint32_t> triangles; // three vertices each, counter-clockwise from the front
    ClothSide front;
    ClothSide back;
    float thickness = 0.008f;  // metres; what is drawn, not what is simulated
    float translucency = 0.2f; // 0 to 1: how much of the sun comes through
};

// A laid rope along a polyline.
struct Rope {
    std::vector<float> positions; // x, y, z a point, at least two points
    std::vector<float> rest_arc;  // metres from the first point at rest, one a point; empty: as it lies now.
                                  // Given, the strands stretch with the rope instead of sliding along it
    float radius = 0.02f;
    Colour colour = palette::hemp;
    Colour second_colour = palette::cream; // every strands-th strand, where tracer is above 0
    float tracer = 0.0f;                   // 0 to 1: how much the tracer strand shows
    std::uint32_t strands = 3;
    float lay_length = 0.0f; // metres for one turn of a strand; 0: seven radii
    Colour end_colour = palette::crimson;
    float whipping_length = -1.0f; // metres of binding at both ends; below 0: three radii; 0: none
};

enum class ShapeKind : std::uint32_t { plane = 0, sphere = 1, capsule = 2, box = 3 };

// A matte solid.
struct Shape {
    ShapeKind kind = ShapeKind::sphere;
    glm::mat4 matrix{1.0f};       // local to world, rigid
    float radius = 0.5f;          // sphere, capsule
    float half_length = 0.0f;     // capsule: of its axis along local y, without the caps
    glm::vec3 half_extents{0.5f}; // box; a finite plane uses x and z
    bool endless = true; // plane at local y = 0: a ground that fades into the horizon, else a rectangle
    Colour colour = palette::warm_grey;
    float marking = 0.0f; // 0 to 1: alternating darker octants that make turning visible
};

// Two lines at the lower left; empty strings are left out.
struct Legend {
    std::string scene;
    std::string tick; // for instance "tick 240"
    std::string hash; // hexadecimal digits, set in equal widths
    std::string note; // for instance a frame rate
};

struct Frame {
    Camera camera;
    glm::vec3 to_sun{0.45f, 0.8f, 0.4f}; // from the scene towards the sun, any length
    float fade_distance =
        0.0f; // metres at which the ground is lost in the haze; 0: from the camera's distance
    std::vector<Cloth> cloths;
    std::vector<Rope> ropes;
    std::vector<Shape> shapes;
    Legend legend;
};

// Whether all sizes match and all numbers are finite and in range; if not, error says in one sentence what is
// wrong.
bool validate(const Frame& frame, std::string& error);

} // namespace render
