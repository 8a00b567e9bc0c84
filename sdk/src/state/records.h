// Records: structs of integers without padding that stand in an image as they stand in the memory of a
// little-endian host. There they are copied, compared and hashed whole, elsewhere field by field.
//
// record_fields(io, record) (state/rigid_fields.h) names the fields of each kind of record in their order.
#pragma once

#include <type_traits>

#include "state/field_io.h"
#include "state/rigid_fields.h"

namespace lks {

template <typename Record>
inline constexpr bool is_record = std::has_unique_object_representations_v<Record>;

// On hosts where a record's memory is not its bytes.
template <typename Io, typename Record>
void each_by_fields(Io io, const Record* records, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        Record record = records[i];
        record_fields(io, record);
    }
}

template <typename Record>
void write_records(ByteWriter& out, const Record* records, std::size_t count) {
    static_assert(is_record<Record>);
    if constexpr (host_is_little_endian) {
        out.block(records, count * sizeof(Record));
    } else {
        each_by_fields(Writing(out), records, count);
    }
}

template <typename Record>
void write_record(ByteWriter& out, const Record& record) {
    write_records(out, &record, 1);
}

// From as many bytes as they take.
template <typename Record>
void read_records(const unsigned char* at, Record* records, std::size_t count) {
    static_assert(is_record<Record>);
    if constexpr (host_is_little_endian) {
        if (count != 0) {
            std::memcpy(records, at, count * sizeof(Record));
        }
    } else {
        ByteReader in(at, count * sizeof(Record));
        Reading reading(in);
        for (std::size_t i = 0; i < count; ++i) {
            record_fields(reading, records[i]);
        }
    }
}

template <typename Record>
void read_record(const unsigned char* at, Record& record) {
    read_records(at, &record, 1);
}

// Whether they would be written as these bytes.
template <typename Record>
bool same_records(const unsigned char* at, const Record* records, std::size_t count) {
    static_assert(is_record<Record>);
    if constexpr (host_is_little_endian) {
        // Without branches; loads of its own for each kind of record, so that the processor sees what comes
        // next.
        const auto* own = reinterpret_cast<const unsigned char*>(records);
        std::int64_t different = 0;
        for (std::size_t i = 0; i < count * sizeof(Record); i += 8) {
            different |= read_i64(at + i) ^ read_i64(own + i);
        }
        return different == 0;
    } else {
        bool same = true;
        for (std::size_t i = 0; i < count; ++i) {
            unsigned char own[sizeof(Record)];
            ByteWriter out(own);
            write_record(out, records[i]);
            same = same && std::memcmp(at + i * sizeof(Record), own, sizeof(Record)) == 0;
        }
        return same;
    }
}

template <typename Record>
void hash_records(Hash& hash, const Record* records, std::size_t count) {
    static_assert(is_record<Record>);
    if constexpr (host_is_little_endian) {
        if (count != 0) {
            hash.add_bytes(records, count * sizeof(Record));
        }
    } else {
        each_by_fields(Hashing(hash), records, count);
    }
}

template <typename Record>
void hash_record(Hash& hash, const Record& record) {
    hash_records(hash, &record, 1);
}

} // namespace lks
