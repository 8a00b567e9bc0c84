// The crowd in Rapier. Its ball joints have no cone: their limits are one about each axis of the frame.
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';
import { bodies, inertia, joints } from './crowd_shape.mjs';
import { multiply } from './rotation.mjs';

const flavours = {
    simd: '@dimforge/rapier3d-simd-compat',
    deterministic: '@dimforge/rapier3d-deterministic-compat',
};

export async function loadRapier(folder, flavour) {
    const packages = createRequire(`${folder}/`);
    const module = await import(pathToFileURL(packages.resolve(flavours[flavour])));
    const Rapier = module.default ?? module;
    await Rapier.init();
    return Rapier;
}

function vector([x, y, z]) {
    return { x, y, z };
}

function quaternion([x, y, z, w]) {
    return { x, y, z, w };
}

// A quarter turn about z: Rapier's joints turn about their frame's x, ours about y.
const axis = [0, 0, Math.SQRT1_2, Math.SQRT1_2];
const friction = 0.5; // the mean of two counts
const firstAngle = 3; // of what its bindings call RawJointAxis: AngX, AngY, AngZ

export class RapierCrowd {
    // `iterations` are the solver's, each of which integrates its part of the step.
    constructor(Rapier, crowd, { steps = 1, iterations = 4 }) {
        this.Rapier = Rapier;
        this.steps = steps;
        this.world = new Rapier.World({ x: 0, y: -9.81, z: 0 });
        this.world.timestep = 1 / 60 / steps;
        this.world.numSolverIterations = iterations;
        const ground = new Rapier.ColliderDesc(new Rapier.HalfSpace({ x: 0, y: 1, z: 0 }));
        this.world.createCollider(ground.setFriction(friction));
        for (const { position, halfExtents } of crowd.walls) {
            this.world.createCollider(
                Rapier.ColliderDesc.cuboid(...halfExtents).setTranslation(...position).setFriction(friction));
        }
        this.bodies = bodies(crowd).map((body) => this.#addBody(body));
        joints(crowd).forEach((joint) => this.#addJoint(joint));
    }

    step() {
        for (let i = 0; i < this.steps; ++i) {
            this.world.step();
        }
    }

    states() {
        const states = new Float64Array(13 * this.bodies.length);
        this.bodies.forEach((body, i) => {
            const [p, q, v, w] = [body.translation(), body.rotation(), body.linvel(), body.angvel()];
            states.set([p.x, p.y, p.z, q.x, q.y, q.z, q.w, v.x, v.y, v.z, w.x, w.y, w.z], 13 * i);
        });
        return states;
    }

    masses() {
        return this.bodies.map((body) => {
            const { x, y, z } = body.principalInertia();
            return { mass: body.mass(), inertia: [x, y, z] };
        });
    }

    awake() {
        return this.bodies.filter((body) => !body.isSleeping()).length;
    }

    destroy() {
        this.world.free();
    }

    #addBody({ bone, place }) {
        const { Rapier } = this;
        const body = this.world.createRigidBody(Rapier.RigidBodyDesc.dynamic().setCanSleep(false)
            .setTranslation(...place.position).setRotation(quaternion(place.rotation)));
        const shape = bone.box
            ? Rapier.ColliderDesc.cuboid(...bone.halfExtents)
            : Rapier.ColliderDesc.capsule(bone.halfLength, bone.radius);
        this.world.createCollider(shape.setFriction(friction).setMassProperties(bone.mass, vector([0, 0, 0]),
            vector(inertia(bone)), quaternion([0, 0, 0, 1])), body);
        return body;
    }

    #addJoint({ bone, a, b, inA, inB }) {
        const { JointData } = this.Rapier;
        const [pointA, pointB] = [inA, inB].map(({ position }) => vector(position));
        const data = bone.hinge
            ? JointData.revolute(pointA, pointB, { x: 1, y: 0, z: 0 })
            : JointData.spherical(pointA, pointB);
        const joint = this.world.createImpulseJoint(data, this.bodies[a], this.bodies[b], true);
        joint.setLocalFrame1(pointA, quaternion(multiply(inA.rotation, axis)));
        joint.setLocalFrame2(pointB, quaternion(multiply(inB.rotation, axis)));
        joint.setContactsEnabled(false);
        const limits = [[bone.twistMin, bone.twistMax]];
        if (!bone.hinge) {
            limits.push([-bone.swing, bone.swing], [-bone.swing, bone.swing]);
        }
        // Its classes give limits to hinges alone, what is beneath them to every axis.
        limits.forEach(([least, greatest], i) =>
            joint.rawSet.jointSetLimits(joint.handle, firstAngle + i, least, greatest));
    }
}
