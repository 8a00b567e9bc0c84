// EGL without a display server: Mesa's surfaceless platform, else the devices one after another.
#include "render/context.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <vector>

#include <dlfcn.h>

#define EGL_NO_X11
#define EGL_NO_PLATFORM_SPECIFIC_TYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace render {
namespace {

using GetProcAddress = GlFunction (*)(const char*);

struct EglFunctions {
    GetProcAddress get_proc_address = nullptr;
    PFNEGLQUERYSTRINGPROC query_string = nullptr;
    PFNEGLINITIALIZEPROC initialise = nullptr;
    PFNEGLTERMINATEPROC terminate = nullptr;
    PFNEGLBINDAPIPROC bind_api = nullptr;
    PFNEGLCREATECONTEXTPROC create_context = nullptr;
    PFNEGLDESTROYCONTEXTPROC destroy_context = nullptr;
    PFNEGLMAKECURRENTPROC make_current = nullptr;
    PFNEGLGETCURRENTCONTEXTPROC current_context = nullptr;
    PFNEGLGETERRORPROC get_error = nullptr;
    PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display = nullptr;
    PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr; // may be absent
    std::string client_extensions;
};

template <class Function>
bool find(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    return function != nullptr;
}

// The library stays open for the life of the process: drivers do not survive being unloaded.
bool load_egl(EglFunctions& egl, std::string& error) {
    void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        error = "that libEGL.so.1 is not there";
        return false;
    }
    if (!find(library, "eglGetProcAddress", egl.get_proc_address) ||
        !find(library, "eglQueryString", egl.query_string) ||
        !find(library, "eglInitialize", egl.initialise) || !find(library, "eglTerminate", egl.terminate) ||
        !find(library, "eglBindAPI", egl.bind_api) ||
        !find(library, "eglCreateContext", egl.create_context) ||
        !find(library, "eglDestroyContext", egl.destroy_context) ||
        !find(library, "eglMakeCurrent", egl.make_current) ||
        !find(library, "eglGetCurrentContext", egl.current_context) ||
        !find(library, "eglGetError", egl.get_error)) {
        error = "that libEGL.so.1 lacks a function";
        return false;
    }
    const char* extensions = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    egl.client_extensions = extensions != nullptr ? extensions : "";
    egl.platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.get_proc_address("eglGetPlatformDisplayEXT"));
    egl.query_devices =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.get_proc_address("eglQueryDevicesEXT"));
    if (egl.platform_display == nullptr) {
        error = "that it knows no platform displays";
        return false;
    }
    return true;
}

const EglFunctions* egl_functions(std::string& error) {
    static EglFunctions functions;
    static std::string answer;
    static const bool loaded = load_egl(functions, answer);
    if (!loaded) {
        error = answer;
        return nullptr;
    }
    return &functions;
}

// A display is one object for the whole process, and terminating it ends every context on it.
class DisplayHolds {
public:
    bool take(const EglFunctions& egl, EGLDisplay display) {
        const std::lock_guard lock(mutex_);
        const auto hold = find(display);
        if (hold != holds_.end()) {
            ++hold->count;
            return true;
        }
        if (egl.initialise(display, nullptr, nullptr) != EGL_TRUE) {
            return false;
        }
        holds_.push_back({display, 1});
        return true;
    }

    void give_back(const EglFunctions& egl, EGLDisplay display) {
        const std::lock_guard lock(mutex_);
        const auto hold = find(display);
        if (hold != holds_.end() && --hold->count == 0) {
            egl.terminate(display);
            holds_.erase(hold);
        }
    }

private:
    struct Hold {
        EGLDisplay display;
        int count;
    };

    std::vector<Hold>::iterator find(EGLDisplay display) {
        return std::find_if(holds_.begin(), holds_.end(),
                            [&](const Hold& hold) { return hold.display == display; });
    }

    std::mutex mutex_;
    std::vector<Hold> holds_;
};

DisplayHolds& display_holds() {
    static DisplayHolds holds;
    return holds;
}

const EglFunctions* resolver_functions = nullptr;

GlFunction function_by_name(const char* name) {
    return resolver_functions->get_proc_address(name);
}

std::string error_text(const EglFunctions& egl) {
    static constexpr std::array<const char*, 15> names = {
        "success",           "not initialised",   "bad access",    "bad alloc",   "bad attribute",
        "bad config",        "bad context",       "bad surface",   "bad display", "bad match",
        "bad native pixmap", "bad native window", "bad parameter", "bad surface", "context lost"};
    const EGLint code = egl.get_error();
    const EGLint index = code - EGL_SUCCESS;
    return index >= 0 && index < static_cast<EGLint>(names.size()) ? names[static_cast<std::size_t>(index)]
                                                                   : "error " + std::to_string(code);
}

class EglContext final : public Context {
public:
    EglContext(const EglFunctions& egl, EGLDisplay display) : egl_(egl), display_(display) {}

    ~EglContext() override {
        if (context_ != EGL_NO_CONTEXT) {
            if (egl_.current_context() == context_) {
                egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            }
            egl_.destroy_context(display_, context_);
        }
        if (held_) {
            display_holds().give_back(egl_, display_);
        }
    }

    bool create(const std::string& road, std::string& error) {
        held_ = display_holds().take(egl_, display_);
        if (!held_) {
            error = "that initialising fails (" + error_text(egl_) + ")";
            return false;
        }
        if (egl_.bind_api(EGL_OPENGL_API) != EGL_TRUE) {
            error = "that it has no desktop OpenGL";
            return false;
        }
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     3,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     3,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
        context_ = egl_.create_context(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT) {
            error = "that no OpenGL 3.3 core context can be made (" + error_text(egl_) + ")";
            return false;
        }
        if (!make_current(error)) {
            return false;
        }
        resolver_functions = &egl_;
        std::string answer;
        if (!load(function_by_name, road, answer)) {
            error = "that " + answer;
            return false;
        }
        return true;
    }

    bool make_current(std::string& error) override {
        if (egl_.current_context() == context_) {
            return true;
        }
        if (egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
            error = "that the context cannot be made current (" + error_text(egl_) + ")";
            return false;
        }
        return true;
    }

private:
    const EglFunctions& egl_;
    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
    bool held_ = false;
};

std::unique_ptr<Context> create_on(const EglFunctions& egl, EGLDisplay display, const std::string& road,
                                   std::string& answers) {
    std::string answer;
    if (display == EGL_NO_DISPLAY) {
        answer = "that there is no such display";
    } else {
        auto context = std::make_unique<EglContext>(egl, display);
        if (context->create(road, answer)) {
            return context;
        }
    }
    answers += (answers.empty() ? "" : " and ") + answer + " on " + road;
    return nullptr;
}

} // namespace

std::unique_ptr<Context> create_egl_context(std::string& error) {
    const EglFunctions* egl = egl_functions(error);
    if (egl == nullptr) {
        return nullptr;
    }
    std::string answers;
    if (egl->client_extensions.find("EGL_MESA_platform_surfaceless") != std::string::npos) {
        const EGLDisplay display =
            egl->platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (auto context = create_on(*egl, display, "EGL surfaceless", answers)) {
            return context;
        }
    }
    if (egl->query_devices != nullptr) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (egl->query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
            for (EGLint i = 0; i < count; ++i) {
                const EGLDisplay display = egl->platform_display(
                    EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr);
                if (auto context = create_on(*egl, display, "EGL device " + std::to_string(i), answers)) {
                    return context;
                }
            }
        }
    }
    error = answers.empty() ? "that it has neither a surfaceless platform nor a device" : answers;
    return nullptr;
}

} // namespace render
