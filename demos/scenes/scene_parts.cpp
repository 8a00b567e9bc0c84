// What scenes are put together from.
#include "scenes/scene.h"

namespace lks_demo {
namespace {

float to_float(lks_fixed value) {
    return static_cast<float>(lks_fixed_to_double(value));
}

} // namespace

bool Scene::add_ground(Rgb colour) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_PLANE;
    ColliderLook look;
    look.colour = colour;
    return add_collider(def, look);
}

bool Scene::add_block(const lks_vec3& position, const lks_vec3& half_extents, Rgb colour) {
    lks_collider_def def = lks_default_collider_def();
    def.shape = LKS_SHAPE_BOX;
    def.half_extents = half_extents;
    def.transform.position = position;
    ColliderLook look;
    look.colour = colour;
    return add_collider(def, look);
}

bool Scene::add_collider(lks_collider_def def, const ColliderLook& look, lks_collider_id* id) {
    def.transform.position = place(def.transform.position);
    ColliderLook added = look;
    if (!accept(lks_world_add_collider(world_, &def, &added.id))) {
        return false;
    }
    added.shape = static_cast<lks_shape_kind>(def.shape);
    added.radius = to_float(def.radius);
    added.half_length = to_float(def.half_length);
    added.half_extents[0] = to_float(def.half_extents.x);
    added.half_extents[1] = to_float(def.half_extents.y);
    added.half_extents[2] = to_float(def.half_extents.z);
    colliders_.push_back(added);
    if (id != nullptr) {
        *id = added.id;
    }
    return true;
}

void Scene::look_as_body(const std::string& name, lks_body_id id, const lks_body_def& def, double scale,
                         Rgb colour) {
    const auto metres = [scale](lks_fixed value) {
        return static_cast<float>(lks_fixed_to_double(value) * scale);
    };
    BodyLook look;
    look.id = id;
    look.name = name;
    look.colour = colour;
    for (std::uint32_t i = 0; i < def.shape_count; ++i) {
        const lks_body_shape& from = def.shapes[i];
        const lks_rotation& q = from.transform.rotation;
        BodyShapeLook shape;
        shape.shape = static_cast<lks_shape_kind>(from.shape);
        const lks_vec3& p = from.transform.position;
        const lks_vec3& e = from.half_extents;
        for (int axis = 0; axis < 3; ++axis) {
            shape.position[axis] = metres(axis == 0 ? p.x : axis == 1 ? p.y : p.z);
            shape.half_extents[axis] = metres(axis == 0 ? e.x : axis == 1 ? e.y : e.z);
        }
        const std::int32_t parts[4] = {q.x, q.y, q.z, q.w};
        for (int part = 0; part < 4; ++part) {
            shape.rotation[part] = static_cast<float>(parts[part]) / static_cast<float>(LKS_ROTATION_ONE);
        }
        shape.radius = metres(from.radius);
        shape.half_length = metres(from.half_length);
        look.shapes.push_back(shape);
    }
    bodies_.push_back(look);
}

// Of the body that was added last, whose bone is not turned in its rest pose.
void Scene::look_as_joint(const lks_bone& bone, double scale, float radius) {
    if (radius == 0.0f) {
        return;
    }
    const lks_vec3& joint = bone.joint_frame.position;
    const lks_vec3& body = bone.body.transform.position;
    const lks_fixed away[3] = {joint.x - body.x, joint.y - body.y, joint.z - body.z};
    BodyShapeLook ball;
    for (int axis = 0; axis < 3; ++axis) {
        ball.position[axis] = static_cast<float>(lks_fixed_to_double(away[axis]) * scale);
    }
    ball.radius = radius * static_cast<float>(scale);
    bodies_.back().shapes.push_back(ball);
}

bool Scene::add_body(const std::string& name, lks_body_def def, Rgb colour, lks_body_id* id) {
    def.transform.position = place(def.transform.position);
    lks_body_id added{};
    if (!accept(lks_world_add_body(world_, &def, &added))) {
        return false;
    }
    look_as_body(name, added, def, 1.0, colour);
    if (id != nullptr) {
        *id = added;
    }
    return true;
}

bool Scene::add_ragdoll(const std::string& name, lks_ragdoll_def def, const BoneLook* looks, lks_body_id* ids,
                        lks_joint_id* joints) {
    def.transform.position = place(def.transform.position);
    std::vector<lks_body_id> added(def.bone_count);
    if (!accept(lks_world_add_ragdoll(world_, &def, added.data(), joints))) {
        return false;
    }
    for (std::uint32_t i = 0; i < def.bone_count; ++i) {
        look_as_body(name, added[i], def.bones[i].body, lks_fixed_to_double(def.scale), looks[i].colour);
        look_as_joint(def.bones[i], lks_fixed_to_double(def.scale), looks[i].joint_radius);
        if (ids != nullptr) {
            ids[i] = added[i];
        }
    }
    return true;
}

bool Scene::create_cloth(lks_cloth_def def, const lks_asset*& asset) {
    def.allocator = options_.allocator;
    def.error = &refusal_;
    lks_asset* created = nullptr;
    if (!accept(lks_asset_create_cloth(&def, &created))) {
        return false;
    }
    assets_.push_back(created);
    asset = created;
    return true;
}

bool Scene::create_rope(lks_rope_def def, const lks_asset*& asset) {
    def.allocator = options_.allocator;
    def.error = &refusal_;
    lks_asset* created = nullptr;
    if (!accept(lks_asset_create_rope(&def, &created))) {
        return false;
    }
    assets_.push_back(created);
    asset = created;
    return true;
}

bool Scene::add_object(const std::string& name, const lks_asset* asset, lks_object_def def) {
    def.asset = asset;
    def.transform.position = place(def.transform.position);
    ObjectLook look;
    look.name = name;
    look.vertex_count = lks_asset_vertex_count(asset);
    if (!accept(lks_world_add_object(world_, &def, &look.id))) {
        return false;
    }
    objects_.push_back(look);
    return true;
}

ObjectLook& Scene::look_of(ObjectKind kind) {
    ObjectLook& object = objects_.back();
    object.kind = kind;
    if (kind == ObjectKind::cloth) {
        const lks_asset* asset = lks_object_asset(world_, object.id);
        object.triangles.resize(std::size_t{3} * lks_asset_triangle_count(asset));
        accept(lks_asset_triangles(asset, object.triangles.data(), object.triangles.size()));
    }
    return object;
}

void Scene::look_as_grid(const lks_cloth_def& def, const ClothLook& look) {
    ObjectLook& object = look_of(ObjectKind::cloth);
    object.cloth = look;
    for (std::uint32_t row = 0; row < def.rows; ++row) {
        for (std::uint32_t column = 0; column < def.columns; ++column) {
            const auto across = static_cast<float>(def.width * column / (def.columns - 1));
            const auto down = static_cast<float>(def.height * row / (def.rows - 1));
            object.texture.push_back(look.turned ? down : across);
            object.texture.push_back(look.turned ? across : down);
        }
    }
}

void Scene::look_as_mesh(const std::vector<double>& vertices, const ClothLook& look) {
    ObjectLook& object = look_of(ObjectKind::cloth);
    object.cloth = look;
    for (std::size_t i = 0; i < vertices.size(); i += 3) {
        object.texture.push_back(static_cast<float>(vertices[i]));
        object.texture.push_back(static_cast<float>(vertices[i + 1]));
    }
}

void Scene::look_as_rope(double length, double radius, const RopeLook& look) {
    ObjectLook& object = look_of(ObjectKind::rope);
    object.rope = look;
    object.radius = static_cast<float>(radius);
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        object.rest_arc.push_back(static_cast<float>(length * i / (object.vertex_count - 1)));
    }
}

void Scene::leave_marks(std::size_t most, Rgb colour) {
    most_marks_ = most;
    mark_colour_ = colour;
}

bool Scene::pin(lks_object_id object, std::uint32_t vertex) {
    return accept(lks_object_pin(world_, object, vertex));
}

} // namespace lks_demo
