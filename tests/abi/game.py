"""The game of game.c from Python, by ctypes and the shared library alone.

usage: game.py LIBRARY

The structures are written out, and their sizes compared with what the library says of its own: a member
that was added or padded differently is found here.
"""
import ctypes as c
import sys

u32, i32, u64, fixed, real, pointer = c.c_uint32, c.c_int32, c.c_uint64, c.c_int64, c.c_double, c.c_void_p


def struct(name, *members):
    return type(name, (c.Structure,), {"_fields_": list(members)})


Vec3 = struct("Vec3", ("x", fixed), ("y", fixed), ("z", fixed))
Rotation = struct("Rotation", ("x", i32), ("y", i32), ("z", i32), ("w", i32))
Transform = struct("Transform", ("position", Vec3), ("rotation", Rotation))
Id = struct("Id", ("index", u32), ("generation", u32))
Allocator = struct("Allocator", ("allocate", pointer), ("release", pointer), ("user", pointer))
Callback = struct("Callback", ("call", pointer), ("user", pointer))
TaskSystem = struct("TaskSystem", ("user", pointer), ("enqueue", pointer), ("finish", pointer))
Material = struct("Material", ("compliance", real), ("damping", real), ("enabled", u32), ("reserved", u32))
WorldDef = struct(
    "WorldDef", ("struct_size", u32), ("tick_rate_hz", u32), ("substeps", u32), ("iterations", u32),
    ("gravity", Vec3), ("max_ticks_per_advance", u32), ("excess_time", u32), ("keep_previous_positions", u32),
    ("simd", u32), ("worker_count", u32), ("reserved", u32), ("tasks", TaskSystem),
    ("before_tick", Callback), ("allocator", Allocator), ("log", Callback),
    ("error", pointer))
ClothDef = struct(
    "ClothDef", ("struct_size", u32), ("columns", u32), ("rows", u32), ("vertex_count", u32),
    ("triangle_count", u32), ("reserved", u32), ("width", real), ("height", real), ("vertices", pointer),
    ("triangles", pointer), ("mass", real), ("area_density", real), ("vertex_masses", pointer),
    ("stretch", Material), ("shear", Material), ("bend", Material), ("tether_anchors", pointer),
    ("tether_anchor_count", u32), ("tethers_per_vertex", u32), ("particle_radius", real), ("friction", real),
    ("allocator", Allocator), ("error", pointer))
ObjectDef = struct(
    "ObjectDef", ("struct_size", u32), ("record_forces", u32), ("asset", pointer), ("transform", Transform),
    ("velocity", Vec3), ("gravity_factor", fixed), ("linear_damping", fixed))

library = c.CDLL(sys.argv[1])
library.lks_world_tick.restype = library.lks_world_hash.restype = u64
library.lks_result_text.restype = c.c_char_p


def call(name, *arguments):
    result = getattr(library, "lks_" + name)(*arguments)
    if result != 0:
        sys.exit(f"lks_{name}: {library.lks_result_text(result).decode()}")


def default(kind, name):
    function = getattr(library, f"lks_default_{name}_def")
    function.restype = kind
    definition = function()
    if definition.struct_size != c.sizeof(kind):
        sys.exit(f"{kind.__name__} has {c.sizeof(kind)} bytes here and "
                 f"{definition.struct_size} in the library.")
    return definition


def step(world, ticks):
    for _ in range(ticks):
        call("world_step", world)


def print_state(world):
    print(f"tick {library.lks_world_tick(world)} state {library.lks_world_hash(world):016x}")


world, cloth, thing = pointer(), pointer(), Id()
call("world_create", c.byref(default(WorldDef, "world")), c.byref(world))
cloth_def = default(ClothDef, "cloth")
cloth_def.columns, cloth_def.rows = 9, 7
call("asset_create_cloth", c.byref(cloth_def), c.byref(cloth))
object_def = default(ObjectDef, "object")
object_def.asset = cloth
call("world_add_object", world, c.byref(object_def), c.byref(thing))
call("object_pin", world, thing, 0)
call("object_pin", world, thing, 8)
call("object_apply_impulse", world, thing, 40, Vec3(1 << 38, 0, 1 << 39))
step(world, 60)
print_state(world)

size = c.c_size_t()
call("world_save_size", world, c.byref(size))
image = (u64 * ((size.value + 7) // 8))()
call("world_save", world, image, size, None)
step(world, 45)  # a past that the image must undo
call("world_load", world, image, size)
step(world, 30)
print_state(world)
library.lks_world_destroy(world)
library.lks_asset_release(cloth)
