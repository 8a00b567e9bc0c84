// What bounces: impacts at the beginning of a substep, and the speeds that they give back at its end.
#pragma once

#include "rigid/figure_contacts.h"

namespace lks {

class Impacts {
public:
    // Once the contacts of the tick are known.
    Impacts(lks_world& world, const FigureContacts& contacts);

    void strike_all() const;
    // Before the end of a substep changes them.
    void keep_predicted_speeds() const;
    void restore_speeds() const;

private:
    ContactSpeeds predicted_speeds(const Contact& contact) const;

    lks_world& world_;
    RigidScene& scene_;
    const FigureContacts& contacts_;
    MotionRate rate_;
    bool any_ = false; // else nothing bounces in this tick, and nothing is to be done
};

} // namespace lks
