#include "simd/lanes.h"
#include "stages/contact_kernel.h"

namespace talus::stages {
namespace {

using simd::Lanes;

/// Up to four interfaces. A group that is not full repeats its last member in the unused lanes, which are not stored.
template <>
struct Members<Lanes> {
    static constexpr int kWidth = simd::kLanes;
    std::size_t begin;
    int size;
    std::size_t member[simd::kLanes];

    TALUS_KERNEL Members(const InterfaceGroup& group, int)
        : begin(static_cast<std::size_t>(group.begin)), size(group.size) {
        for (int l = 0; l < simd::kLanes; ++l)
            member[l] = begin + static_cast<std::size_t>(l < size ? l : size - 1);
    }

    TALUS_KERNEL Lanes load(const double* values) const {
        if (size == simd::kLanes) return simd::loadLanes(values + begin);
        return simd::lanesOf(values[member[0]], values[member[1]], values[member[2]], values[member[3]]);
    }
    TALUS_KERNEL void store(double* values, Lanes v) const {
        if (size == simd::kLanes) return simd::storeLanes(values + begin, v);
        for (int l = 0; l < size; ++l) values[member[l]] = v.v[l];
    }
    TALUS_KERNEL Lanes gather(const double* values, const std::int32_t* index) const {
        return simd::lanesOf(values[index[member[0]]], values[index[member[1]]], values[index[member[2]]],
                             values[index[member[3]]]);
    }
    template <class Record>
    TALUS_KERNEL Lanes gather(const Record* records, double Record::*field, const std::int32_t* index) const {
        return simd::lanesOf(records[index[member[0]]].*field, records[index[member[1]]].*field,
                             records[index[member[2]]].*field, records[index[member[3]]].*field);
    }
    TALUS_KERNEL simd::LaneMask gatherFlag(const contact::JointLaw* laws, const std::int32_t* index) const {
        simd::LaneMask mask;
        for (int l = 0; l < simd::kLanes; ++l) mask.bits[l] = laws[index[member[l]]].bonded ? -1 : 0;
        return mask;
    }
    TALUS_KERNEL Lanes slot(const double* slots) const { return simd::loadLanes(slots); }
    TALUS_KERNEL void storeSlot(double* slots, Lanes v) const { simd::storeLanes(slots, v); }
};

}  // namespace

void updateContactsAvx2(const ContactView& view, std::size_t begin, std::size_t end) {
    updateGroups<Lanes>(view, begin, end);
}

}  // namespace talus::stages
