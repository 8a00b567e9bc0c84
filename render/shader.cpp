#include "render/shader.h"

#include <vector>

#include <glm/gtc/type_ptr.hpp>

namespace render {
namespace {

GLuint compile(const GlFunctions& gl, GLenum stage, std::initializer_list<const char*> pieces,
               std::string& answer) {
    const GLuint shader = gl.CreateShader(stage);
    const std::vector<const char*> sources(pieces);
    gl.ShaderSource(shader, static_cast<GLsizei>(sources.size()), sources.data(), nullptr);
    gl.CompileShader(shader);
    GLint compiled = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) {
        return shader;
    }
    char log[1024] = "";
    gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
    answer = log;
    gl.DeleteShader(shader);
    return 0;
}

} // namespace

bool Program::link(const GlFunctions& gl, const char* name, std::initializer_list<const char*> vertex,
                   std::initializer_list<const char*> fragment, std::string& error) {
    std::string answer;
    const GLuint vertex_shader = compile(gl, GL_VERTEX_SHADER, vertex, answer);
    const GLuint fragment_shader = vertex_shader != 0 ? compile(gl, GL_FRAGMENT_SHADER, fragment, answer) : 0;
    bool linked = false;
    if (fragment_shader != 0) {
        program_ = gl.CreateProgram();
        gl.AttachShader(program_, vertex_shader);
        gl.AttachShader(program_, fragment_shader);
        gl.LinkProgram(program_);
        GLint status = 0;
        gl.GetProgramiv(program_, GL_LINK_STATUS, &status);
        linked = status == GL_TRUE;
        if (!linked) {
            char log[1024] = "";
            gl.GetProgramInfoLog(program_, sizeof log, nullptr, log);
            answer = log;
            destroy(gl);
        }
    }
    if (vertex_shader != 0) {
        gl.DeleteShader(vertex_shader);
    }
    if (fragment_shader != 0) {
        gl.DeleteShader(fragment_shader);
    }
    if (!linked) {
        error = std::string("the driver refuses the ") + name + " shader: " + answer;
        return false;
    }
    const GLuint block = gl.GetUniformBlockIndex(program_, "Scene");
    if (block != GL_INVALID_INDEX) {
        gl.UniformBlockBinding(program_, block, 0);
    }
    return true;
}

void Program::destroy(const GlFunctions& gl) {
    if (program_ != 0) {
        gl.DeleteProgram(program_);
        program_ = 0;
    }
}

void Program::set(const GlFunctions& gl, const char* uniform, int value) const {
    gl.Uniform1i(gl.GetUniformLocation(program_, uniform), value);
}

void Program::set(const GlFunctions& gl, const char* uniform, float value) const {
    gl.Uniform1f(gl.GetUniformLocation(program_, uniform), value);
}

void Program::set(const GlFunctions& gl, const char* uniform, const glm::vec4& value) const {
    gl.Uniform4f(gl.GetUniformLocation(program_, uniform), value.x, value.y, value.z, value.w);
}

void Program::set(const GlFunctions& gl, const char* uniform, const glm::mat4& value) const {
    gl.UniformMatrix4fv(gl.GetUniformLocation(program_, uniform), 1, GL_FALSE, glm::value_ptr(value));
}

} // namespace render
