#include "render/gl_functions.h"

namespace render {

bool GlFunctions::load(GlFunctionByName by_name, std::string& error) {
#define LKS_GL_LOAD(type, name)                                                                              \
    name = reinterpret_cast<type>(by_name("gl" #name));                                                      \
    if (name == nullptr) {                                                                                   \
        error = "the driver has no function gl" #name;                                                       \
        return false;                                                                                        \
    }
    LKS_GL_FUNCTIONS(LKS_GL_LOAD)
#undef LKS_GL_LOAD
    return true;
}

} // namespace render
