// A linked pair of shaders.
#pragma once

#include <initializer_list>
#include <string>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "render/gl_functions.h"

namespace render {

class Program {
public:
    Program() = default;
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    // Each stage is its pieces one after another. The uniform block Scene, where used, gets binding 0. False
    // with the driver's answer in error.
    bool link(const GlFunctions& gl, const char* name, std::initializer_list<const char*> vertex,
              std::initializer_list<const char*> fragment, std::string& error);
    void destroy(const GlFunctions& gl);

    void use(const GlFunctions& gl) const { gl.UseProgram(program_); }
    // Of the program in use. Uniforms that the linker has dropped are ignored.
    void set(const GlFunctions& gl, const char* uniform, int value) const;
    void set(const GlFunctions& gl, const char* uniform, float value) const;
    void set(const GlFunctions& gl, const char* uniform, const glm::vec4& value) const;
    void set(const GlFunctions& gl, const char* uniform, const glm::mat4& value) const;

private:
    GLuint program_ = 0;
};

} // namespace render
