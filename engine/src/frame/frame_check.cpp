// Whether the arrays of a full frame fit each other. Frames come from files, and files may hold anything.

#include <algorithm>

#include "talus/frame_table.h"

namespace talus {
namespace {

/// Sizes of all arrays of the frame, by what they have entries for.
class Sizes {
 public:
    Sizes(const FullFrame& frame, const FrameCounts& counts) : frame_(frame), counts_(counts) {}

    std::size_t of(Item item) const {
        switch (item) {
            case Item::block:
                return counts_.blocks;
            case Item::interface:
                return frame_.interfaces.size();
            case Item::point:
                return frame_.points.size();
            case Item::patch_corner:
                return frame_.interfaces.patch_xi.size();
            case Item::wet_patch:
                return frame_.wet.block.size();
            case Item::wet_corner:
                return frame_.wet.vertex_x.size();
            case Item::water:
                return counts_.waters;
            case Item::joint:
                return counts_.joints;
            case Item::none:
                break;
        }
        return 0;
    }

 private:
    const FullFrame& frame_;
    FrameCounts counts_;
};

template <class Index>
bool within(const std::vector<Index>& values, std::int64_t low, std::size_t high) {
    return std::all_of(values.begin(), values.end(), [&](Index value) {
        return value >= low && static_cast<std::int64_t>(value) < static_cast<std::int64_t>(high);
    });
}

/// Begins of `items` ranges, each at least `least` long, that cover [0, total).
bool areBegins(const std::vector<std::int64_t>& begins, std::size_t items, std::size_t total,
               std::int64_t least) {
    if (begins.size() != items + 1 || begins.front() != 0) return false;
    if (begins.back() != static_cast<std::int64_t>(total)) return false;
    for (std::size_t k = 0; k < items; ++k)
        if (begins[k] > begins.back() || begins[k + 1] - begins[k] < least) return false;
    return true;
}

struct Fits {
    const Sizes& sizes;

    template <class Field>
    bool operator()(const Field& field, const VectorList<double>& list) const {
        const std::size_t n = sizes.of(field.item);
        return list.x.size() == n && list.y.size() == n && list.z.size() == n;
    }
    template <class Field>
    bool operator()(const Field& field, const QuaternionList& list) const {
        const std::size_t n = sizes.of(field.item);
        return list.w.size() == n && list.x.size() == n && list.y.size() == n && list.z.size() == n;
    }
    template <class Field, class Number>
    bool operator()(const Field& field, const std::vector<Number>& values) const {
        return values.size() == sizes.of(field.item) || (field.traits.may_be_empty && values.empty());
    }
    template <class Field>
    bool operator()(const Field& field, const std::vector<std::int32_t>& indices) const {
        const FrameFieldTraits& traits = field.traits;
        return indices.size() == sizes.of(field.item) &&
               (traits.points_at == Item::none ||
                within(indices, traits.or_none ? -1 : 0, sizes.of(traits.points_at)));
    }
    template <class Field>
    bool operator()(const Field& field, const std::vector<std::int64_t>& begins) const {
        return areBegins(begins, sizes.of(field.item), sizes.of(field.traits.begins_of), field.traits.least);
    }
};

}  // namespace

std::optional<std::string> misfit(const FullFrame& frame, const FrameCounts& counts) {
    const Sizes sizes(frame, counts);
    std::optional<std::string> found;
    eachFrameArray(frame, [&](std::string_view table, const auto& field, const auto& array) {
        if (!found && !Fits{sizes}(field, array)) found = std::string(table) + "." + std::string(field.name);
    });
    return found;
}

}  // namespace talus
