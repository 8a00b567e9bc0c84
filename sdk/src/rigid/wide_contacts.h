// Contacts side by side: where each begins a substep, what pushes at it do and how far it has parted is its
// own affair, so their points go over lanes where the processor has them (kernels/contact_point_task.h), with
// the same bits as one by one. Pushes are not: each is upon what the others have done.
#pragma once

#include "kernels/contact_point_task.h"
#include "rigid/rigid_scene.h"

namespace lks {

enum class ContactStage { begin, make_rows, measure };

// Takes contacts until lanes are full of their points. What lanes don't have goes one by one: points that are
// looked for in each substep, restitution, and what is far out.
class WideContacts {
public:
    WideContacts(RigidScene& scene, const ContactPointKernels& kernels, ContactStage stage,
                 const MotionRate& rate)
        : scene_(scene), kernels_(kernels), stage_(stage), rate_(rate) {}
    WideContacts(const WideContacts&) = delete;
    WideContacts& operator=(const WideContacts&) = delete;
    ~WideContacts() { finish(); }

    // By its index.
    void add(std::uint32_t index);
    // Does what is left.
    void finish();

private:
    bool is_wide(const Contact& contact) const;
    bool takes(const ContactPoint& point) const { return stage_ != ContactStage::measure || point.active; }
    ContactBodies bodies_of(const Contact& contact) const;
    void do_one(std::uint32_t index);
    void fill_up();
    std::uint32_t run(WideRows& rows) const;
    void take_over(Contact& contact, std::uint32_t first, const WideRows& rows) const;

    RigidScene& scene_;
    const ContactPointKernels& kernels_;
    ContactStage stage_;
    const MotionRate& rate_;
    ContactPointTask task_;
    std::uint32_t point_count_ = 0;
    std::uint32_t contacts_[point_lanes]; // indices
    std::uint32_t first_lanes_[point_lanes + 1];
    std::uint32_t contact_count_ = 0;
};

} // namespace lks
