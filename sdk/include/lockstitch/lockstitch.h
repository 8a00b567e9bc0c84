/* Lockstitch: deterministic fixed-point physics for lockstep and rollback games. Includes the whole API. */
#ifndef LOCKSTITCH_LOCKSTITCH_H
#define LOCKSTITCH_LOCKSTITCH_H

#include <lockstitch/asset.h>
#include <lockstitch/attachment.h>
#include <lockstitch/authoring.h>
#include <lockstitch/base.h>
#include <lockstitch/body.h>
#include <lockstitch/collider.h>
#include <lockstitch/event.h>
#include <lockstitch/filter.h>
#include <lockstitch/fixed.h>
#include <lockstitch/joint.h>
#include <lockstitch/object.h>
#include <lockstitch/query.h>
#include <lockstitch/ragdoll.h>
#include <lockstitch/simd.h>
#include <lockstitch/state.h>
#include <lockstitch/tasks.h>
#include <lockstitch/view.h>
#include <lockstitch/world.h>

#endif
