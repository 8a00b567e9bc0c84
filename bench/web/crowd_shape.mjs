// What every engine is given: { bones, places, walls }, as crowd.h has it, with lengths in metres, masses in
// kilograms and angles in radians. A bone: { parent, hinge, box, radius, halfLength, halfExtents, mass,
// friction, swing, twistMin, twistMax, body, joint }; `body` and `joint` are frames in that of the humanoid.
// A joint's axis is its frame's y. Each body's frame lies in the middle of its one shape.
import { compose, relative } from './rotation.mjs';

// The bodies in the order of all engines: humanoid by humanoid. `place` is where it starts.
export function bodies({ bones, places }) {
    return places.flatMap((place, humanoid) => bones.map((bone, index) =>
        ({ bone, index, humanoid, place: compose(place, bone.body) })));
}

// `a` and `b` are indices of bodies, parent and child; `inA` and `inB` the joint's frame in them.
export function joints({ bones, places }) {
    return places.flatMap((_, humanoid) => bones.flatMap((bone, index) => (bone.parent < 0 ? [] : [{
        bone,
        a: humanoid * bones.length + bone.parent,
        b: humanoid * bones.length + index,
        inA: relative(bones[bone.parent].body, bone.joint),
        inB: relative(bone.body, bone.joint),
    }])));
}

// About the middle, in the body's axes: of a solid box, or of a cylinder along y with its caps.
export function inertia({ box, radius: r, halfLength: h, halfExtents: [x, y, z], mass }) {
    if (box) {
        return [y * y + z * z, x * x + z * z, x * x + y * y].map((squares) => mass * squares / 3);
    }
    const cylinder = mass * h / (h + 2 * r / 3);
    const caps = mass - cylinder;
    const across = cylinder * (r * r / 4 + h * h / 3) + caps * (2 * r * r / 5 + h * h + 3 * h * r / 4);
    return [across, cylinder * r * r / 2 + caps * 2 * r * r / 5, across];
}
