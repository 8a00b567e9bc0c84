// What gives way: compliance and damping of XPBD (Macklin, Müller, Chentanez 2016, eq. 18 and 26) in the
// rigid reference solver.
#pragma once

namespace reference {

// Of points (m/N and N·s/m) or of turns (rad/(N·m) and N·m·s).
template <typename Scalar>
struct Softness {
    // rate: substeps a second.
    Softness(double compliance, double damping, Scalar rate) {
        const Scalar soft = static_cast<Scalar>(compliance);
        const Scalar stretched = 1 + soft * static_cast<Scalar>(damping) * rate;
        error_share = 1 / stretched;
        motion_share = 1 - error_share;
        added = soft * rate * rate / stretched;
    }

    Scalar error_share;  // 1 / (1 + γ)
    Scalar motion_share; // γ / (1 + γ)
    Scalar added;        // to inverse masses: 1/kg, or 1/(kg·m²)

    bool is_soft() const { return added > 0; }
    // What is left to be corrected. `motion`: of the substep; `push`: the multiplier by now.
    template <typename Value>
    Value left(const Value& error, const Value& motion, const Value& push) const {
        return error * error_share + motion * motion_share + push * added;
    }
};

} // namespace reference
