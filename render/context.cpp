#include "render/context.h"

namespace render {

std::optional<GlRoad> gl_road_from_name(std::string_view name) {
    if (name == "auto") {
        return GlRoad::automatic;
    }
    if (name == "egl") {
        return GlRoad::egl;
    }
    if (name == "osmesa") {
        return GlRoad::osmesa;
    }
    return std::nullopt;
}

bool Context::load(GlFunctionByName by_name, std::string road, std::string& error) {
    if (!gl_.load(by_name, error)) {
        return false;
    }
    GLint major = 0;
    GLint minor = 0;
    gl_.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl_.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 33) {
        error =
            "the driver gives OpenGL " + std::to_string(major) + "." + std::to_string(minor) + ", below 3.3";
        return false;
    }
    const auto text = [this](GLenum name) {
        const GLubyte* value = gl_.GetString(name);
        return std::string(value != nullptr ? reinterpret_cast<const char*>(value) : "unknown");
    };
    info_.road = std::move(road);
    info_.renderer = text(GL_RENDERER);
    info_.version = text(GL_VERSION);
    return true;
}

std::unique_ptr<Context> create_context(GlRoad road, std::string& error) {
    std::string egl_answer;
    std::string osmesa_answer;
    if (road != GlRoad::osmesa) {
        if (auto context = create_egl_context(egl_answer)) {
            return context;
        }
    }
    if (road != GlRoad::egl) {
        if (auto context = create_osmesa_context(osmesa_answer)) {
            return context;
        }
    }
    error = "no offscreen OpenGL context";
    if (!egl_answer.empty()) {
        error += ": EGL says " + egl_answer;
    }
    if (!osmesa_answer.empty()) {
        error += (egl_answer.empty() ? ": OSMesa says " : ", OSMesa says ") + osmesa_answer;
    }
    return nullptr;
}

} // namespace render
