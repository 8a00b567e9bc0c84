#include "rigid/figure_contacts.h"

#include "rigid/contact_search.h"

namespace lks {

ContactBodies FigureContacts::bodies_of(const Contact& contact) const {
    return {scene_.bodies[contact.key.body_a], other_body(scene_, contact.key.other)};
}

WideContacts FigureContacts::side_by_side(ContactStage stage) const {
    return WideContacts(scene_, world_.kernels->contact_points, stage, rate_);
}

void FigureContacts::measure(std::uint32_t contact) const {
    if (scene_.acts(contact)) {
        lks::measure(scene_.contacts[contact], bodies_of(scene_.contacts[contact]));
    }
}

Move& FigureContacts::move_of(std::uint32_t other) const {
    return scene_.contact_moves[other >= other_is_collider ? scene_.bodies.size() : other];
}

void FigureContacts::project(std::uint32_t index, bool back) const {
    if (scene_.acts(index)) {
        Contact& contact = scene_.contacts[index];
        lks::project(contact, {move_of(contact.key.body_a), move_of(contact.key.other)}, back, rate_);
    }
}

void FigureContacts::apply_moves(const FigureRange& figure) const {
    for_each_part(scene_, figure, Part::body, [this](std::uint32_t i) {
        apply(scene_.bodies[i], scene_.contact_moves[i]);
        scene_.contact_moves[i] = {};
    });
}

void FigureContacts::measure(const FigureBundle& bundle) const {
    WideContacts wide = side_by_side(ContactStage::measure);
    for (std::uint32_t i = bundle.first; i < bundle.end; ++i) {
        for_each_acting(scene_, scene_.figure_ranges[i], Part::contact,
                        [&](std::uint32_t contact) { wide.add(contact); });
    }
}

void FigureContacts::measure(const FigureRange& figure) const {
    for_each_part(scene_, figure, Part::contact, [this](std::uint32_t i) { measure(i); });
}

void FigureContacts::project(const FigureRange& figure) const {
    for_each_part(scene_, figure, Part::contact, [this](std::uint32_t i) { project(i, false); });
}

void FigureContacts::project_back(const FigureRange& figure) const {
    for_each_part_back(scene_, figure, Part::contact, [this](std::uint32_t i) { project(i, true); });
    apply_moves(figure);
}

// Each body those that are its figure's: the other one of a shared contact may be at work.
void FigureContacts::push_again(const FigureRange& figure) const {
    for_each_acting(scene_, figure, Part::contact, [this](std::uint32_t i) {
        Contact& contact = scene_.contacts[i];
        if (contact.of_foot) {
            return; // carry_feet
        }
        const ContactBodies bodies = bodies_of(contact);
        if (bodies.a.is_awake()) {
            carry_on(contact, true, move_of(contact.key.body_a));
        }
        if (bodies.b.is_awake()) {
            carry_on(contact, false, move_of(contact.key.other));
        }
    });
    const std::uint32_t own = name_of(scene_, figure);
    for_each_acting(scene_, figure, Part::shared_contact, [&](std::uint32_t i) {
        Contact& contact = scene_.contacts[i];
        const bool is_a = scene_.figures[contact.key.body_a] == own;
        carry_on(contact, is_a, move_of(is_a ? contact.key.body_a : contact.key.other));
    });
    apply_moves(figure);
}

} // namespace lks
