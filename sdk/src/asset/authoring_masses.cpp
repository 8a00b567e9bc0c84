#include "asset/authoring_masses.h"

#include "api/authoring_number.h"
#include "api/authoring_text.h"
#include "asset/authoring_values.h"

namespace lks {
namespace {

using fixed::Scaled;

AuthoredRange positive_range(const char* text) {
    // Wide enough for every cloth or rope whose vertices come to a mass in their own range.
    return {Scaled::ratio(1, 1000000000000000), Scaled::from_u64(10000000000000), text};
}

lks_result check_vertex_mass(const Build& build, std::uint32_t vertex) {
    const Scaled low = Scaled::ratio(1, 100000000);
    const Scaled high = Scaled::from_u64(1000000);
    if (!(build.masses[vertex] < low) && !(high < build.masses[vertex])) {
        return LKS_OK;
    }
    return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "Vertex " << vertex << " comes to a mass of "
                                                             << SignedScaled{false, build.masses[vertex]}
                                                             << " kg; it must be from 1e-8 to 1e6 kg.");
}

// Its range is checked with everybody else's.
lks_result read_vertex_mass(Build& build, std::uint32_t vertex, double value) {
    SignedScaled number;
    if (!decode_double(value, number) || number.negative) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT, Sentence() << "The mass of vertex " << vertex << " is "
                                                                 << Authored{value}
                                                                 << "; it must be from 1e-8 to 1e6 kg.");
    }
    build.masses[vertex] = number.magnitude;
    return LKS_OK;
}

// The sources are told apart by their bits: +0 and -0 are "not given".
bool is_given(double value) {
    return bits_of(value) << 1 != 0;
}

} // namespace

lks_result spread_mass(Build& build, const MassSource& source, const Array<Scaled>& extents,
                       const Scaled& unit) {
    const int given = (is_given(source.mass) ? 1 : 0) + (is_given(source.density) ? 1 : 0) +
                      (source.vertex_masses != nullptr ? 1 : 0);
    if (given != 1) {
        return build.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "Exactly one of mass, " << source.density_name
                                     << " and vertex_masses must be given, but mass is "
                                     << Authored{source.mass} << ", " << source.density_name << " "
                                     << Authored{source.density} << " and vertex_masses "
                                     << (source.vertex_masses == nullptr ? "null" : "given") << ".");
    }
    const auto count = static_cast<std::uint32_t>(extents.size());
    if (!build.masses.resize(count)) {
        return build.fail_out_of_memory();
    }
    Scaled factor;
    if (source.vertex_masses == nullptr) {
        const bool total = is_given(source.mass);
        const lks_result result = total ? read_authored(build.error, "mass", source.mass,
                                                        positive_range("from 1e-15 to 1e13 kg"), factor)
                                        : read_authored(build.error, source.density_name, source.density,
                                                        positive_range("from 1e-15 to 1e13"), factor);
        if (result != LKS_OK) {
            return result;
        }
        if (total) {
            Scaled sum;
            for (const Scaled& extent : extents) {
                sum = sum + extent;
            }
            factor = factor / sum;
        } else {
            factor = factor * unit;
        }
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        if (source.vertex_masses == nullptr) {
            build.masses[i] = factor * extents[i];
        } else if (const lks_result result = read_vertex_mass(build, i, source.vertex_masses[i]);
                   result != LKS_OK) {
            return result;
        }
        if (const lks_result result = check_vertex_mass(build, i); result != LKS_OK) {
            return result;
        }
    }
    return LKS_OK;
}

} // namespace lks
