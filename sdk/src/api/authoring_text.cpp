#include "api/authoring_text.h"

namespace lks {
namespace {

using fixed::Scaled;

// Of the first digit of what is written without a power of ten.
constexpr int least_plain_exponent = -4;
constexpr int greatest_plain_exponent = 8;
constexpr std::uint64_t digits_limit = 1000000000; // 10^9

// number = digits · 10^exponent with 10^8 ≤ digits < 10^9, rounded.
struct Decimal {
    std::uint64_t digits;
    int exponent;
};

Decimal to_decimal(const Scaled& number) {
    const Scaled ten = Scaled::from_u64(10);
    const Scaled high = Scaled::from_u64(digits_limit);
    const Scaled low = Scaled::from_u64(digits_limit / 10);
    Scaled scaled = number;
    int exponent = 0;
    for (; !(scaled < high); ++exponent) {
        scaled = scaled / ten;
    }
    for (; scaled < low; --exponent) {
        scaled = scaled * ten;
    }
    Decimal decimal{scaled.to_fixed(0), exponent};
    if (decimal.digits == digits_limit) {
        decimal = {digits_limit / 10, exponent + 1};
    }
    return decimal;
}

void write_plain(Sentence& sentence, std::uint64_t digits, int exponent) {
    // A number between 1e-4 and 1e9, whose trailing zeros are gone.
    std::uint64_t power = 1;
    for (int i = 0; i < -exponent; ++i) {
        power *= 10;
    }
    for (int i = 0; i < exponent; ++i) {
        digits *= 10;
    }
    sentence << digits / power;
    if (power == 1) {
        return;
    }
    sentence << ".";
    std::uint64_t rest = digits % power;
    while (power > 1) {
        power /= 10;
        sentence << rest / power;
        rest %= power;
    }
}

} // namespace

Sentence& operator<<(Sentence& sentence, const Authored& number) {
    switch (classify_double(number.value)) {
    case NumberClass::not_a_number:
        return sentence << "NaN";
    case NumberClass::infinite:
        return sentence << (bits_of(number.value) >> 63 != 0 ? "-infinite" : "infinite");
    case NumberClass::finite:
        break;
    }
    SignedScaled exact;
    (void)decode_double(number.value, exact);
    return sentence << exact;
}

Sentence& operator<<(Sentence& sentence, const SignedScaled& exact) {
    if (exact.magnitude.is_zero()) {
        return sentence << "0";
    }
    if (exact.negative) {
        sentence << "-";
    }
    Decimal decimal = to_decimal(exact.magnitude);
    int behind_first = 8; // digits
    while (decimal.digits % 10 == 0) {
        decimal.digits /= 10;
        ++decimal.exponent;
        --behind_first;
    }
    const int first = decimal.exponent + behind_first;
    if (first >= least_plain_exponent && first <= greatest_plain_exponent) {
        write_plain(sentence, decimal.digits, decimal.exponent);
        return sentence;
    }
    write_plain(sentence, decimal.digits, -behind_first);
    return sentence << "e" << first;
}

} // namespace lks
