// One picture:
//
//     meshes of the frame -> one buffer
//     shadow maps, four sizes               what the sun sees
//     geometry, half size                   normals and depths -> occlusion -> smoothed
//     sky, ground, solids, cloths, ropes    4 samples a pixel, shaded once, sRGB
//     resolve, read, legend
#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/legend.h"
#include "render/prepared.h"
#include "render/shader.h"
#include "render/shaders/cloth.h"
#include "render/shaders/lighting.h"
#include "render/shaders/occlusion.h"
#include "render/shaders/pattern.h"
#include "render/shaders/rope.h"
#include "render/shaders/scene_block.h"
#include "render/shaders/solid.h"
#include "render/shaders/vertex.h"
#include "render/targets.h"

namespace render {
namespace {

// Texture units.
constexpr int unit_sun_shadow = 0;
constexpr int unit_sun_depth = 1; // the same map, not compared
constexpr int unit_shadow_range = 2;
constexpr int unit_occlusion = 3;
constexpr int unit_geometry = 4;
constexpr int unit_rough = 5;

float linear(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

glm::vec4 linear(Colour colour, float w) {
    return {linear(colour.x), linear(colour.y), linear(colour.z), w};
}

} // namespace

struct Renderer::Parts {
    RendererOptions options;
    std::unique_ptr<Context> context;
    Targets targets;
    Program sun_program, block_range_program, shadow_range_program, geometry_program;
    Program occlusion_program, smooth_program;
    Program sky_program, ground_program, solid_program, cloth_program, rope_program;
    GLuint vertex_array = 0;
    GLuint empty_array = 0;
    GLuint vertex_buffer = 0;
    GLuint index_buffer = 0;
    GLuint scene_buffer = 0;
    Prepared prepared;

    bool create(std::string& error);
    void destroy();
    bool link_programs(std::string& error);
    void create_buffers();
    void upload(const SceneBlock& block);
    void bind_texture(int unit, GLuint texture, GLuint sampler) const;
    void draw_indices(const Draw& draw) const;
    void draw_shadow(GLuint framebuffer, int size) const;
    void draw_shadow_range() const;
    void draw_occlusion() const;
    void draw_picture(const Frame& frame) const;
    void set_material(const Frame& frame, const Draw& draw, const Program& program) const;
    void read(Image& image) const;
};

bool Renderer::Parts::link_programs(std::string& error) {
    using namespace shaders;
    const GlFunctions& gl = context->gl();
    const auto lit = [&](Program& program, const char* name, const char* fragment) {
        if (!program.link(
                gl, name, {version, scene_block, surface_vertex},
                {version, scene_block, daylight, shadow, occlusion_lookup, lighting, pattern, fragment},
                error)) {
            return false;
        }
        program.use(gl);
        program.set(gl, "sun_shadow", unit_sun_shadow);
        program.set(gl, "sun_depth", unit_sun_depth);
        program.set(gl, "shadow_range", unit_shadow_range);
        program.set(gl, "occlusion_map", unit_occlusion);
        program.set(gl, "geometry_map", unit_geometry);
        return true;
    };
    if (!sun_program.link(gl, "sun", {version, scene_block, sun_vertex}, {version, nothing_fragment},
                          error) ||
        !block_range_program.link(gl, "block range", {version, screen_vertex},
                                  {version, shadow_range_fragment}, error) ||
        !shadow_range_program.link(gl, "shadow range", {version, screen_vertex},
                                   {version, shadow_spread_fragment}, error) ||
        !geometry_program.link(gl, "geometry", {version, scene_block, surface_vertex},
                               {version, scene_block, geometry_fragment}, error) ||
        !occlusion_program.link(gl, "occlusion", {version, screen_vertex},
                                {version, scene_block, occlusion_fragment}, error) ||
        !smooth_program.link(gl, "smoothing", {version, screen_vertex}, {version, occlusion_smooth_fragment},
                             error) ||
        !sky_program.link(gl, "sky", {version, screen_vertex}, {version, scene_block, daylight, sky_fragment},
                          error) ||
        !lit(ground_program, "ground", ground_fragment) || !lit(solid_program, "solid", solid_fragment) ||
        !lit(cloth_program, "cloth", cloth_fragment) || !lit(rope_program, "rope", rope_fragment)) {
        return false;
    }
    block_range_program.use(gl);
    block_range_program.set(gl, "sun_depth", unit_sun_depth);
    shadow_range_program.use(gl);
    shadow_range_program.set(gl, "block_range", unit_shadow_range);
    occlusion_program.use(gl);
    occlusion_program.set(gl, "geometry_map", unit_geometry);
    smooth_program.use(gl);
    smooth_program.set(gl, "geometry_map", unit_geometry);
    smooth_program.set(gl, "rough_map", unit_rough);
    return true;
}

void Renderer::Parts::create_buffers() {
    const GlFunctions& gl = context->gl();
    gl.GenVertexArrays(1, &empty_array);
    gl.GenVertexArrays(1, &vertex_array);
    gl.GenBuffers(1, &vertex_buffer);
    gl.GenBuffers(1, &index_buffer);
    gl.GenBuffers(1, &scene_buffer);
    gl.BindVertexArray(vertex_array);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertex_buffer);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer);
    const auto attribute = [&](GLuint location, GLint size, std::size_t offset) {
        gl.EnableVertexAttribArray(location);
        gl.VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                               reinterpret_cast<const void*>(offset));
    };
    attribute(0, 3, offsetof(Vertex, position));
    attribute(1, 3, offsetof(Vertex, normal));
    attribute(2, 3, offsetof(Vertex, axis));
    attribute(3, 2, offsetof(Vertex, texture));
    attribute(4, 1, offsetof(Vertex, part));
    gl.BindVertexArray(empty_array);
}

bool Renderer::Parts::create(std::string& error) {
    context = create_context(options.road, error);
    if (!context) {
        return false;
    }
    if (!targets.create(context->gl(), options.width, options.height, options.samples, error) ||
        !link_programs(error)) {
        return false;
    }
    create_buffers();
    if (const GLenum code = context->gl().GetError(); code != GL_NO_ERROR) {
        error = "the driver reports error " + std::to_string(code) + " while the renderer is set up";
        return false;
    }
    return true;
}

void Renderer::Parts::destroy() {
    std::string ignored;
    if (!context || !context->make_current(ignored)) {
        return;
    }
    const GlFunctions& gl = context->gl();
    for (Program* program :
         {&sun_program, &block_range_program, &shadow_range_program, &geometry_program, &occlusion_program,
          &smooth_program, &sky_program, &ground_program, &solid_program, &cloth_program, &rope_program}) {
        program->destroy(gl);
    }
    targets.destroy(gl);
    const GLuint arrays[] = {vertex_array, empty_array};
    const GLuint buffers[] = {vertex_buffer, index_buffer, scene_buffer};
    gl.DeleteVertexArrays(2, arrays);
    gl.DeleteBuffers(3, buffers);
}

void Renderer::Parts::upload(const SceneBlock& block) {
    const GlFunctions& gl = context->gl();
    const Mesh& mesh = prepared.mesh;
    gl.BindVertexArray(vertex_array);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertex_buffer);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(Vertex)),
                  mesh.vertices.data(), GL_STREAM_DRAW);
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                  static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)), mesh.indices.data(),
                  GL_STREAM_DRAW);
    gl.BindBuffer(GL_UNIFORM_BUFFER, scene_buffer);
    gl.BufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, scene_buffer);
}

void Renderer::Parts::bind_texture(int unit, GLuint texture, GLuint sampler) const {
    const GlFunctions& gl = context->gl();
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.BindSampler(static_cast<GLuint>(unit), sampler);
}

void Renderer::Parts::draw_indices(const Draw& draw) const {
    const std::size_t offset = draw.first * sizeof(std::uint32_t);
    context->gl().DrawElements(GL_TRIANGLES, static_cast<GLsizei>(draw.count), GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(offset));
}

void Renderer::Parts::draw_shadow(GLuint framebuffer, int size) const {
    const GlFunctions& gl = context->gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.Viewport(0, 0, size, size);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(1.6f, 4.0f);
    gl.Disable(GL_CULL_FACE);
    sun_program.use(gl);
    for (const Draw& draw : prepared.draws) {
        if (draw.casts) {
            sun_program.set(gl, "model", draw.model);
            draw_indices(draw);
        }
    }
    gl.Disable(GL_POLYGON_OFFSET_FILL);
}

void Renderer::Parts::draw_shadow_range() const {
    const GlFunctions& gl = context->gl();
    gl.Disable(GL_DEPTH_TEST);
    gl.BindVertexArray(empty_array);
    gl.Viewport(0, 0, Targets::shadow_blocks, Targets::shadow_blocks);
    bind_texture(unit_sun_depth, targets.shadow_map, targets.depth_sampler);
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets.block_range);
    block_range_program.use(gl);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    bind_texture(unit_shadow_range, targets.block_range_map, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets.shadow_range);
    shadow_range_program.use(gl);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    bind_texture(unit_shadow_range, targets.shadow_range_map, 0);
    gl.BindVertexArray(vertex_array);
    gl.Enable(GL_DEPTH_TEST);
}

void Renderer::Parts::draw_occlusion() const {
    const GlFunctions& gl = context->gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets.geometry);
    gl.Viewport(0, 0, targets.half_width, targets.half_height);
    gl.ClearColor(0.0f, 0.0f, 0.0f, 1e6f);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    geometry_program.use(gl);
    for (const Draw& draw : prepared.draws) {
        if (draw.closed) {
            gl.Enable(GL_CULL_FACE);
        } else {
            gl.Disable(GL_CULL_FACE);
        }
        geometry_program.set(gl, "model", draw.model);
        draw_indices(draw);
    }
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_DEPTH_TEST);
    gl.BindVertexArray(empty_array);
    bind_texture(unit_geometry, targets.geometry_map, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets.rough_occlusion);
    occlusion_program.use(gl);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    bind_texture(unit_rough, targets.rough_occlusion_map, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, targets.occlusion);
    smooth_program.use(gl);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.BindVertexArray(vertex_array);
    gl.Enable(GL_DEPTH_TEST);
}

void Renderer::Parts::set_material(const Frame& frame, const Draw& draw, const Program& program) const {
    const GlFunctions& gl = context->gl();
    switch (draw.surface) {
    case Surface::ground: {
        const Shape& shape = frame.shapes[draw.index];
        program.set(gl, "colour", linear(shape.colour, shape.endless ? 1.0f : 0.0f));
        break;
    }
    case Surface::solid: {
        const Shape& shape = frame.shapes[draw.index];
        program.set(gl, "colour", linear(shape.colour, shape.marking));
        break;
    }
    case Surface::cloth: {
        const Cloth& cloth = frame.cloths[draw.index];
        const auto side = [&](const ClothSide& s, const char* first, const char* second, const char* third) {
            program.set(gl, first, linear(s.colour, static_cast<float>(s.pattern)));
            program.set(gl, second, linear(s.second_colour, s.repeat));
            program.set(gl, third, linear(s.accent, 0.0f));
        };
        side(cloth.front, "front_colours[0]", "front_colours[1]", "front_colours[2]");
        side(cloth.back, "back_colours[0]", "back_colours[1]", "back_colours[2]");
        program.set(gl, "thickness", cloth.thickness);
        program.set(gl, "translucency", std::clamp(cloth.translucency, 0.0f, 1.0f));
        break;
    }
    case Surface::rope: {
        const Rope& rope = frame.ropes[draw.index];
        const std::uint32_t end = prepared.mesh.indices[draw.first + draw.count - 1];
        const std::uint32_t start = prepared.mesh.indices[draw.first];
        const float whipping = rope.whipping_length < 0.0f ? 3.0f * rope.radius : rope.whipping_length;
        // The outermost ring of a cap stands one radius beyond the last point.
        const float first_arc = prepared.mesh.vertices[start].texture.y + rope.radius;
        const float last_arc = prepared.mesh.vertices[end].texture.y - rope.radius;
        program.set(gl, "rope_colour", linear(rope.colour, static_cast<float>(rope.strands)));
        program.set(gl, "tracer_colour", linear(rope.second_colour, std::clamp(rope.tracer, 0.0f, 1.0f)));
        program.set(gl, "end_colour", linear(rope.end_colour, whipping));
        program.set(gl, "rope_shape",
                    glm::vec4(rope.radius, rope.lay_length > 0.0f ? rope.lay_length : 7.0f * rope.radius,
                              first_arc, last_arc));
        break;
    }
    }
}

void Renderer::Parts::draw_picture(const Frame& frame) const {
    const GlFunctions& gl = context->gl();
    bind_texture(unit_sun_shadow, targets.shadow_map, targets.compare_sampler);
    bind_texture(unit_sun_depth, targets.shadow_map, targets.depth_sampler);
    bind_texture(unit_occlusion, targets.occlusion_map, 0);
    bind_texture(unit_geometry, targets.geometry_map, 0);

    gl.BindFramebuffer(GL_FRAMEBUFFER, targets.picture);
    gl.Viewport(0, 0, targets.width, targets.height);
    gl.Enable(GL_FRAMEBUFFER_SRGB);
    gl.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);

    // What is smaller and nearer comes first: the ground and the sky are then shaded only where they are
    // seen.
    constexpr Surface order[] = {Surface::cloth, Surface::solid, Surface::rope, Surface::ground};
    for (const Surface surface : order) {
        const Program& program = surface == Surface::cloth   ? cloth_program
                                 : surface == Surface::rope  ? rope_program
                                 : surface == Surface::solid ? solid_program
                                                             : ground_program;
        program.use(gl);
        for (const Draw& draw : prepared.draws) {
            if (draw.surface == surface) {
                if (draw.closed) {
                    gl.Enable(GL_CULL_FACE);
                } else {
                    gl.Disable(GL_CULL_FACE);
                }
                set_material(frame, draw, program);
                program.set(gl, "model", draw.model);
                draw_indices(draw);
            }
        }
    }
    gl.Disable(GL_CULL_FACE);
    gl.DepthFunc(GL_LEQUAL);
    gl.BindVertexArray(empty_array);
    sky_program.use(gl);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.DepthFunc(GL_LESS);

    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, targets.picture);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, targets.resolved);
    gl.BlitFramebuffer(0, 0, targets.width, targets.height, 0, 0, targets.width, targets.height,
                       GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl.Disable(GL_FRAMEBUFFER_SRGB);
}

void Renderer::Parts::read(Image& image) const {
    const GlFunctions& gl = context->gl();
    const auto width = static_cast<std::size_t>(targets.width);
    std::vector<std::uint8_t> raw(width * static_cast<std::size_t>(targets.height) * 4);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, targets.resolved);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.ReadPixels(0, 0, targets.width, targets.height, GL_RGBA, GL_UNSIGNED_BYTE, raw.data());
    // OpenGL's rows go upwards.
    Image drawn(targets.width, targets.height);
    for (int y = 0; y < targets.height; ++y) {
        const std::uint8_t* from = raw.data() + static_cast<std::size_t>(targets.height - 1 - y) * width * 4;
        std::uint8_t* to = drawn.at(0, y);
        for (std::size_t x = 0; x < width; ++x) {
            to[x * 3] = from[x * 4];
            to[x * 3 + 1] = from[x * 4 + 1];
            to[x * 3 + 2] = from[x * 4 + 2];
        }
    }
    image = std::move(drawn);
}

Renderer::Renderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Renderer::~Renderer() {
    parts_->destroy();
}

std::unique_ptr<Renderer> Renderer::create(const RendererOptions& options, std::string& error) {
    std::unique_ptr<Renderer> renderer(new Renderer(std::make_unique<Parts>()));
    renderer->parts_->options = options;
    if (!renderer->parts_->create(error)) {
        return nullptr;
    }
    return renderer;
}

bool Renderer::draw(const Frame& frame, Image& image, std::string& error) {
    if (!validate(frame, error)) {
        return false;
    }
    Parts& parts = *parts_;
    if (std::string answer; !parts.context->make_current(answer)) {
        error = "the renderer says " + answer;
        return false;
    }
    const GlFunctions& gl = parts.context->gl();
    prepare(frame, parts.prepared);
    parts.upload(describe_scene(frame, parts.prepared.sun, parts.targets.width, parts.targets.height));
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    for (int level = 0; level < Targets::shadow_levels; ++level) {
        parts.draw_shadow(parts.targets.shadow[level], Targets::shadow_size >> level);
    }
    parts.draw_shadow_range();
    parts.draw_occlusion();
    parts.draw_picture(frame);
    Image drawn;
    parts.read(drawn);
    if (const GLenum code = gl.GetError(); code != GL_NO_ERROR) {
        error = "the driver reports error " + std::to_string(code) + " while drawing";
        return false;
    }
    draw_legend(drawn, frame.legend);
    image = std::move(drawn);
    return true;
}

const ContextInfo& Renderer::info() const {
    return parts_->context->info();
}

} // namespace render
