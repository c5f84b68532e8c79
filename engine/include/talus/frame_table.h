#pragma once
// The one description of a full frame's arrays: name in snapshot files, items that have entries, unit, and
// target of an index. Checks of frames from files go through it (misfit), and so does the codec; that the
// schema agrees with it is tested (tests/formats/snapshot/frame_table_test.cpp).

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "talus/frame.h"

namespace talus {

/// What arrays have entries for.
enum class Item : std::uint8_t {
    block,
    interface,
    point,
    patch_corner,
    wet_patch,
    wet_corner,
    water,
    joint,
    none
};

struct FrameFieldTraits {
    Item points_at = Item::none;  ///< indices, all of them there
    bool or_none = false;         ///< ... or -1
    Item begins_of = Item::none;  ///< begins of ranges of these, with one entry more than items
    int least = 0;                ///< entries in each of those ranges
    bool may_be_empty = false;
    bool any_number = false;  ///< may hold nan: it says that nothing was computed yet
};

template <class Owner, class Array>
struct FrameField {
    std::string_view name;  ///< in formats/snapshot.fbs
    Array Owner::*array;
    Item item;
    std::string_view unit;  ///< "" for numbers without
    FrameFieldTraits traits;
};

template <class Owner, class Array>
constexpr FrameField<Owner, Array> frameField(std::string_view name, Array Owner::*array, Item item,
                                              std::string_view unit = "", FrameFieldTraits traits = {}) {
    return {name, array, item, unit, traits};
}

constexpr FrameFieldTraits indexInto(Item item) { return {.points_at = item}; }
constexpr FrameFieldTraits beginsOf(Item item, int least) { return {.begins_of = item, .least = least}; }

inline constexpr auto kBlockFields =
    std::make_tuple(frameField("position", &FrameBlocks::position, Item::block, "m"),
                    frameField("orientation", &FrameBlocks::orientation, Item::block),
                    frameField("velocity", &FrameBlocks::velocity, Item::block, "m/s"),
                    frameField("angular_momentum", &FrameBlocks::angular_momentum, Item::block, "kg m^2/s"),
                    frameField("force", &FrameBlocks::force, Item::block, "N"),
                    frameField("torque", &FrameBlocks::torque, Item::block, "N m"),
                    frameField("inverse_mass", &FrameBlocks::inverse_mass, Item::block, "1/kg"),
                    frameField("inverse_inertia", &FrameBlocks::inverse_inertia, Item::block, "1/(kg m^2)"));

inline constexpr auto kInterfaceFields = std::make_tuple(
    frameField("block_a", &FrameInterfaces::block_a, Item::interface, "", indexInto(Item::block)),
    frameField("block_b", &FrameInterfaces::block_b, Item::interface, "", indexInto(Item::block)),
    frameField("face_a", &FrameInterfaces::face_a, Item::interface),
    frameField("face_b", &FrameInterfaces::face_b, Item::interface),
    frameField("joint", &FrameInterfaces::joint, Item::interface, "", indexInto(Item::joint)),
    frameField("area", &FrameInterfaces::area, Item::interface, "m^2"),
    frameField("origin_a", &FrameInterfaces::origin_a, Item::interface, "m"),
    frameField("e1_a", &FrameInterfaces::e1_a, Item::interface),
    frameField("e2_a", &FrameInterfaces::e2_a, Item::interface),
    frameField("origin_b", &FrameInterfaces::origin_b, Item::interface, "m"),
    frameField("e1_b", &FrameInterfaces::e1_b, Item::interface),
    frameField("e2_b", &FrameInterfaces::e2_b, Item::interface),
    frameField("reference_gap", &FrameInterfaces::reference_gap, Item::interface, "m"),
    frameField("point_begin", &FrameInterfaces::point_begin, Item::interface, "", beginsOf(Item::point, 1)),
    frameField("patch_begin", &FrameInterfaces::patch_begin, Item::interface, "",
               beginsOf(Item::patch_corner, 1)),
    frameField("patch_xi", &FrameInterfaces::patch_xi, Item::patch_corner, "m"),
    frameField("patch_eta", &FrameInterfaces::patch_eta, Item::patch_corner, "m"),
    frameField("force", &FrameInterfaces::force, Item::interface, "N"),
    frameField("moment_a", &FrameInterfaces::moment_a, Item::interface, "N m"),
    frameField("moment_b", &FrameInterfaces::moment_b, Item::interface, "N m"));

inline constexpr auto kPointFields =
    std::make_tuple(frameField("xi", &FramePoints::xi, Item::point, "m"),
                    frameField("eta", &FramePoints::eta, Item::point, "m"),
                    frameField("area", &FramePoints::area, Item::point, "m^2"),
                    frameField("offset_1", &FramePoints::offset_1, Item::point, "m"),
                    frameField("offset_2", &FramePoints::offset_2, Item::point, "m"),
                    frameField("bond", &FramePoints::bond, Item::point),
                    frameField("dilation", &FramePoints::dilation, Item::point, "m", {.may_be_empty = true}),
                    frameField("normal", &FramePoints::normal, Item::point, "N"),
                    frameField("shear_1", &FramePoints::shear_1, Item::point, "N"),
                    frameField("shear_2", &FramePoints::shear_2, Item::point, "N"),
                    frameField("water", &FramePoints::water, Item::point, "N"),
                    frameField("state", &FramePoints::state, Item::point),
                    frameField("mobilised", &FramePoints::mobilised, Item::point));

inline constexpr auto kWetFields = std::make_tuple(
    frameField("block", &FrameWetPatches::block, Item::wet_patch, "", indexInto(Item::block)),
    frameField("water", &FrameWetPatches::water, Item::wet_patch, "", indexInto(Item::water)),
    frameField("water_begin", &FrameWetPatches::water_begin, Item::water, "", beginsOf(Item::wet_patch, 0)),
    frameField("interface", &FrameWetPatches::interface, Item::wet_patch, "",
               {.points_at = Item::interface, .or_none = true}),
    frameField("origin", &FrameWetPatches::origin, Item::wet_patch, "m"),
    frameField("e1", &FrameWetPatches::e1, Item::wet_patch),
    frameField("e2", &FrameWetPatches::e2, Item::wet_patch),
    frameField("vertex_begin", &FrameWetPatches::vertex_begin, Item::wet_patch, "",
               beginsOf(Item::wet_corner, 3)),
    frameField("vertex_x", &FrameWetPatches::vertex_x, Item::wet_corner, "m"),
    frameField("vertex_y", &FrameWetPatches::vertex_y, Item::wet_corner, "m"),
    frameField("head", &FrameWetPatches::head, Item::wet_patch, "m"),
    frameField("force", &FrameWetPatches::force, Item::wet_patch, "N"),
    frameField("moment", &FrameWetPatches::moment, Item::wet_patch, "N m"),
    frameField("computed_position", &FrameWetPatches::computed_position, Item::wet_patch, "m"),
    frameField("computed_orientation", &FrameWetPatches::computed_orientation, Item::wet_patch));

inline constexpr auto kWaterFields =
    std::make_tuple(frameField("p0", &FrameWaters::p0, Item::water, "Pa", {.any_number = true}),
                    frameField("gradient", &FrameWaters::gradient, Item::water, "Pa/m", {.any_number = true}),
                    frameField("tilt", &FrameWaters::tilt, Item::water, "rad", {.any_number = true}),
                    frameField("share", &FrameWaters::share, Item::water, "", {.any_number = true}),
                    frameField("level", &FrameWaters::level, Item::water, "m", {.any_number = true}),
                    frameField("load_drained", &FrameWaters::load_drained, Item::water),
                    frameField("drained", &FrameWaters::drained, Item::water));

/// Calls visit(table, field, array) for every array of a frame; `table` is the field of Full that holds it.
template <class Frame, class Visit>
void eachFrameArray(Frame& frame, const Visit& visit) {
    const auto all = [&](std::string_view table, const auto& fields, auto& owner) {
        std::apply([&](const auto&... field) { (visit(table, field, owner.*(field.array)), ...); }, fields);
    };
    all("blocks", kBlockFields, frame.blocks);
    all("interfaces", kInterfaceFields, frame.interfaces);
    all("points", kPointFields, frame.points);
    all("wet", kWetFields, frame.wet);
    all("waters", kWaterFields, frame.waters);
    using Values = std::vector<double>;
    for (auto& parameter : frame.laws.parameters)
        visit("laws", FrameField<FrameLaws, Values>{parameter.name, nullptr, Item::joint, "", {}},
              parameter.values);
    visit("laws", frameField("bonded", &FrameLaws::bonded, Item::joint), frame.laws.bonded);
    visit("search", frameField("position", &FullFrame::search_position, Item::block, "m"),
          frame.search_position);
    visit("search", frameField("orientation", &FullFrame::search_orientation, Item::block),
          frame.search_orientation);
}

/// What a frame has to go with.
struct FrameCounts {
    std::size_t blocks = 0, waters = 0, joints = 0;
};

/// The first array ("points.bond") whose size, ranges or indices do not fit those of the frame's others and
/// the counts; nothing when all do. Readers index frames without looking again.
std::optional<std::string> misfit(const FullFrame& frame, const FrameCounts& counts);

}  // namespace talus
