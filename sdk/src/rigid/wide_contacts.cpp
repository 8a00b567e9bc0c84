#include "rigid/wide_contacts.h"

#include "rigid/contact_points.h"
#include "rigid/contact_search.h"

namespace lks {
namespace {

// Fewer points are done faster one by one.
constexpr std::uint32_t least_points = 3;

fixed::Vec3 lane_of(const std::int64_t (&lanes)[3][point_lanes], std::uint32_t lane) {
    return {lanes[0][lane], lanes[1][lane], lanes[2][lane]};
}

} // namespace

bool WideContacts::is_wide(const Contact& contact) const {
    return kernels_.begin != nullptr && !contact.every_substep && contact.restitution == 0;
}

ContactBodies WideContacts::bodies_of(const Contact& contact) const {
    return {scene_.bodies[contact.key.body_a], other_body(scene_, contact.key.other)};
}

void WideContacts::add(std::uint32_t index) {
    Contact& contact = scene_.contacts[index];
    if (!is_wide(contact)) {
        do_one(index);
        return;
    }
    if (point_count_ + contact.count > point_lanes) {
        finish();
    }
    contacts_[contact_count_] = index;
    first_lanes_[contact_count_] = point_count_;
    const ContactBodies bodies = bodies_of(contact);
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        if (takes(contact.points[i])) {
            task_.a[point_count_] = &bodies.a;
            task_.b[point_count_] = &bodies.b;
            task_.contacts[point_count_] = &contact;
            task_.points[point_count_] = &contact.points[i];
            ++point_count_;
        }
    }
    ++contact_count_;
}

void WideContacts::do_one(std::uint32_t index) {
    Contact& contact = scene_.contacts[index];
    const ContactBodies bodies = bodies_of(contact);
    switch (stage_) {
    case ContactStage::begin:
        begin_substep(contact, bodies.a, bodies.b, rate_);
        break;
    case ContactStage::make_rows:
        make_rows(contact, bodies);
        break;
    case ContactStage::measure:
        measure(contact, bodies);
        break;
    }
}

void WideContacts::finish() {
    const std::uint32_t count = contact_count_;
    first_lanes_[count] = point_count_;
    WideRows rows;
    std::uint32_t left = ~0u;
    if (point_count_ >= least_points) {
        fill_up();
        left = run(rows);
    }
    contact_count_ = 0;
    point_count_ = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t first = first_lanes_[k];
        const std::uint32_t lanes = ((1u << (first_lanes_[k + 1] - first)) - 1) << first;
        if ((left & lanes) != 0) {
            do_one(contacts_[k]);
        } else {
            take_over(scene_.contacts[contacts_[k]], first, rows);
        }
    }
}

// The lanes that are left over do what the first one does.
void WideContacts::fill_up() {
    task_.count = point_count_;
    for (std::uint32_t i = point_count_; i < point_lanes; ++i) {
        task_.a[i] = task_.a[0];
        task_.b[i] = task_.b[0];
        task_.contacts[i] = task_.contacts[0];
        task_.points[i] = task_.points[0];
    }
}

std::uint32_t WideContacts::run(WideRows& rows) const {
    switch (stage_) {
    case ContactStage::begin:
        return kernels_.begin(task_);
    case ContactStage::make_rows:
        rows.near = 0;
        return kernels_.make_rows(task_, rows);
    case ContactStage::measure:
        return kernels_.measure(task_);
    }
    return ~0u;
}

// What lanes don't do.
void WideContacts::take_over(Contact& contact, std::uint32_t first, const WideRows& rows) const {
    const ContactBodies bodies = bodies_of(contact);
    if (stage_ == ContactStage::measure) {
        measure_middle(contact);
        return;
    }
    if (stage_ == ContactStage::begin) {
        const bool jointed = bodies.a.jointed || bodies.b.jointed;
        for (std::uint32_t i = 0; i < contact.count; ++i) {
            begin_point(contact.points[i], jointed, rate_);
        }
        return;
    }
    Levers sum{{0, 0, 0}, {0, 0, 0}};
    contact.active_count = 0;
    for (std::uint32_t i = 0; i < contact.count; ++i) {
        const std::uint32_t lane = first + i;
        ContactPoint& point = contact.points[i];
        if (activate(contact, point, (rows.near >> lane & 1) != 0)) {
            sum = {sum.a + lane_of(rows.lever_a, lane), sum.b + lane_of(rows.lever_b, lane)};
        }
    }
    make_middle(contact, bodies, sum);
}

} // namespace lks
