#include "asset/authoring_values.h"

#include "api/authoring_number.h"
#include "api/authoring_text.h"

namespace lks {
namespace {

using fixed::Scaled;

Scaled whole(std::uint64_t value) {
    return Scaled::from_u64(value);
}

Scaled one_over(std::uint64_t value) {
    return Scaled::ratio(1, value);
}

lks_result refuse(lks_error* error, const char* name, double value, const char* range) {
    return report(error, LKS_ERROR_INVALID_ARGUMENT,
                  Sentence() << "The " << name << " is " << Authored{value} << "; it must be " << range
                             << ".");
}

constexpr std::uint64_t million = 1000000;
constexpr std::uint64_t billion = 1000000000;

} // namespace

lks_result read_authored(lks_error* error, const char* name, double value, const AuthoredRange& range,
                         Scaled& out) {
    SignedScaled number;
    if (!decode_double(value, number) || number.negative || number.magnitude < range.low ||
        range.high < number.magnitude) {
        return refuse(error, name, value, range.text);
    }
    out = number.magnitude;
    return LKS_OK;
}

lks_result read_authored_or_zero(lks_error* error, const char* name, double value, const AuthoredRange& range,
                                 Scaled& out) {
    SignedScaled number;
    if (decode_double(value, number) && number.magnitude.is_zero()) {
        out = Scaled{};
        return LKS_OK;
    }
    return read_authored(error, name, value, range, out);
}

lks_result read_coordinate(lks_error* error, const char* what, std::uint32_t index, char axis, double value,
                           std::int64_t& out) {
    constexpr std::int64_t limit = coordinate_one * 60;
    static_assert(LKS_MAX_ASSET_COORDINATE == 60.0);
    std::int64_t raw = 0;
    if (!to_coordinate(value, coordinate_fraction_bits, raw) || raw > limit || raw < -limit) {
        const char name[2] = {axis, '\0'};
        return report(error, LKS_ERROR_INVALID_ARGUMENT,
                      Sentence() << "The " << name << " of " << what << " " << index << " is "
                                 << Authored{value} << " m; it must be within plus or minus 60 m.");
    }
    out = raw;
    return LKS_OK;
}

lks_result read_length(lks_error* error, const char* name, double value, const LengthRange& range,
                       std::int64_t& out) {
    std::int64_t raw = 0;
    if (!to_coordinate(value, coordinate_fraction_bits, raw) || raw <= 0 ||
        raw > coordinate_one * range.most) {
        return refuse(error, name, value, range.text);
    }
    out = raw;
    return LKS_OK;
}

lks_result read_family(lks_error* error, const char* name, const lks_distance_material& material,
                       Family& out) {
    if (material.enabled > 1 || material.reserved != 0) {
        return report(error, LKS_ERROR_INVALID_ARGUMENT,
                      Sentence() << "The " << name << " material's enabled is " << material.enabled
                                 << " and its reserved field " << material.reserved
                                 << "; they must be 0 or 1, and 0.");
    }
    const Scaled femto = one_over(million * billion);
    const AuthoredRange compliance{femto, whole(million), "0, or from 1e-15 to 1e6 m/N"};
    const AuthoredRange damping{one_over(billion), whole(billion), "0, or from 1e-9 to 1e9 N s/m"};
    Family family;
    family.enabled = material.enabled != 0;
    if (const lks_result result = read_authored_or_zero(error, (Sentence() << name << " compliance").text(),
                                                        material.compliance, compliance, family.compliance);
        result != LKS_OK) {
        return result;
    }
    if (const lks_result result = read_authored_or_zero(error, (Sentence() << name << " damping").text(),
                                                        material.damping, damping, family.damping);
        result != LKS_OK) {
        return result;
    }
    out = family.enabled ? family : Family{};
    return LKS_OK;
}

lks_result read_surface(lks_error* error, double particle_radius, double friction, lks_asset& asset) {
    const AuthoredRange radius_range{Scaled{}, whole(1), "from 0 to 1 m"};
    const AuthoredRange friction_range{Scaled{}, whole(100), "from 0 to 100"};
    Scaled value;
    if (const lks_result result =
            read_authored(error, "particle_radius", particle_radius, radius_range, value);
        result != LKS_OK) {
        return result;
    }
    asset.particle_radius = value.to_i64_fixed(coordinate_fraction_bits);
    if (const lks_result result = read_authored(error, "friction", friction, friction_range, value);
        result != LKS_OK) {
        return result;
    }
    asset.friction = value.to_i64_fixed(world_fraction_bits);
    return LKS_OK;
}

lks_result read_positions(Build& build, const char* what, const double* values, std::uint32_t count) {
    if (!build.positions.resize(count)) {
        return build.fail_out_of_memory();
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        Coordinates& position = build.positions[i];
        const double* xyz = values + std::size_t{3} * i;
        std::int64_t* const out[3] = {&position.x, &position.y, &position.z};
        for (int axis = 0; axis < 3; ++axis) {
            const char name = static_cast<char>('x' + axis);
            if (const lks_result result = read_coordinate(build.error, what, i, name, xyz[axis], *out[axis]);
                result != LKS_OK) {
                return result;
            }
        }
    }
    return LKS_OK;
}

} // namespace lks
