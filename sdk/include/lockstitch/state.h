/* Lockstitch: the state as a value: hash, save, load.
 *
 * The state is everything that can influence the future: tick, gravity, every object with its asset's
 * fingerprint, every collider, body, joint and attachment, what contacts of bodies pushed last, every id's
 * generation. An image of it is one block of bytes, little-endian on every machine, the same bytes for the
 * same state. It is versioned and has a checksum.
 */
#ifndef LOCKSTITCH_STATE_H
#define LOCKSTITCH_STATE_H

#include <lockstitch/object.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A hash (XXH3, 64 bits) over the whole state; equal states have equal hashes on every machine. 0 for null.
 */
LKS_API uint64_t lks_world_hash(const lks_world* world);
/* The same without the origins of objects and the places of colliders and bodies in the world: does not
 * change when everything is moved by the same whole unit, with the targets of pins and of what is kinematic.
 */
LKS_API uint64_t lks_world_local_hash(const lks_world* world);
/* Over one object, without its origin and id. 0 for a stale id. */
LKS_API uint64_t lks_object_hash(const lks_world* world, lks_object_id object);

/* How many bytes lks_world_save writes now. */
LKS_API lks_result lks_world_save_size(const lks_world* world, size_t* size);
/* `memory` is aligned to 8 bytes and has `capacity` bytes. `written` may be null. */
LKS_API lks_result lks_world_save(const lks_world* world, void* memory, size_t capacity, size_t* written);
/* Replaces the whole state. The world must have the image's tick rate, substeps and iterations, and must know
 * the image's assets: it knows every asset that it was given by lks_world_add_object or
 * lks_world_register_asset. Ids saved with the image are valid again afterwards. The clock of
 * lks_world_advance is left alone. `memory` is aligned to 8 bytes. Allocates only what the world lacks:
 * objects of the image, and room for its colliders, bodies, joints, attachments and pins. */
LKS_API lks_result lks_world_load(lks_world* world, const void* memory, size_t size);

/* Makes an asset known, for images that need it. The world holds it until it is destroyed. */
LKS_API lks_result lks_world_register_asset(lks_world* world, const lks_asset* asset);

#ifdef __cplusplus
}
#endif
#endif
