// lockstitch/query.h.
#include <lockstitch/query.h>

#include "api/checks.h"
#include "collide/saturation.h"
#include "query/query.h"

using namespace lks;

namespace {

lks_result check_query(const lks_world& world, const lks_query& query) {
    if (query.struct_size != sizeof(lks_query)) {
        return world.fail(LKS_ERROR_STRUCT_SIZE,
                          wrong_struct_size("query", query.struct_size, sizeof(lks_query)));
    }
    if ((query.kinds & ~LKS_ALL_HITS) != 0 || query.reserved != 0) {
        return world.fail(LKS_ERROR_INVALID_ARGUMENT,
                          Sentence() << "The query's kinds are " << query.kinds << " and its reserved field "
                                     << query.reserved << "; they must be up to 7, and 0.");
    }
    const Number radius[] = {{"query's radius", " m", query.radius, 0, LKS_FIXED(30)}};
    return check_numbers(world, radius);
}

lks_result check_place(const lks_world& world, const lks_vec3& place) {
    return within(place, world_position_limit)
               ? LKS_OK
               : world.fail(LKS_ERROR_INVALID_ARGUMENT,
                            out_of_range("query's place", place, "m", world_position_limit));
}

// Of a function: where its answer goes, and how many there are.
struct AnswerNames {
    const char* function;
    const char* room;
    const char* count;
};

// LKS_OK, or reported.
lks_result check_call(const lks_world* world, const lks_query* query, const void* room, bool room_wanted,
                      const std::uint32_t* count, const AnswerNames& names) {
    if (world == nullptr) {
        return LKS_ERROR_NULL_ARGUMENT;
    }
    if (query == nullptr || (room == nullptr && room_wanted) || count == nullptr) {
        return world->fail(LKS_ERROR_NULL_ARGUMENT,
                           null_argument(names.function, query == nullptr   ? "query"
                                                         : count == nullptr ? names.count
                                                                            : names.room));
    }
    return check_query(*world, *query);
}

} // namespace

extern "C" {

lks_query lks_default_query(void) {
    lks_query query{};
    query.struct_size = sizeof(lks_query);
    query.kinds = LKS_ALL_HITS;
    query.mask = 0xffffffffu;
    return query;
}

lks_result lks_world_cast(const lks_world* world, const lks_query* query, lks_vec3 from, lks_vec3 to,
                          lks_hit* hits, uint32_t capacity, uint32_t* count) {
    if (const lks_result result =
            check_call(world, query, hits, capacity > 0, count, {"lks_world_cast", "hits", "count"});
        result != LKS_OK) {
        return result;
    }
    for (const lks_vec3& end : {from, to}) {
        if (const lks_result result = check_place(*world, end); result != LKS_OK) {
            return result;
        }
    }
    const lks_vec3 way = from_vec3(saturating_subtract(to_vec3(to), to_vec3(from)));
    if (!within(way, LKS_FIXED(4000))) {
        return world->fail(LKS_ERROR_INVALID_ARGUMENT,
                           out_of_range("query's way", way, "m", LKS_FIXED(4000)));
    }
    HitList list(hits, capacity, true);
    cast_ball(*world, *query, to_vec3(from), to_vec3(to), list);
    *count = list.finish();
    return LKS_OK;
}

lks_result lks_world_overlap(const lks_world* world, const lks_query* query, lks_vec3 centre, lks_hit* hits,
                             uint32_t capacity, uint32_t* count) {
    if (const lks_result result =
            check_call(world, query, hits, capacity > 0, count, {"lks_world_overlap", "hits", "count"});
        result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_place(*world, centre); result != LKS_OK) {
        return result;
    }
    HitList list(hits, capacity, false);
    find_within(*world, *query, to_vec3(centre), list);
    *count = list.finish();
    return LKS_OK;
}

lks_result lks_world_closest(const lks_world* world, const lks_query* query, lks_vec3 point, lks_hit* hit,
                             uint32_t* found) {
    if (const lks_result result =
            check_call(world, query, hit, true, found, {"lks_world_closest", "hit", "found"});
        result != LKS_OK) {
        return result;
    }
    if (const lks_result result = check_place(*world, point); result != LKS_OK) {
        return result;
    }
    lks_hit nearest{};
    HitList list(&nearest, 1, true);
    find_within(*world, *query, to_vec3(point), list);
    *found = list.finish() == 0 ? 0u : 1u;
    if (*found != 0) {
        *hit = nearest;
    }
    return LKS_OK;
}

} // extern "C"
