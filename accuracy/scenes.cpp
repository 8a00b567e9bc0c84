#include "scenes.h"

#include "experiment.h"

namespace lks_accuracy {
namespace {

constexpr lks_distance_material inextensible{0, 0, 1, 0};

reference::ParticleScene cloth(std::uint32_t side) {
    const reference::Materials materials{inextensible, lks_distance_material{1e-5, 0, 1, 0},
                                         lks_distance_material{1e-2, 0, 1, 0}};
    reference::ParticleScene scene = reference::make_cloth(side, 2, 1, materials, true);
    scene.linear_damping = 1;
    return scene;
}

} // namespace

MeasuredScene rope_swing() {
    MeasuredScene measured;
    measured.name = "rope_swing";
    measured.title = "Rope, free swing";
    measured.what = "2 m in 40 segments, inextensible, held at one end and let go horizontally; one second.";
    measured.scene = reference::make_rope(40, 2, 0.01, inextensible, {1, 0, 0});
    measured.keeps_energy = true;
    measured.lowest_vertex = 40;
    measured.sag_of = "the rope's end";
    measured.reference_substeps = 2560;
    measured.recommended = {10, 20, 40};
    measured.recommended_at_once = {5, 10, 20};
    return measured;
}

MeasuredScene rope_heavy_end() {
    MeasuredScene measured;
    measured.name = "rope_heavy_end";
    measured.title = "Rope, heavy end";
    measured.what = "2 m in 40 segments of 10 g, 1 kg at the end (1:100), let go at 45°; one second.";
    measured.scene = reference::make_rope(40, 2, 0.01, inextensible, {1, -1, 0});
    measured.scene.masses.back() = 1;
    measured.is_regular = true;
    measured.keeps_energy = true;
    measured.lowest_vertex = 40;
    measured.sag_of = "the rope's end";
    measured.reference_substeps = 2560;
    measured.recommended = {20, 40, 80};
    measured.recommended_at_once = {5, 10, 20};
    return measured;
}

MeasuredScene at_once(MeasuredScene rope) {
    rope.name += at_once_suffix;
    rope.scene.solver = LKS_ROPE_DIRECT;
    rope.recommended = rope.recommended_at_once;
    return rope;
}

MeasuredScene tethered(MeasuredScene cloth) {
    cloth.name += tethered_suffix;
    cloth.scene.tethers = 2;
    return cloth;
}

namespace {

MeasuredScene hanging(std::uint32_t side) {
    MeasuredScene measured;
    measured.what = "2 m × 2 m, " + std::to_string(side) + " × " + std::to_string(side) +
                    " vertices, 1 kg, inextensible along its threads, held at two corners and let go "
                    "horizontally, in air (1/s).";
    measured.scene = cloth(side);
    measured.scene.pins = {0, side - 1};
    measured.ticks = 120;
    measured.lowest_vertex = std::size_t{side} * (side - 1) + side / 2;
    measured.sag_of = "the middle of the lower edge";
    measured.has_compliance = true;
    return measured;
}

} // namespace

MeasuredScene cloth_hang() {
    MeasuredScene measured = hanging(32);
    measured.name = "cloth_hang";
    measured.title = "Cloth, hanging";
    measured.recommended = {10, 20, 40};
    return measured;
}

MeasuredScene cloth_fine() {
    MeasuredScene measured = hanging(64);
    measured.name = "cloth_fine";
    measured.title = "Fine cloth, hanging";
    measured.recommended = {20, 40};
    return measured;
}

MeasuredScene cloth_drape() {
    MeasuredScene measured;
    measured.name = "cloth_drape";
    measured.title = "Cloth, drape";
    measured.what =
        "2 m × 2 m, 24 × 24 vertices, 1 kg, falls on a frictionless ball of 0.5 m; one second. Where it "
        "folds it is chaotic, so that places are compared after a quarter of a second.";
    measured.scene = cloth(24);
    measured.scene.ball = {{0.1, -0.6, 0.07}, 0.5};
    measured.deviation_tick = 15;
    measured.sag_of = "the cloth's centre of mass";
    measured.has_compliance = true;
    measured.recommended = {10, 20, 40};
    return measured;
}

std::vector<MeasuredScene> measured_scenes() {
    return {rope_swing(), rope_heavy_end(), cloth_hang(), cloth_drape()};
}

} // namespace lks_accuracy
