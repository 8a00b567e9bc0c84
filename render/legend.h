// The legend: two lines in a dark, translucent panel at the lower left of a finished picture.
#pragma once

#include "render/frame.h"
#include "render/image.h"

namespace render {

// Drawn on the finished pixels and not by the card, so that it is the same under every driver.
void draw_legend(Image& image, const Legend& legend);

} // namespace render
