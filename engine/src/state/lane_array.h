#pragma once
// Records of interfaces, corners and contact points for the kernels: kLanes of them side by side, quantity by
// quantity. A register takes one quantity of several records with one load, and the data of a group are
// contiguous.

#include <cassert>
#include <cstddef>

#include "simd/scalar.h"
#include "state/aligned_doubles.h"

namespace talus {

/// `quantities` doubles in each slot. Slots come in rows of kLanes; quantity q of slot s lies at
/// row * Quantities * kLanes + q * kLanes + lane.
class LaneArray {
 public:
    explicit LaneArray(std::size_t quantities = 1) : quantities_(quantities) {}

    bool empty() const { return values_.empty(); }
    std::size_t slots() const { return values_.size() / quantities_; }
    std::size_t quantities() const { return quantities_; }
    /// Makes more slots; the new ones are zero. \pre slots is a multiple of kLanes, and not less than slots()
    void grow(std::size_t slots) {
        assert(slots % kWidth == 0 && slots >= this->slots());
        values_.grow(slots * quantities_);
    }

    double get(std::size_t slot, std::size_t quantity) const { return values_[place(slot, quantity)]; }
    double& at(std::size_t slot, std::size_t quantity) { return values_[place(slot, quantity)]; }
    void set(std::size_t slot, std::size_t quantity, double value) { values_[place(slot, quantity)] = value; }

    const double* data() const { return values_.data(); }
    double* data() { return values_.data(); }

    friend bool operator==(const LaneArray&, const LaneArray&) = default;

 private:
    static constexpr auto kWidth = static_cast<std::size_t>(simd::kLanes);

    std::size_t place(std::size_t slot, std::size_t quantity) const {
        assert(slot < slots() && quantity < quantities_);
        return slot / kWidth * kWidth * quantities_ + quantity * kWidth + slot % kWidth;
    }

    std::size_t quantities_;
    AlignedDoubles values_;
};

}  // namespace talus
