// OSMesa: Mesa's drawing into memory, for machines whose EGL is missing or broken. The same software
// rasteriser as EGL's, and the same pixels.
//
// Its few declarations are repeated here: osmesa.h pulls in gl.h, which clashes with glcorearb.h, and its
// package would be one more to install for building.
#include "render/context.h"

#include <array>
#include <cstdint>

#include <dlfcn.h>

namespace render {
namespace {

struct OsMesaContextData;
using OsMesaHandle = OsMesaContextData*;

constexpr int osmesa_format = 0x22;
constexpr int osmesa_rgba = 0x1908;
constexpr int osmesa_depth_bits = 0x30;
constexpr int osmesa_profile = 0x33;
constexpr int osmesa_core_profile = 0x34;
constexpr int osmesa_major_version = 0x36;
constexpr int osmesa_minor_version = 0x37;

struct OsMesaFunctions {
    OsMesaHandle (*create_context_attribs)(const int* attributes, OsMesaHandle shared) = nullptr;
    void (*destroy_context)(OsMesaHandle context) = nullptr;
    unsigned char (*make_current)(OsMesaHandle context, void* buffer, unsigned type, int width,
                                  int height) = nullptr;
    OsMesaHandle (*current_context)() = nullptr;
    GlFunction (*get_proc_address)(const char* name) = nullptr;
};

template <class Function>
bool find(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    return function != nullptr;
}

bool load_osmesa(OsMesaFunctions& osmesa, std::string& error) {
    void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        library = dlopen("libOSMesa.so.6", RTLD_NOW | RTLD_LOCAL);
    }
    if (library == nullptr) {
        error = "that libOSMesa.so.8 is not there";
        return false;
    }
    if (!find(library, "OSMesaCreateContextAttribs", osmesa.create_context_attribs) ||
        !find(library, "OSMesaDestroyContext", osmesa.destroy_context) ||
        !find(library, "OSMesaMakeCurrent", osmesa.make_current) ||
        !find(library, "OSMesaGetCurrentContext", osmesa.current_context) ||
        !find(library, "OSMesaGetProcAddress", osmesa.get_proc_address)) {
        error = "that its library lacks a function";
        return false;
    }
    return true;
}

const OsMesaFunctions* osmesa_functions(std::string& error) {
    static OsMesaFunctions functions;
    static std::string answer;
    static const bool loaded = load_osmesa(functions, answer);
    if (!loaded) {
        error = answer;
        return nullptr;
    }
    return &functions;
}

class OsMesaContext final : public Context {
public:
    explicit OsMesaContext(const OsMesaFunctions& osmesa) : osmesa_(osmesa) {}

    ~OsMesaContext() override {
        if (context_ != nullptr) {
            if (osmesa_.current_context() == context_) {
                osmesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
            }
            osmesa_.destroy_context(context_);
        }
    }

    bool create(std::string& error) {
        const int attributes[] = {osmesa_format,
                                  osmesa_rgba,
                                  osmesa_depth_bits,
                                  0,
                                  osmesa_profile,
                                  osmesa_core_profile,
                                  osmesa_major_version,
                                  3,
                                  osmesa_minor_version,
                                  3,
                                  0};
        context_ = osmesa_.create_context_attribs(attributes, nullptr);
        if (context_ == nullptr) {
            error = "that no OpenGL 3.3 core context can be made";
            return false;
        }
        if (!make_current(error)) {
            return false;
        }
        std::string answer;
        if (!load(osmesa_.get_proc_address, "OSMesa", answer)) {
            error = "that " + answer;
            return false;
        }
        return true;
    }

    bool make_current(std::string& error) override {
        if (osmesa_.current_context() == context_) {
            return true;
        }
        if (osmesa_.make_current(context_, unused_.data(), GL_UNSIGNED_BYTE, unused_size, unused_size) == 0) {
            error = "that the context cannot be made current";
            return false;
        }
        return true;
    }

private:
    // OSMesa insists on a window's memory although everything is drawn into framebuffer objects.
    static constexpr int unused_size = 16;

    const OsMesaFunctions& osmesa_;
    OsMesaHandle context_ = nullptr;
    std::array<std::uint32_t, unused_size * unused_size> unused_{};
};

} // namespace

std::unique_ptr<Context> create_osmesa_context(std::string& error) {
    const OsMesaFunctions* osmesa = osmesa_functions(error);
    if (osmesa == nullptr) {
        return nullptr;
    }
    auto context = std::make_unique<OsMesaContext>(*osmesa);
    if (!context->create(error)) {
        return nullptr;
    }
    return context;
}

} // namespace render
