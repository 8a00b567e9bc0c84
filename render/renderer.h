// Frames to pictures.
//
//     std::string error;
//     auto renderer = render::Renderer::create({.width = 1280, .height = 720}, error);
//     render::Image image;
//     if (renderer && renderer->draw(frame, image, error)) { render::write_png("out.png", image, error); }
//
// The same frame gives the same bytes with the same driver, whatever was drawn before. A renderer is used by
// one thread at a time; it makes its own context current when it needs it.
#pragma once

#include <memory>
#include <string>

#include "render/context.h"
#include "render/frame.h"
#include "render/image.h"

namespace render {

struct RendererOptions {
    GlRoad road = GlRoad::automatic;
    int width = 1280;
    int height = 720;
    int samples = 4; // a pixel; fewer where the driver has fewer
};

class Renderer {
public:
    // Null and a sentence in error when there is no context or the driver refuses something.
    static std::unique_ptr<Renderer> create(const RendererOptions& options, std::string& error);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // A frame that does not validate is refused and the image left as it was.
    bool draw(const Frame& frame, Image& image, std::string& error);

    const ContextInfo& info() const;

private:
    struct Parts;
    explicit Renderer(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

} // namespace render
