// Fields to bytes, from bytes, and into a hash, in the order in which a function names them once.
#pragma once

#include "state/byte_writer.h"

namespace lks {

class Writing {
public:
    explicit Writing(ByteWriter& out) : out_(out) {}
    void u32(std::uint32_t value) { out_.u32(value); }
    void i32(std::int32_t value) { out_.u32(static_cast<std::uint32_t>(value)); }
    void i64(std::int64_t value) { out_.i64(value); }

private:
    ByteWriter& out_;
};

class Reading {
public:
    explicit Reading(ByteReader& in) : in_(in) {}
    void u32(std::uint32_t& value) { value = in_.u32(); }
    void i32(std::int32_t& value) { value = static_cast<std::int32_t>(in_.u32()); }
    void i64(std::int64_t& value) { value = in_.i64(); }

private:
    ByteReader& in_;
};

class Hashing {
public:
    explicit Hashing(Hash& hash) : hash_(hash) {}
    void u32(std::uint32_t value) { hash_.add_u32(value); }
    void i32(std::int32_t value) { hash_.add_u32(static_cast<std::uint32_t>(value)); }
    void i64(std::int64_t value) { hash_.add_i64(value); }

private:
    Hash& hash_;
};

template <typename Io, typename Vector>
void vector_fields(Io& io, Vector& v) {
    io.i64(v.x);
    io.i64(v.y);
    io.i64(v.z);
}

template <typename Io, typename Rotation>
void rotation_fields(Io& io, Rotation& q) {
    io.i32(q.x);
    io.i32(q.y);
    io.i32(q.z);
    io.i32(q.w);
}

} // namespace lks
