// The crowd in Jolt Physics: capsules and boxes, hinges, and swing-twist constraints as ball joints.
import { bodies, joints } from './crowd_shape.mjs';
import { briefly, createSystem } from './jolt_system.mjs';
import { rotate } from './rotation.mjs';

const still = 0;
const moving = 1;
// Rounding of boxes' edges, within them: Jolt's own 5 cm is more than a foot is high.
const edgeRadius = 0.02;
const friction = 0.5;

export class JoltCrowd {
    // `steps` are Jolt's collision steps; `velocitySteps` and `positionSteps` its iterations in each of them.
    constructor(Jolt, crowd, { steps = 1, velocitySteps = 10, positionSteps = 2, reversed = false }) {
        this.Jolt = Jolt;
        this.steps = steps;
        this.system = createSystem(Jolt, 2, [[still, moving], [moving, moving]]);
        this.physics = this.system.GetPhysicsSystem();
        this.interface = this.physics.GetBodyInterface();
        const settings = this.physics.GetPhysicsSettings();
        settings.mNumVelocitySteps = velocitySteps;
        settings.mNumPositionSteps = positionSteps;
        this.physics.SetPhysicsSettings(settings);

        this.#addStill(crowd);
        const filter = this.#neighboursDoNotCollide(crowd.bones);
        this.bodies = bodies(crowd).map((body) => this.#addBody(body, filter));
        // Jolt solves them in the order in which it gets them.
        const ordered = joints(crowd);
        this.constraints = (reversed ? ordered.reverse() : ordered).map((joint) => this.#addJoint(joint));
        this.physics.OptimizeBroadPhase();
    }

    step() {
        this.system.Step(1 / 60, this.steps);
    }

    states() {
        const states = new Float64Array(13 * this.bodies.length);
        this.bodies.forEach((body, i) => {
            const put = (at, vector) => {
                states[13 * i + at] = vector.GetX();
                states[13 * i + at + 1] = vector.GetY();
                states[13 * i + at + 2] = vector.GetZ();
            };
            put(0, body.GetPosition());
            const rotation = body.GetRotation();
            put(3, rotation);
            states[13 * i + 6] = rotation.GetW();
            put(7, body.GetLinearVelocity());
            put(10, body.GetAngularVelocity());
        });
        return states;
    }

    // Of each body { mass, inertia }, as the engine has it.
    masses() {
        return this.bodies.map((body) => {
            const motion = body.GetMotionProperties();
            const inverse = motion.GetLocalSpaceInverseInertia().GetDiagonal3();
            return {
                mass: 1 / motion.GetInverseMass(),
                inertia: [1 / inverse.GetX(), 1 / inverse.GetY(), 1 / inverse.GetZ()],
            };
        });
    }

    awake() {
        return this.bodies.filter((body) => body.IsActive()).length;
    }

    destroy() {
        this.Jolt.destroy(this.system);
    }

    #addStill({ walls }) {
        const { Jolt } = this;
        const up = new Jolt.Vec3(0, 1, 0);
        const ground = briefly(Jolt, new Jolt.Plane(up, 0), (plane) => new Jolt.PlaneShape(plane));
        this.#create(ground, { position: [0, 0, 0], rotation: [0, 0, 0, 1] }, false, () => {});
        Jolt.destroy(up);
        for (const { position, halfExtents } of walls) {
            this.#create(this.#box(halfExtents), { position, rotation: [0, 0, 0, 1] }, false, () => {});
        }
    }

    #neighboursDoNotCollide(bones) {
        const filter = new this.Jolt.GroupFilterTable(bones.length);
        bones.forEach((bone, index) => {
            if (bone.parent >= 0) {
                filter.DisableCollision(bone.parent, index);
            }
        });
        return filter;
    }

    #addBody({ bone, index, humanoid, place }, filter) {
        const { Jolt } = this;
        const shape = bone.box
            ? this.#box(bone.halfExtents)
            : new Jolt.CapsuleShape(bone.halfLength, bone.radius);
        return this.#create(shape, place, true, (settings) => {
            settings.mOverrideMassProperties = Jolt.EOverrideMassProperties_CalculateInertia;
            settings.mMassPropertiesOverride.mMass = bone.mass;
            settings.mCollisionGroup.SetGroupFilter(filter);
            settings.mCollisionGroup.SetGroupID(humanoid);
            settings.mCollisionGroup.SetSubGroupID(index);
        });
    }

    #box(halfExtents) {
        return briefly(this.Jolt, new this.Jolt.Vec3(...halfExtents),
            (half) => new this.Jolt.BoxShape(half, edgeRadius));
    }

    #create(shape, { position, rotation }, dynamic, adjust) {
        const { Jolt } = this;
        const where = new Jolt.RVec3(...position);
        const turned = new Jolt.Quat(...rotation);
        const settings = new Jolt.BodyCreationSettings(shape, where, turned,
            dynamic ? Jolt.EMotionType_Dynamic : Jolt.EMotionType_Static, dynamic ? moving : still);
        settings.mFriction = friction; // the geometric mean of two counts, as with ours
        settings.mLinearDamping = 0;
        settings.mAngularDamping = 0;
        settings.mAllowSleeping = false;
        adjust(settings);
        const body = this.interface.CreateBody(settings);
        this.interface.AddBody(body.GetID(),
            dynamic ? Jolt.EActivation_Activate : Jolt.EActivation_DontActivate);
        [where, turned, settings].forEach((object) => Jolt.destroy(object));
        return body;
    }

    #addJoint({ bone, a, b, inA, inB }) {
        const { Jolt } = this;
        const settings =
            bone.hinge ? new Jolt.HingeConstraintSettings() : new Jolt.SwingTwistConstraintSettings();
        const names = bone.hinge
            ? ['mPoint', 'mHingeAxis', 'mNormalAxis']
            : ['mPosition', 'mTwistAxis', 'mPlaneAxis'];
        settings.mSpace = Jolt.EConstraintSpace_LocalToBodyCOM;
        [inA, inB].forEach(({ position, rotation }, i) => {
            const vectors = [position, rotate(rotation, [0, 1, 0]), rotate(rotation, [1, 0, 0])];
            vectors.forEach((vector, part) => {
                const kind = part === 0 ? Jolt.RVec3 : Jolt.Vec3;
                briefly(Jolt, new kind(...vector), (value) => {
                    settings[`${names[part]}${i + 1}`] = value;
                });
            });
        });
        if (bone.hinge) {
            settings.mLimitsMin = bone.twistMin;
            settings.mLimitsMax = bone.twistMax;
        } else {
            settings.mSwingType = Jolt.ESwingType_Cone;
            settings.mNormalHalfConeAngle = bone.swing;
            settings.mPlaneHalfConeAngle = bone.swing;
            settings.mTwistMinAngle = bone.twistMin;
            settings.mTwistMaxAngle = bone.twistMax;
        }
        const constraint = settings.Create(this.bodies[a], this.bodies[b]);
        Jolt.destroy(settings);
        this.physics.AddConstraint(constraint);
        return constraint;
    }
}
