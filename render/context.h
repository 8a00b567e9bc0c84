// An OpenGL 3.3 core context without a display.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "render/gl_functions.h"

namespace render {

// automatic: EGL (surfaceless first, then devices), else OSMesa.
enum class GlRoad { automatic, egl, osmesa };

// "auto", "egl" or "osmesa".
std::optional<GlRoad> gl_road_from_name(std::string_view name);

// A golden image can be expected to the bit where the renderer string is the one it was made with.
struct ContextInfo {
    std::string road;     // "EGL surfaceless", "EGL device 0" or "OSMesa"
    std::string renderer; // GL_RENDERER
    std::string version;  // GL_VERSION
};

class Context {
public:
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    // In the calling thread. A context must not be current in two threads at once.
    virtual bool make_current(std::string& error) = 0;

    const GlFunctions& gl() const { return gl_; }
    const ContextInfo& info() const { return info_; }

protected:
    Context() = default;
    // Of the context that is current: fills the table, the strings, and checks the version.
    bool load(GlFunctionByName by_name, std::string road, std::string& error);

private:
    GlFunctions gl_;
    ContextInfo info_;
};

// A context, current in the calling thread; or null and a sentence that says what every road answered.
std::unique_ptr<Context> create_context(GlRoad road, std::string& error);

// The two roads themselves.
std::unique_ptr<Context> create_egl_context(std::string& error);
std::unique_ptr<Context> create_osmesa_context(std::string& error);

} // namespace render
