#include "rigid/impacts.h"

namespace lks {

Impacts::Impacts(lks_world& world, const FigureContacts& contacts)
    : world_(world), scene_(world.rigid), contacts_(contacts), rate_(world.rate) {
    for (const Contact& contact : scene_.contacts) {
        any_ = any_ || contact.restitution != 0;
    }
}

// An impact may cause the next one: forward and back, until nothing strikes any more. What several strike at
// once takes them together, behind the sweeps.
void Impacts::strike_all() const {
    if (!any_) {
        return;
    }
    for (Body& body : scene_.bodies) {
        body.impacts = 0;
    }
    for (const Contact& contact : scene_.contacts) {
        const ContactBodies bodies = contacts_.bodies_of(contact);
        if (is_about_to_strike(contact, bodies, rate_)) {
            ++bodies.a.impacts;
            ++bodies.b.impacts;
        }
    }
    const auto takes_one = [](const Body& body) { return !body.is_awake() || body.impacts < 2; };
    constexpr int most_passes = 8;
    bool again = true;
    for (int pass = 0; pass < most_passes && again; ++pass) {
        again = false;
        for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
            Contact& contact = scene_.contacts[pass % 2 == 0 ? i : scene_.contacts.size() - 1 - i];
            const ContactBodies bodies = contacts_.bodies_of(contact);
            if (takes_one(bodies.a) && takes_one(bodies.b)) {
                again = strike(contact, bodies, rate_) || again;
            }
        }
    }
}

void Impacts::keep_predicted_speeds() const {
    if (!any_) {
        return;
    }
    scene_.predicted_speeds.clear();
    for (const Body& body : scene_.bodies) {
        scene_.predicted_speeds.push_reserved(body.speeds());
    }
}

// All contacts together: what comes down on several at once, on four feet or across a seam, would spin if
// they gave back its speed one after the other.
void Impacts::restore_speeds() const {
    if (!any_) {
        return;
    }
    const auto for_each_struck = [this](const auto& use) {
        for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
            Contact& contact = scene_.contacts[i];
            if (scene_.acts(i) && contact.struck_count != 0) {
                use(contact, contacts_.bodies_of(contact));
            }
        }
    };
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
        if (scene_.acts(i)) {
            Contact& contact = scene_.contacts[i];
            begin_impact(contact, contacts_.bodies_of(contact), predicted_speeds(contact));
        }
    }
    for_each_struck([](Contact& contact, const ContactBodies& bodies) { give_alike(contact, bodies); });
    constexpr int most_rounds = 32;
    bool more = true;
    for (int round = 0; round < most_rounds && more; ++round) {
        more = false;
        for_each_struck([&](Contact& contact, const ContactBodies& bodies) {
            more = give_each(contact, bodies, rate_) || more;
        });
    }
    for_each_struck([](Contact& contact, const ContactBodies& bodies) { rub_by_impact(contact, bodies); });
    for (Body& body : scene_.bodies) {
        if (body.is_awake()) {
            limit_speeds(body, rate_, world_.counters.speed_clamps);
        }
    }
}

// The other one's, too: what is no body, or does not move by pushes, has the same before and behind them.
ContactSpeeds Impacts::predicted_speeds(const Contact& contact) const {
    const ContactBodies bodies = contacts_.bodies_of(contact);
    const auto of = [this](const Body& body, std::uint32_t index) {
        return body.is_awake() ? scene_.predicted_speeds[index] : body.speeds();
    };
    return {of(bodies.a, contact.key.body_a), of(bodies.b, contact.key.other)};
}

} // namespace lks
