// The cloth in Jolt Physics: a soft body of edges without compliance, alone in its system and never asleep.
import { edges, orders, pinned, vertices } from './cloth_shape.mjs';
import { createSystem } from './jolt_system.mjs';

function createSharedSettings(Jolt, side, order) {
    const shared = new Jolt.SoftBodySharedSettings();
    const fixed = new Set(pinned(side));
    const vertex = new Jolt.SoftBodySharedSettingsVertex();
    vertices(side).forEach((place, i) => {
        const position = new Jolt.Float3(...place);
        vertex.mPosition = position;
        vertex.mInvMass = fixed.has(i) ? 0 : side * side; // a kilogram of cloth
        shared.mVertices.push_back(vertex);
        Jolt.destroy(position);
    });
    Jolt.destroy(vertex);
    for (const [a, b] of orders[order](edges(side))) {
        const edge = new Jolt.SoftBodySharedSettingsEdge(a, b, 0);
        shared.mEdgeConstraints.push_back(edge);
        Jolt.destroy(edge);
    }
    shared.CalculateEdgeLengths();
    shared.Optimize();
    return shared;
}

export class JoltCloth {
    // mNumIterations divides the step: each of Jolt's iterations integrates its part and then projects every
    // constraint once. So they are what XPBD calls substeps; collision steps multiply them.
    constructor(Jolt, side, { iterations, collisionSteps, order }) {
        this.Jolt = Jolt;
        this.collisionSteps = collisionSteps;
        this.system = createSystem(Jolt, 1, []);
        const shared = createSharedSettings(Jolt, side, order);
        this.constraints = shared.mEdgeConstraints.size();

        const origin = new Jolt.RVec3(0, 0, 0);
        const upright = new Jolt.Quat(0, 0, 0, 1);
        const settings = new Jolt.SoftBodyCreationSettings(shared, origin, upright, 0);
        settings.mNumIterations = iterations;
        settings.mLinearDamping = 0;
        settings.mUpdatePosition = false;
        settings.mAllowSleeping = false;
        const bodies = this.system.GetPhysicsSystem().GetBodyInterface();
        this.body = bodies.CreateSoftBody(settings);
        bodies.AddBody(this.body.GetID(), Jolt.EActivation_Activate);
        [origin, upright, settings].forEach((object) => Jolt.destroy(object));

        const motion = Jolt.castObject(this.body.GetMotionProperties(), Jolt.SoftBodyMotionProperties);
        this.vertices = Array.from({ length: side * side }, (_, i) => motion.GetVertex(i).mPosition);
    }

    step() {
        this.system.Step(1 / 60, this.collisionSteps);
    }

    positions() {
        const coordinates = new Float64Array(this.vertices.length * 3);
        this.vertices.forEach((place, i) => {
            coordinates[3 * i] = place.GetX();
            coordinates[3 * i + 1] = place.GetY();
            coordinates[3 * i + 2] = place.GetZ();
        });
        return coordinates;
    }

    destroy() {
        const bodies = this.system.GetPhysicsSystem().GetBodyInterface();
        bodies.RemoveBody(this.body.GetID());
        bodies.DestroyBody(this.body.GetID());
        this.Jolt.destroy(this.system);
    }
}
