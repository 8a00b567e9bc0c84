// Sentences: numbers in decimal without floating point, and what a definition's error field receives.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "api/authoring_number.h"
#include "api/authoring_text.h"
#include "asset_inspection.h"
#include "support/builders.h"

using lks::Authored;
using lks::Sentence;

namespace {

std::string text(double value) {
    Sentence sentence;
    sentence << Authored{value};
    return sentence.text();
}

std::string world_text(std::int64_t value) {
    Sentence sentence;
    sentence.world_value(value);
    return sentence.text();
}

} // namespace

TEST_CASE("authored numbers are printed with up to nine significant digits") {
    CHECK(text(0.0) == "0");
    CHECK(text(-0.0) == "0");
    CHECK(text(1.0) == "1");
    CHECK(text(-1.0) == "-1");
    CHECK(text(0.1) == "0.1");
    CHECK(text(-2.5) == "-2.5");
    CHECK(text(61.0) == "61");
    CHECK(text(60.000001) == "60.000001");
    CHECK(text(0.3) == "0.3");
    CHECK(text(100.1) == "100.1");
    CHECK(text(1.0 / 3) == "0.333333333");
    CHECK(text(2.0 / 3) == "0.666666667");
    CHECK(text(0.9999999999) == "1");
    CHECK(lks::classify_double(std::nan("")) == lks::NumberClass::not_a_number);
    CHECK(text(std::numeric_limits<double>::quiet_NaN()) == "NaN");
    CHECK(text(std::numeric_limits<double>::infinity()).find("inf") != std::string::npos);
    CHECK(text(-std::numeric_limits<double>::infinity())[0] == '-');
}

TEST_CASE("a printed number read back is the authored one within half a unit of its ninth digit") {
    support::Random random(7);
    std::uint32_t wrong = 0;
    double values[2000];
    for (double& value : values) {
        value = std::ldexp(1 + static_cast<double>(random.between(0, 999999999)) * 1e-9,
                           static_cast<int>(random.between(-1000, 1000)));
    }
    values[0] = std::numeric_limits<double>::max();
    values[1] = std::numeric_limits<double>::min();
    values[2] = 1e-9;
    values[3] = 1e9;
    values[4] = 123456789e12;
    for (const double value : values) {
        const std::string printed = text(value);
        const double back = std::strtod(printed.c_str(), nullptr);
        wrong += std::fabs(back / value - 1) <= 5.1e-9 && printed.size() <= 24 ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(text(5e-324).size() <= 24);
    CHECK(std::strtod(text(5e-324).c_str(), nullptr) == 5e-324);
}

TEST_CASE("small and large numbers are printed with a power of ten, others without") {
    CHECK(text(1e-10) == "1e-10");
    CHECK(text(-9e-9) == "-9e-9");
    CHECK(text(1.23456789e-7) == "1.23456789e-7");
    CHECK(text(0.00099999) == "0.00099999");
    CHECK(text(0.0001) == "0.0001");
    CHECK(text(0.000099) == "9.9e-5");
    CHECK(text(123456789) == "123456789");
    CHECK(text(100000000) == "100000000");
    CHECK(text(2.5e10) == "2.5e10");
    CHECK(text(1e9) == "1e9");
    CHECK(text(999999999.9) == "1e9");
}

TEST_CASE("integers and World values are printed in full and a sentence is cut at its capacity") {
    Sentence sentence;
    (sentence << INT64_MIN << " " << UINT64_MAX << " " << std::int32_t{-7} << " ").hexadecimal(0xfedc);
    CHECK(std::string(sentence.text()) == "-9223372036854775808 18446744073709551615 -7 000000000000fedc");
    CHECK(world_text(0) == "0");
    CHECK(world_text(LKS_FIXED(-3)) == "-3");
    CHECK(world_text(LKS_FIXED(3) / 2) == "1.5");
    CHECK(world_text(-LKS_FIXED_ONE / 8) == "-0.125");
    CHECK(world_text(LKS_FIXED_ONE / 64) == "0.015625");
    CHECK(world_text(LKS_FIXED_RATIO(1, 1000)) == "0.001"); // it is a little less
    CHECK(world_text(LKS_FIXED_RATIO(-1, 1000)) == "-0.001");
    CHECK(world_text(LKS_FIXED_RATIO(2, 3)) == "0.666666666666");
    CHECK(world_text(LKS_FIXED_RATIO(999999, 1000000) + 1) == "0.999999");
    // What is just beyond a limit is not printed as the limit.
    CHECK(world_text(-1) == "-0.000000000001");
    CHECK(world_text(LKS_FIXED(2) + 2) == "2.000000000002");
    CHECK(world_text(LKS_FIXED(2) - 2) == "1.999999999998");
    CHECK(world_text(INT64_MIN) == "-8388608");
    CHECK(world_text(INT64_MAX) == "8388608");
    Sentence longer;
    for (int i = 0; i < 100; ++i) {
        longer << "twelve chars";
    }
    CHECK(std::strlen(longer.text()) == LKS_MESSAGE_CAPACITY - 1);
}

TEST_CASE("a printed World value read back is the one that was printed, to a unit") {
    support::Random random(11);
    int wrong = 0;
    for (int i = 0; i < 4000; ++i) {
        const std::int64_t value = random.between(-1, 1) * random.between(0, std::int64_t{1} << (i % 52));
        const std::string printed = world_text(value);
        const double back = std::ldexp(std::strtod(printed.c_str(), nullptr), 40);
        wrong += std::fabs(back - static_cast<double>(value)) <= 1.5 ? 0 : 1;
        // Six digits come back as they were written.
        const std::int64_t millionths = random.between(-99999999, 99999999);
        const auto nearest = static_cast<std::int64_t>(std::round(std::ldexp(millionths * 1e-6, 40)));
        const std::string six = world_text(nearest);
        const bool is_short = six.find('.') == std::string::npos || six.size() - six.find('.') <= 7;
        wrong += is_short && std::fabs(std::strtod(six.c_str(), nullptr) - millionths * 1e-6) < 1e-12 ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a successful call leaves LKS_OK and an empty sentence") {
    lks_error error;
    std::memset(&error, 0x5a, sizeof(error));
    lks_rope_def def = lks_default_rope_def();
    def.error = &error;
    lks_asset* asset = nullptr;
    REQUIRE(lks_asset_create_rope(&def, &asset) == LKS_OK);
    CHECK(error.result == LKS_OK);
    CHECK(std::strlen(error.message) == 0);
    lks_asset_release(asset);
}

TEST_CASE("a refused mass or material is named with its vertex or family and its true size") {
    lks_error error{};
    lks_asset* asset = nullptr;
    lks_cloth_def def = lks_default_cloth_def();
    def.error = &error;
    const auto message = [&] {
        CHECK(lks_asset_create_cloth(&def, &asset) == LKS_ERROR_INVALID_ARGUMENT);
        return std::string(error.message);
    };
    const auto names = [](const std::string& sentence, const char* part) {
        INFO(sentence);
        CHECK(sentence.find(part) != std::string::npos);
    };
    def.bend.damping = 2e10;
    names(message(), "bend damping is 2e10");
    def.bend.damping = 0;
    def.shear.compliance = -0.5;
    names(message(), "shear compliance is -0.5");
    def.shear.compliance = 0;

    std::vector<double> masses(441, 0.001);
    def.area_density = 0;
    def.vertex_masses = masses.data();
    for (const double bad : {-2.0, 0.0, 2e7, 1e-9, 1e300}) {
        masses[17] = bad;
        const std::string sentence = message();
        names(sentence, "ertex 17 ");
        names(sentence, text(bad).c_str());
    }
    CHECK(asset == nullptr);
}
