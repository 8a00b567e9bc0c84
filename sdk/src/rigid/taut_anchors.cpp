#include "rigid/taut_anchors.h"

#include "collide/saturation.h"
#include "rigid/articulation_parts.h"
#include "rigid/joint.h"

namespace lks {
namespace {

using fixed::Vec3;

std::int64_t distance(const Vec3& a, const Vec3& b) {
    return saturate(fixed::length(saturating_subtract(a, b)));
}

class TautAnchors {
public:
    TautAnchors(RigidScene& scene, std::size_t begin) : scene_(scene), begin_(begin) {}

    bool find() {
        const ArticulatedJoint* first = nullptr;
        bool any = false;
        for (std::size_t i = begin_; i < scene_.tree_joints.size(); ++i) {
            const ArticulatedJoint& part = scene_.tree_joints[i];
            if (part.child_moves || has_soft_points(scene_.joints[part.joint].constants)) {
                continue;
            }
            if (first == nullptr) {
                first = &part;
                mark_way(way_from(part));
            } else if (is_taut(*first, part)) {
                scene_.joints[part.joint].in_tree = false;
                any = true;
            }
        }
        return any;
    }

    void leave_out() {
        Array<ArticulatedJoint>& joints = scene_.tree_joints;
        std::size_t kept = begin_;
        for (std::size_t i = begin_; i < joints.size(); ++i) {
            if (!scene_.joints[joints[i].joint].in_tree) {
                continue;
            }
            joints[kept] = joints[i];
            if (joints[kept].child_moves) {
                scene_.articulated[joints[kept].child].incoming = static_cast<std::uint32_t>(kept);
            }
            ++kept;
        }
        static_cast<void>(joints.resize(kept)); // never grows
    }

private:
    // Along bodies towards the root, World.
    struct Way {
        std::uint32_t body;
        Vec3 point; // where it leaves that, in its frame
        std::int64_t length;
    };

    Way way_from(const ArticulatedJoint& part) const {
        const JointDescription& d = scene_.joints[part.joint].description;
        return {part.parent, part.child_is_a ? d.point_b : d.point_a, 0};
    }

    void go_on(Way& way) const {
        const ArticulatedJoint& part = scene_.tree_joints[scene_.articulated[way.body].incoming];
        const JointDescription& d = scene_.joints[part.joint].description;
        const Vec3& entered = part.child_is_a ? d.point_a : d.point_b;
        way.length = fixed::saturating_add(way.length, distance(way.point, entered));
        way.point = part.child_is_a ? d.point_b : d.point_a;
        way.body = part.parent;
    }

    // From the first anchor to the root.
    void mark_way(Way way) {
        while (true) {
            ArticulatedBody& body = scene_.articulated[way.body];
            body.on_anchor_way = true;
            body.anchor_point = way.point;
            body.anchor_way = way.length;
            if (body.incoming == no_joint) {
                return;
            }
            go_on(way);
        }
    }

    // Of what does not move by itself, at the end of the tick.
    Vec3 place_of(const ArticulatedJoint& part) const {
        const JointDescription& d = scene_.joints[part.joint].description;
        const Vec3& point = part.child_is_a ? d.point_a : d.point_b;
        const Body& body = scene_.bodies[part.child];
        if (body.is_dynamic()) {
            return saturating_add(body.position, fixed::rotate(body.rotation, point)); // it sleeps
        }
        const fixed::Matrix3 turned = fixed::to_matrix(narrow(body.target_orientation));
        return saturating_add(body.target_position, fixed::rotate(turned, point));
    }

    // Whether what is between two anchors is at most as long as they are apart.
    bool is_taut(const ArticulatedJoint& first, const ArticulatedJoint& second) const {
        Way way = way_from(second);
        while (!scene_.articulated[way.body].on_anchor_way) {
            go_on(way);
        }
        const ArticulatedBody& meeting = scene_.articulated[way.body];
        const std::int64_t length = fixed::saturating_add(
            fixed::saturating_add(way.length, meeting.anchor_way), distance(way.point, meeting.anchor_point));
        return distance(place_of(first), place_of(second)) >= length - length / 4096;
    }

    RigidScene& scene_;
    std::size_t begin_;
};

} // namespace

void leave_out_taut_anchors(RigidScene& scene, std::size_t begin) {
    TautAnchors anchors(scene, begin);
    if (anchors.find()) {
        anchors.leave_out();
    }
}

} // namespace lks
