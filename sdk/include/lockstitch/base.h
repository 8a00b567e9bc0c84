/* Lockstitch: linkage, versions, result codes, and what the caller provides (memory, log).
 *
 * Thread rule for the whole library: a world may be used by one thread at a time, but for queries, of which
 * lockstitch/query.h says more; different worlds are independent of each other. Assets are immutable, and any
 * number of threads may use them at once.
 */
#ifndef LOCKSTITCH_BASE_H
#define LOCKSTITCH_BASE_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(LKS_SHARED)
#if defined(LKS_BUILDING)
#define LKS_API __declspec(dllexport)
#else
#define LKS_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define LKS_API __attribute__((visibility("default")))
#else
#define LKS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define LKS_VERSION_MAJOR 0
#define LKS_VERSION_MINOR 1
#define LKS_VERSION_PATCH 0

/* Raised whenever the same inputs would give other bits than before. Golden states and saved images
 * name it, and an image of another solver version is refused. */
#define LKS_SOLVER_VERSION 45

/* What a call says. Every call that fails leaves everything as it was. */
typedef enum lks_result {
    LKS_OK = 0,
    LKS_ERROR_NULL_ARGUMENT = 1,    /* a pointer that must not be null is */
    LKS_ERROR_INVALID_ARGUMENT = 2, /* a value is out of its documented range; the message names it */
    LKS_ERROR_STRUCT_SIZE = 3,      /* a definition was not made by its lks_default_*_def() */
    LKS_ERROR_STALE_ID = 4,         /* what the id names was removed, or never existed */
    LKS_ERROR_OUT_OF_MEMORY = 5,    /* the allocator returned null */
    LKS_ERROR_BUFFER_TOO_SMALL = 6, /* the message names the size that is needed */
    LKS_ERROR_MISALIGNED = 7,       /* a buffer does not have the documented alignment */
    LKS_ERROR_CORRUPT_IMAGE = 8,    /* truncated, or its checksum or a value in it is wrong */
    LKS_ERROR_FOREIGN_IMAGE = 9,    /* another version, other world settings, or an unknown asset */
    LKS_ERROR_LIMIT = 10,           /* a documented limit (how many objects, bodies, bones ...) is reached */
    LKS_ERROR_UNSUPPORTED = 11      /* the object has not got what was asked for; the message says what */
} lks_result;

/* One word for a result, e.g. "stale id". Never null. */
LKS_API const char* lks_result_text(lks_result result);

#define LKS_MESSAGE_CAPACITY 256

/* The sentence that belongs to a failed call; `message` is always terminated. Of a call on a world it is the
 * world's last error, of one that creates a world or an asset it goes to the definition's `error`. None
 * comes of lks_asset_triangles, lks_asset_constraint, lks_humanoid, lks_spider and lockstitch/authoring.h,
 * nor where it has no place: the world or the definition is null, or the one with `error` has a wrong size.
 */
typedef struct lks_error {
    int32_t result; /* an lks_result */
    char message[LKS_MESSAGE_CAPACITY];
} lks_error;

/* The caller's memory. Both functions null: the C library's. `allocate` gets a size > 0 and a power of
 * two ≥ 8 as alignment, and returns null when there is no memory; `release` gets back what it returned,
 * with the same size. Called only by calls that create, destroy, add, remove, pin, load, register or release,
 * and by lks_world_record_events, never by a step. A world's own threads take their memory from the C library
 * instead. An asset keeps a copy of its allocator until its last user lets go of it. */
typedef struct lks_allocator {
    void* (*allocate)(void* user, size_t size, size_t alignment);
    void (*release)(void* user, void* memory, size_t size);
    void* user;
} lks_allocator;

typedef enum lks_log_level { LKS_LOG_INFO = 0, LKS_LOG_WARNING = 1, LKS_LOG_ERROR = 2 } lks_log_level;

/* Receives the sentence of each failed call on its world, as LKS_LOG_ERROR: nothing is sent at the other
 * levels yet. Those of lks_world_create and of assets go to the definition's `error` alone. Must not call
 * back into the same world. */
typedef struct lks_log {
    void (*write)(void* user, lks_log_level level, const char* message);
    void* user;
} lks_log;

/* The version of the library that was linked, as major * 10000 + minor * 100 + patch; compare it with
 * the LKS_VERSION_* of the headers. */
LKS_API uint32_t lks_version(void);
/* LKS_SOLVER_VERSION of the library that was linked. */
LKS_API uint32_t lks_solver_version(void);

#ifdef __cplusplus
}
#endif
#endif
