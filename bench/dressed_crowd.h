// A crowd with capes on its shoulders and ropes from hand to hand.
#pragma once

#include <memory>

#include "our_crowd.h"

namespace lks_bench {

// How cloth and ropes go with the bodies.
enum class Dress {
    coupled,  // attached, and they hit each other
    attached, // they pass through the bodies
    beside,   // pinned where they would be attached: nothing to do with the bodies, which move as if alone
    none      // no cloth and no ropes
};

class DressedCrowd {
public:
    DressedCrowd(Dress dress, std::uint32_t substeps, std::uint32_t workers);
    ~DressedCrowd();
    DressedCrowd(const DressedCrowd&) = delete;
    DressedCrowd& operator=(const DressedCrowd&) = delete;

    OurCrowd& crowd() { return *crowd_; }
    // How far each attachment is apart, metres.
    std::vector<double> attachment_errors() const;
    std::size_t particles() const { return particles_; }

private:
    void add_cape(std::size_t humanoid);
    void add_rope(std::size_t left, std::size_t right);
    lks_object_id add_object(const lks_asset* asset, const lks_vec3& position);
    void hold(lks_object_id object, std::uint32_t vertex, std::size_t humanoid, std::uint32_t bone,
              const lks_vec3& point);

    CrowdRows shape_;
    Dress dress_;
    std::unique_ptr<OurCrowd> crowd_;
    lks_asset* cape_ = nullptr;
    lks_asset* rope_ = nullptr;
    std::vector<lks_attachment_id> attachments_;
    std::size_t particles_ = 0;
};

} // namespace lks_bench
