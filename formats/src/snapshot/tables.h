#pragma once
// Arrays of a full frame to tables of the schema and back, name by name. The schema and the table of the
// frame's arrays (talus/frame_table.h) use the same names; a name in only one of them does not compile.
// Fields are written in the schema's order.

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "snapshot_generated.h"
#include "talus/frame_table.h"

namespace talus::formats {

namespace fb = talus::snapshot;

// --- one array
// ------------------------------------------------------------------------------------------------------

template <class Number>
flatbuffers::Offset<flatbuffers::Vector<Number>> packed(flatbuffers::FlatBufferBuilder& builder,
                                                        const std::vector<Number>& values) {
    if (values.empty()) return 0;
    return builder.CreateVector(values);
}
inline auto packed(flatbuffers::FlatBufferBuilder& builder, const std::vector<PointState>& states) {
    std::vector<fb::PointState> values;
    values.reserve(states.size());
    for (const PointState state : states) values.push_back(static_cast<fb::PointState>(state));
    return packed(builder, values);
}
inline auto packed(flatbuffers::FlatBufferBuilder& builder, const VectorList<double>& list) {
    const auto x = packed(builder, list.x), y = packed(builder, list.y), z = packed(builder, list.z);
    return fb::CreateVectors(builder, x, y, z);
}
inline auto packed(flatbuffers::FlatBufferBuilder& builder, const QuaternionList& list) {
    const auto w = packed(builder, list.w), x = packed(builder, list.x), y = packed(builder, list.y),
               z = packed(builder, list.z);
    return fb::CreateQuaternions(builder, w, x, y, z);
}

// What a message does not have stays empty.
template <class Number>
void unpack(const flatbuffers::Vector<Number>* message, std::vector<Number>& values) {
    if (message != nullptr) values.assign(message->begin(), message->end());
}
inline void unpack(const flatbuffers::Vector<fb::PointState>* message, std::vector<PointState>& states) {
    if (message == nullptr) return;
    for (const fb::PointState state : *message) states.push_back(static_cast<PointState>(state));
}
inline void unpack(const fb::Vectors* message, VectorList<double>& list) {
    if (message == nullptr) return;
    unpack(message->x(), list.x), unpack(message->y(), list.y), unpack(message->z(), list.z);
}
inline void unpack(const fb::Quaternions* message, QuaternionList& list) {
    if (message == nullptr) return;
    unpack(message->w(), list.w), unpack(message->x(), list.x);
    unpack(message->y(), list.y), unpack(message->z(), list.z);
}

// --- a table of them
// ------------------------------------------------------------------------------------------------

/// Arrays of a part of a frame by the names of the frame's table.
template <const auto& fields>
struct FieldsOf {
    static constexpr std::size_t count = std::tuple_size_v<std::remove_cvref_t<decltype(fields)>>;

    static consteval std::size_t placeOf(std::string_view name) {
        return std::apply(
            [&](const auto&... field) {
                std::size_t place = 0;
                const bool found = ((field.name == name || (++place, false)) || ...);
                return found ? place : throw "the frame's table does not have this field";
            },
            fields);
    }
    template <std::size_t place>
    static auto& array(auto& owner) {
        return owner.*(std::get<place>(fields).array);
    }
};

/// Calls each(place in Fields, index in the schema's table), as constants, in the schema's order.
template <class Table, class Fields, class Each>
auto withFields(const Each& each) {
    using Traits = typename Table::Traits;
    static_assert(Fields::count == Traits::fields_number,
                  "the schema has not all fields of the frame's table");
    return [&]<std::size_t... index>(std::index_sequence<index...>) {
        return each(std::integer_sequence<std::size_t, Fields::placeOf(Traits::field_names[index])...>{},
                    std::index_sequence<index...>{});
    }
    (std::make_index_sequence<Traits::fields_number>{});
}

template <class Table, class Fields, class Owner>
flatbuffers::Offset<Table> packTable(flatbuffers::FlatBufferBuilder& builder, const Owner& owner) {
    return withFields<Table, Fields>([&]<std::size_t... place>(std::index_sequence<place...>, auto) {
        const std::tuple offsets{
            packed(builder, Fields::template array<place>(owner))...};  // braces: in order
        return std::apply([&](const auto... offset) { return Table::Traits::Create(builder, offset...); },
                          offsets);
    });
}

template <class Table, class Fields, class Owner>
void unpackTable(const Table* message, Owner& owner) {
    if (message == nullptr) return;
    withFields<Table, Fields>([&]<std::size_t... place, std::size_t... index>(std::index_sequence<place...>,
                                                                              std::index_sequence<index...>) {
        (unpack(message->template get_field<index>(), Fields::template array<place>(owner)), ...);
    });
}

}  // namespace talus::formats
