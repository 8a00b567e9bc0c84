#include "program/frame_from_scene.h"

#include <lockstitch/lockstitch.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/gtx/quaternion.hpp>

#include "golden/text.h"

namespace lks_program {
namespace {

using lks_demo::ColliderLook;
using lks_demo::ObjectKind;
using lks_demo::ObjectLook;

render::Colour colour(lks_demo::Rgb rgb) {
    return {rgb.r, rgb.g, rgb.b};
}

render::Pattern pattern(lks_demo::Pattern pattern) {
    switch (pattern) {
    case lks_demo::Pattern::plain:
        return render::Pattern::plain;
    case lks_demo::Pattern::stripes:
        return render::Pattern::stripes;
    case lks_demo::Pattern::gingham:
        return render::Pattern::gingham;
    case lks_demo::Pattern::weave:
        return render::Pattern::weave;
    case lks_demo::Pattern::tartan:
        break;
    }
    return render::Pattern::tartan;
}

render::ShapeKind shape_kind(lks_shape_kind kind) {
    switch (kind) {
    case LKS_SHAPE_PLANE:
        return render::ShapeKind::plane;
    case LKS_SHAPE_SPHERE:
        return render::ShapeKind::sphere;
    case LKS_SHAPE_CAPSULE:
        return render::ShapeKind::capsule;
    case LKS_SHAPE_BOX:
        break;
    }
    return render::ShapeKind::box;
}

render::ClothSide side(const lks_demo::SideLook& look) {
    return {colour(look.colour), colour(look.second_colour), colour(look.accent), pattern(look.pattern),
            look.repeat};
}

class FrameMaker {
public:
    FrameMaker(const lks_demo::Scene& scene, std::uint32_t interpolation, render::Frame& frame)
        : scene_(scene), interpolation_(interpolation), frame_(frame) {}

    bool run(std::string& error) {
        place_camera();
        bool good = true;
        for (const ObjectLook& object : scene_.objects()) {
            good = good && (object.kind == ObjectKind::cloth ? add_cloth(object) : add_rope(object));
        }
        for (const ColliderLook& collider : scene_.colliders()) {
            good = good && add_collider(collider);
        }
        for (const lks_demo::BodyLook& body : scene_.bodies()) {
            good = good && add_body(body);
        }
        add_marks();
        frame_.legend.scene = scene_.info().name;
        frame_.legend.tick = "tick " + std::to_string(scene_.tick());
        frame_.legend.hash = lks_golden::hexadecimal(lks_world_hash(scene_.world()));
        if (!good) {
            error = lks_world_last_error(scene_.world())->message;
        }
        return good;
    }

private:
    void place_camera() {
        const lks_demo::CameraLook& camera = scene_.camera();
        frame_.camera.eye = glm::make_vec3(camera.eye);
        frame_.camera.target = glm::make_vec3(camera.target);
        frame_.camera.vertical_fov_degrees = camera.vertical_fov_degrees;
        frame_.to_sun = glm::make_vec3(camera.to_sun);
    }

    // Relative to the scene's offset: the picture is the same wherever in the world the scene is.
    bool read_vertices(const ObjectLook& object, std::vector<float>& positions, std::vector<float>* normals) {
        lks_vertex_view view = lks_default_vertex_view();
        view.interpolation = interpolation_;
        view.view_origin = scene_.offset();
        positions.resize(std::size_t{3} * object.vertex_count);
        view.positions = positions.data();
        if (normals != nullptr) {
            normals->resize(positions.size());
            view.normals = normals->data();
        }
        view.vertex_capacity = object.vertex_count;
        return lks_object_write_vertices(scene_.world(), object.id, &view) == LKS_OK;
    }

    bool add_cloth(const ObjectLook& object) {
        render::Cloth& cloth = frame_.cloths.emplace_back();
        cloth.texture = object.texture;
        cloth.triangles = object.triangles;
        cloth.front = side(object.cloth.front);
        cloth.back = side(object.cloth.back);
        cloth.thickness = object.cloth.thickness;
        cloth.translucency = object.cloth.translucency;
        return read_vertices(object, cloth.positions, &cloth.normals);
    }

    bool add_rope(const ObjectLook& object) {
        render::Rope& rope = frame_.ropes.emplace_back();
        rope.rest_arc = object.rest_arc;
        rope.radius = object.radius;
        rope.colour = colour(object.rope.colour);
        rope.second_colour = colour(object.rope.tracer_colour);
        rope.tracer = object.rope.tracer;
        return read_vertices(object, rope.positions, nullptr);
    }

    bool add_collider(const ColliderLook& collider) {
        float matrix[16];
        if (lks_collider_write_matrix(scene_.world(), collider.id, interpolation_, scene_.offset(), matrix) !=
            LKS_OK) {
            return false;
        }
        add_shape(collider, glm::make_mat4(matrix), collider.colour, collider.marking);
        return true;
    }

    // A collider, or a shape of a body.
    template <typename Look>
    void add_shape(const Look& look, const glm::mat4& matrix, lks_demo::Rgb rgb, float marking) {
        render::Shape& shape = frame_.shapes.emplace_back();
        shape.kind = shape_kind(look.shape);
        shape.radius = look.radius;
        shape.half_length = look.half_length;
        shape.half_extents = glm::make_vec3(look.half_extents);
        shape.matrix = matrix;
        shape.colour = colour(rgb);
        shape.marking = marking;
    }

    bool add_body(const lks_demo::BodyLook& body) {
        float matrix[16];
        if (lks_body_write_matrix(scene_.world(), body.id, interpolation_, scene_.offset(), matrix) !=
            LKS_OK) {
            return false;
        }
        for (const lks_demo::BodyShapeLook& shape : body.shapes) {
            const glm::quat rotation(shape.rotation[3], shape.rotation[0], shape.rotation[1],
                                     shape.rotation[2]);
            const glm::mat4 in_body =
                glm::translate(glm::mat4(1.0f), glm::make_vec3(shape.position)) * glm::mat4_cast(rotation);
            add_shape(shape, glm::make_mat4(matrix) * in_body, body.colour, body.marking);
        }
        return true;
    }

    // Flat discs, as near as a box of a few sides comes to one.
    void add_marks() {
        const lks_vec3 offset = scene_.offset();
        const auto metres = [](lks_fixed value) { return static_cast<float>(lks_fixed_to_double(value)); };
        for (const lks_demo::MarkLook& mark : scene_.marks()) {
            const glm::vec3 point(metres(mark.point.x - offset.x), metres(mark.point.y - offset.y),
                                  metres(mark.point.z - offset.z));
            const glm::vec3 normal(metres(mark.normal.x), metres(mark.normal.y), metres(mark.normal.z));
            const glm::mat4 matrix = glm::translate(glm::mat4(1.0f), point) *
                                     glm::mat4_cast(glm::rotation(glm::vec3(0.0f, 1.0f, 0.0f), normal));
            for (int side = 0; side < 3; ++side) {
                render::Shape& shape = frame_.shapes.emplace_back();
                shape.kind = render::ShapeKind::box;
                shape.half_extents = {0.06f, 0.004f, 0.035f};
                shape.matrix = glm::rotate(matrix, glm::radians(60.0f * static_cast<float>(side)),
                                           glm::vec3(0.0f, 1.0f, 0.0f));
                shape.colour = colour(scene_.mark_colour());
            }
        }
    }

    const lks_demo::Scene& scene_;
    std::uint32_t interpolation_;
    render::Frame& frame_;
};

} // namespace

bool make_frame(const lks_demo::Scene& scene, std::uint32_t interpolation, render::Frame& frame,
                std::string& error) {
    frame = render::Frame{};
    return FrameMaker(scene, interpolation, frame).run(error);
}

} // namespace lks_program
