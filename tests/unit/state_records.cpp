// Records stand in an image as their fields do one by one, and ranges of words are ranges of values.
#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <vector>

#include "state/records.h"
#include "state/word_ranges.h"

using namespace lks;

namespace {

// A record with another value in each byte of each field, put there through its fields.
template <typename Record>
Record numbered() {
    std::vector<unsigned char> bytes(sizeof(Record));
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = static_cast<unsigned char>(7 * i + 1);
    }
    ByteReader in(bytes.data(), bytes.size());
    Reading reading(in);
    Record record{};
    record_fields(reading, record);
    CHECK(in.complete());
    CHECK(in.left() == 0);
    return record;
}

template <typename Record>
void check_record() {
    const Record records[2] = {numbered<Record>(), Record{}};
    std::vector<unsigned char> whole(2 * sizeof(Record));
    ByteWriter out(whole.data());
    write_records(out, records, 2);

    std::vector<unsigned char> by_fields(2 * sizeof(Record));
    ByteWriter fields_out(by_fields.data());
    Writing writing(fields_out);
    Hash hash_by_fields;
    Hashing hashing(hash_by_fields);
    for (Record record : records) {
        record_fields(writing, record);
        record_fields(hashing, record);
    }
    CHECK(whole == by_fields);
    CHECK(whole[0] == 1);
    CHECK(whole[sizeof(Record) - 1] == static_cast<unsigned char>(7 * (sizeof(Record) - 1) + 1));
    Hash hash;
    hash_records(hash, records, 2);
    CHECK(hash.finish() == hash_by_fields.finish());

    Record back[2] = {};
    read_records(whole.data(), back, 2);
    const bool same = std::memcmp(back, records, sizeof(back)) == 0;
    CHECK(same);
    CHECK(same_records(whole.data(), records, 2));
    CHECK(same_records(whole.data(), records, 0));
    std::size_t unseen = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        whole[i] ^= 0x10;
        unseen += same_records(whole.data(), records, 2) ? 1 : 0;
        whole[i] ^= 0x10;
    }
    CHECK(unseen == 0);
}

} // namespace

TEST_CASE("records are written, read, compared and hashed as their fields are") {
    check_record<BodySettings>();
    check_record<lks_body_shape>();
    check_record<BodyState>();
    check_record<JointDescription>();
    check_record<JointState>();
    check_record<ContactPush>();
    check_record<ContactMemory>();
}

TEST_CASE("a range of words holds what lies within it and nothing else") {
    constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
    const std::int64_t edges[] = {0, 1, 17, std::int64_t{1} << 50, (std::int64_t{1} << 62) + 5, highest - 1};
    std::vector<std::int64_t> values{lowest, lowest + 1, highest - 1, highest, 0, 1, -1};
    for (const std::int64_t edge : edges) {
        for (const std::int64_t beside : {edge - 1, edge, edge + 1, -edge - 1, -edge, -edge + 1}) {
            values.push_back(beside);
        }
    }
    std::size_t wrong = 0;
    for (const std::int64_t least : edges) {
        for (const std::int64_t greatest : edges) {
            WordRanges<3> ranges;
            ranges.between(0, 0).between(-least, greatest, 2);
            for (const std::int64_t value : values) {
                for (const std::size_t place : {1u, 2u}) {
                    std::int64_t words[3] = {};
                    words[place] = value;
                    unsigned char bytes[sizeof(words)];
                    ByteWriter out(bytes);
                    out.i64_array(words, 3);
                    const bool within = value >= -least && value <= greatest;
                    wrong += ranges.hold(bytes) == within ? 0 : 1;
                    wrong += ranges.hold(bytes, place) ? 0 : 1; // not looked at
                }
            }
        }
    }
    CHECK(wrong == 0);
}
