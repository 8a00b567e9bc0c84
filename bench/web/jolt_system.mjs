// What Jolt Physics' package needs before anything can be put into it.
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const packageName = 'jolt-physics';
// Of the package's builds only the one with threads was compiled with SIMD; it gets no workers here.
const flavours = { simd: 'wasm-multithread', plain: 'wasm' };

// Each call makes a module of its own: the memory of the one with threads doesn't grow, and holds a few
// systems.
export async function createJolt(folder, flavour) {
    // Its workers don't keep node alive while they start.
    const alive = setInterval(() => {}, 1000);
    const path = createRequire(`${folder}/`).resolve(`${packageName}/${flavours[flavour]}`);
    const { default: create } = await import(pathToFileURL(path));
    const Jolt = await create();
    clearInterval(alive);
    return Jolt;
}

export function joltVersion(folder) {
    return createRequire(`${folder}/`)(`${packageName}/package.json`).version;
}

// Calls `use` with a new object of Jolt's, which is needed no longer than that.
export function briefly(Jolt, object, use) {
    const result = use(object);
    Jolt.destroy(object);
    return result;
}

// A system with so many layers, of which the pairs listed collide. No workers: one thread, like the others.
export function createSystem(Jolt, layerCount, collidingPairs) {
    const pairs = new Jolt.ObjectLayerPairFilterTable(layerCount);
    collidingPairs.forEach(([a, b]) => pairs.EnableCollision(a, b));
    const layers = new Jolt.BroadPhaseLayerInterfaceTable(layerCount, layerCount);
    for (let i = 0; i < layerCount; ++i) {
        layers.MapObjectToBroadPhaseLayer(i, new Jolt.BroadPhaseLayer(i));
    }
    const settings = new Jolt.JoltSettings();
    settings.mMaxWorkerThreads = 0;
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = layers;
    settings.mObjectVsBroadPhaseLayerFilter =
        new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, layerCount, pairs, layerCount);
    const system = new Jolt.JoltInterface(settings);
    Jolt.destroy(settings);
    briefly(Jolt, new Jolt.Vec3(0, -9.81, 0), (gravity) => system.GetPhysicsSystem().SetGravity(gravity));
    return system;
}
