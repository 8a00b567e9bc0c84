// lockstitch/view.h: the one place where state becomes floats. Reads only; no tick calls it.
//
// Differences to the view's origin are taken in integers first, so that floats are as fine near the camera at
// 8,000 km as they are at the world's origin.
#include <lockstitch/view.h>

#include <cmath>

#include "api/checks.h"
#include "api/view_units.h"
#include "solver/wrapping.h"

using namespace lks;

namespace {

struct Point {
    double x, y, z;
};

class VertexReader {
public:
    VertexReader(const Object& object, const lks_vertex_view& view)
        : object_(object),
          share_(view_share(view.interpolation)), origin_{
                                                      relative_metres(object.origin.x, view.view_origin.x),
                                                      relative_metres(object.origin.y, view.view_origin.y),
                                                      relative_metres(object.origin.z, view.view_origin.z)} {}

    Point operator()(std::uint32_t vertex) const {
        const std::uint32_t particle = object_.asset().vertex_to_particle[vertex];
        return {origin_.x + axis(0, particle), origin_.y + axis(1, particle), origin_.z + axis(2, particle)};
    }

private:
    double axis(int index, std::uint32_t particle) const {
        const auto now = static_cast<double>(object_.axis(index)[particle]) * coordinate_unit;
        if (object_.previous.empty() || share_ == 1.0) {
            return now;
        }
        const std::size_t place = static_cast<std::size_t>(index) * object_.count() + particle;
        const auto before = static_cast<double>(object_.previous[place]) * coordinate_unit;
        return before + (now - before) * share_;
    }

    const Object& object_;
    double share_;
    Point origin_;
};

float* element(float* first, std::size_t stride, std::uint32_t index) {
    return first + index * (stride / sizeof(float));
}

void write_positions(const VertexReader& read, std::uint32_t count, float* positions, std::size_t stride) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const Point p = read(i);
        float* out = element(positions, stride, i);
        out[0] = static_cast<float>(p.x);
        out[1] = static_cast<float>(p.y);
        out[2] = static_cast<float>(p.z);
    }
}

void add_triangle_normal(const Point& a, const Point& b, const Point& c, float* const (&normals)[3]) {
    const Point u{b.x - a.x, b.y - a.y, b.z - a.z};
    const Point v{c.x - a.x, c.y - a.y, c.z - a.z};
    // Twice the triangle's area along its normal: the weight is the area.
    const float n[3] = {static_cast<float>(u.y * v.z - u.z * v.y), static_cast<float>(u.z * v.x - u.x * v.z),
                        static_cast<float>(u.x * v.y - u.y * v.x)};
    for (float* normal : normals) {
        for (int axis = 0; axis < 3; ++axis) {
            normal[axis] += n[axis];
        }
    }
}

void write_normals(const VertexReader& read, const lks_asset& asset, float* normals, std::size_t stride) {
    const std::uint32_t count = asset.vertex_count();
    for (std::uint32_t i = 0; i < count; ++i) {
        float* normal = element(normals, stride, i);
        normal[0] = normal[1] = normal[2] = 0.0f;
    }
    for (std::size_t t = 0; t < asset.triangles.size(); t += 3) {
        const std::uint32_t a = asset.triangles[t];
        const std::uint32_t b = asset.triangles[t + 1];
        const std::uint32_t c = asset.triangles[t + 2];
        float* const corners[3] = {element(normals, stride, a), element(normals, stride, b),
                                   element(normals, stride, c)};
        add_triangle_normal(read(a), read(b), read(c), corners);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        float* normal = element(normals, stride, i);
        const float length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        if (length > 0.0f) {
            normal[0] /= length;
            normal[1] /= length;
            normal[2] /= length;
        } else {
            normal[2] = 1.0f; // a collapsed neighbourhood has no direction: the rest pose's
        }
    }
}

lks_result check_buffer(const lks_world& world, const char* name, const float* buffer, std::size_t stride) {
    if (buffer == nullptr) {
        return LKS_OK;
    }
    if (stride < 3 * sizeof(float) || stride % sizeof(float) != 0) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "The stride of " << name << " is "
                                     << static_cast<std::uint64_t>(stride)
                                     << " bytes; it must be at least 12 and a multiple of 4.");
    }
    if (reinterpret_cast<std::uintptr_t>(buffer) % alignof(float) != 0) {
        return world.fail(LKS_ERROR_MISALIGNED,
                          Sentence() << "The buffer for " << name << " is not aligned to 4 bytes.");
    }
    return LKS_OK;
}

lks_result check_view(const lks_world& world, const Object& object, const lks_vertex_view& view) {
    if (view.struct_size != sizeof(lks_vertex_view)) {
        return world.fail(LKS_ERROR_STRUCT_SIZE,
                          wrong_struct_size("vertex_view", view.struct_size, sizeof(lks_vertex_view)));
    }
    if (!within(view.view_origin, LKS_FIXED(8388607))) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          out_of_range("view_origin", view.view_origin, "m", LKS_FIXED(8388607)));
    }
    if (const lks_result result = check_buffer(world, "positions", view.positions, view.position_stride);
        result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_buffer(world, "normals", view.normals, view.normal_stride);
        result != LKS_OK) {
        return result;
    }
    if (view.normals != nullptr && object.asset().triangles.empty()) {
        return world.fail(LKS_ERROR_UNSUPPORTED, Sentence() << "A rope has no normals.");
    }
    if (view.vertex_capacity < object.count()) {
        return world.fail(LKS_ERROR_BUFFER_TOO_SMALL,
                          Sentence() << "vertex_capacity is "
                                     << static_cast<std::uint64_t>(view.vertex_capacity)
                                     << ", but the object has " << object.count() << " vertices.");
    }
    return LKS_OK;
}

} // namespace

extern "C" {

lks_vertex_view lks_default_vertex_view(void) {
    lks_vertex_view view{};
    view.struct_size = sizeof(lks_vertex_view);
    view.interpolation = LKS_VIEW_LAST_TICK;
    view.position_stride = 3 * sizeof(float);
    view.normal_stride = 3 * sizeof(float);
    return view;
}

lks_result lks_object_write_vertices(const lks_world* world, lks_object_id object,
                                     const lks_vertex_view* view) {
    lks_result result = LKS_OK;
    const Object* found = require_object(world, object, result);
    if (found == nullptr) {
        return result;
    }
    if (view == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT, null_argument("lks_object_write_vertices", "view"));
    }
    if (result = check_view(*world, *found, *view); result != LKS_OK) {
        return result;
    }
    const VertexReader read(*found, *view);
    if (view->positions != nullptr) {
        write_positions(read, found->count(), view->positions, view->position_stride);
    }
    if (view->normals != nullptr) {
        write_normals(read, found->asset(), view->normals, view->normal_stride);
    }
    return LKS_OK;
}

double lks_fixed_to_double(lks_fixed value) {
    return static_cast<double>(value) * world_unit;
}

} // extern "C"
