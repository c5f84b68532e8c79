#include "snapshot/convert.h"

#include <algorithm>
#include <memory>
#include <type_traits>

#include "snapshot/alignment.h"
#include "snapshot/fields.h"

namespace talus::formats {
namespace {

constexpr std::size_t kMostMessageBytes = std::size_t{2000}
                                          << 20;  // FlatBuffers hold 2 GiB, offsets included
constexpr const char* kUnits = "SI: m, kg, s, N, J, Pa, rad";

template <class Table>
Table& made(std::unique_ptr<Table>& table) {
    if (!table) table = std::make_unique<Table>();
    return *table;
}

/// Frame to message. Arrays are handed over, not copied.
struct IntoMessage {
    template <class Table>
    Table& into(std::unique_ptr<Table>& table) const {
        return made(table);
    }
    template <class A, class B>
    std::enable_if_t<!std::is_class_v<A>> operator()(A& f, B& m) const {
        m = static_cast<B>(f);
    }
    void operator()(std::string& f, std::string& m) const { m = std::move(f); }
    template <class A>
    void operator()(std::vector<A>& f, std::vector<A>& m) const {
        m = std::move(f);
    }
    template <class A, class B>
    std::enable_if_t<std::is_enum_v<A>> operator()(std::vector<A>& f, std::vector<B>& m) const {
        for (const A value : f) m.push_back(static_cast<B>(value));
    }
    template <class Number, class Table>
    void operator()(VectorList<Number>& f, std::unique_ptr<Table>& m) const {
        made(m).x = std::move(f.x), m->y = std::move(f.y), m->z = std::move(f.z);
    }
    void operator()(QuaternionList& f, std::unique_ptr<fb::QuaternionsT>& m) const {
        made(m).w = std::move(f.w), m->x = std::move(f.x), m->y = std::move(f.y), m->z = std::move(f.z);
    }
};

/// Message to frame.
struct FromMessage {
    template <class Table>
    Table& into(std::unique_ptr<Table>& table) const {
        return made(table);
    }
    template <class A, class B>
    std::enable_if_t<!std::is_class_v<A>> operator()(A& f, B& m) const {
        f = static_cast<A>(m);
    }
    void operator()(std::string& f, std::string& m) const { f = std::move(m); }
    template <class A>
    void operator()(std::vector<A>& f, std::vector<A>& m) const {
        f = std::move(m);
    }
    template <class A, class B>
    std::enable_if_t<std::is_enum_v<A>> operator()(std::vector<A>& f, std::vector<B>& m) const {
        for (const B value : m) f.push_back(static_cast<A>(value));
    }
    template <class Number, class Table>
    void operator()(VectorList<Number>& f, std::unique_ptr<Table>& m) const {
        f.x = std::move(made(m).x), f.y = std::move(m->y), f.z = std::move(m->z);
    }
    void operator()(QuaternionList& f, std::unique_ptr<fb::QuaternionsT>& m) const {
        f.w = std::move(made(m).w), f.x = std::move(m->x), f.y = std::move(m->y), f.z = std::move(m->z);
    }
};

template <class Table, class Message>
mcap::Bytes pack(const Message& message) {
    flatbuffers::FlatBufferBuilder builder(1 << 16);
    builder.Finish(Table::Pack(builder, &message), fb::FrameIdentifier());
    return {builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize()};
}

template <class Table>
constexpr const char* kTypeName = nullptr;
template <>
constexpr const char* kTypeName<fb::Header> = "talus.snapshot.Header";
template <>
constexpr const char* kTypeName<fb::Frame> = "talus.snapshot.Frame";
template <>
constexpr const char* kTypeName<fb::Full> = "talus.snapshot.Full";

/// The message as plain data; false when its bytes are not one.
template <class Table, class Message>
bool unpack(const mcap::Bytes& bytes, Message& message) {
    flatbuffers::Verifier verifier(bytes.data(), bytes.size());
    if (!verifier.VerifyBuffer<Table>(fb::FrameIdentifier()) || !vectorsAreAligned(bytes, kTypeName<Table>))
        return false;
    flatbuffers::GetRoot<Table>(bytes.data())->UnPackTo(&message);
    return true;
}

std::unique_ptr<fb::WaterT> toMessage(const Water& water) {
    auto m = std::make_unique<fb::WaterT>();
    m->level = static_cast<fb::Level>(water.kind);
    for (const LevelPoint& point : water.level) {
        m->level_time.push_back(point.time);
        m->level_value.push_back(point.value);
    }
    m->head.assign(water.head.begin(), water.head.end());
    m->density = water.density;
    m->drains_at_aperture = water.drains_at_aperture;
    m->base = water.base;
    for (const WetFace& wall : water.walls) {
        m->wall_block.push_back(wall.block);
        m->wall_face.push_back(wall.face);
    }
    if (water.pair) m->pair = {water.pair->first, water.pair->second};
    m->field = water.field;
    return m;
}

bool fromMessage(const fb::WaterT& m, Water& water) {
    if (m.level > fb::Level::MAX || m.level_time.size() != m.level_value.size() || m.head.size() != 2 ||
        m.wall_block.size() != m.wall_face.size() || (!m.pair.empty() && m.pair.size() != 2))
        return false;
    water.kind = static_cast<Water::Level>(m.level);
    for (std::size_t k = 0; k < m.level_time.size(); ++k)
        water.level.push_back({m.level_time[k], m.level_value[k]});
    std::copy(m.head.begin(), m.head.end(), water.head.begin());
    water.density = m.density;
    water.drains_at_aperture = m.drains_at_aperture;
    water.base = m.base;
    for (std::size_t k = 0; k < m.wall_block.size(); ++k)
        water.walls.push_back({m.wall_block[k], m.wall_face[k]});
    if (!m.pair.empty()) water.pair = {m.pair[0], m.pair[1]};
    water.field = m.field;
    return true;
}

fb::JointsT toMessage(const std::vector<Joint>& joints) {
    fb::JointsT m;
    for (const Joint& joint : joints) {
        m.name.push_back(joint.name);
        for (std::size_t p = 0; p < kJointPropertyCount; ++p)
            (m.*kJointMessages[p]).push_back(joint.*kJointProperties[p].value);
    }
    return m;
}

bool fromMessage(const fb::JointsT& m, std::vector<Joint>& joints) {
    const std::size_t n = m.name.size();
    for (const auto values : kJointMessages)
        if ((m.*values).size() != n) return false;
    for (std::size_t k = 0; k < n; ++k) {
        Joint& joint = joints.emplace_back();
        joint.name = m.name[k];
        for (std::size_t p = 0; p < kJointPropertyCount; ++p)
            joint.*kJointProperties[p].value = (m.*kJointMessages[p])[k];
    }
    return true;
}

fb::FailureT toMessage(const SnapshotFailure& failure) {
    fb::FailureT m;
    m.analysis = failure.analysis;
    m.load = failure.load;
    m.mode = static_cast<std::uint8_t>(failure.mode);
    for (const FailureMode role : failure.roles) m.role.push_back(static_cast<std::uint8_t>(role));
    return m;
}

bool fromMessage(const fb::FailureT& m, SnapshotFailure& failure) {
    const auto isMode = [](std::uint8_t value) {
        return value <= static_cast<std::uint8_t>(FailureMode::mixed);
    };
    if (!isMode(m.mode) || !std::all_of(m.role.begin(), m.role.end(), isMode)) return false;
    failure.analysis = m.analysis;
    failure.load = m.load;
    failure.mode = static_cast<FailureMode>(m.mode);
    for (const std::uint8_t role : m.role) failure.roles.push_back(static_cast<FailureMode>(role));
    return true;
}

/// Upper bound of a full frame's message [bytes], generously.
std::size_t messageBytes(const FullFrame& frame) {
    return 240 * frame.blocks.inverse_mass.size() + 284 * frame.interfaces.size() +
           16 * frame.interfaces.patch_xi.size() + 81 * frame.points.size() + 400 * frame.wet.block.size() +
           16 * frame.wet.vertex_x.size() + 65536;
}

}  // namespace

mcap::Bytes encode(SnapshotHeader header) {
    fb::HeaderT message;
    message.joints = std::make_unique<fb::JointsT>(toMessage(header.joints));
    for (const Water& water : header.waters) message.waters.push_back(toMessage(water));
    if (header.failure) message.failure = std::make_unique<fb::FailureT>(toMessage(*header.failure));
    eachField(header, message, IntoMessage{});
    return pack<fb::Header>(message);
}

mcap::Bytes encode(LightFrame frame) {
    fb::FrameT message;
    eachField(frame, message, IntoMessage{});
    return pack<fb::Frame>(message);
}

mcap::Bytes encode(FullFrame frame) {
    if (messageBytes(frame) > kMostMessageBytes) return {};
    fb::FullT message;
    eachField(frame, message, IntoMessage{});
    return pack<fb::Full>(message);
}

bool decode(const mcap::Bytes& bytes, SnapshotHeader& header, std::string& why) {
    why = "its header is damaged";
    fb::HeaderT message;
    if (!unpack<fb::Header>(bytes, message)) return false;
    if (message.format > kSnapshotFormat) {
        why = "it has format " + std::to_string(message.format) +
              ", of a later version; this one reads up to " + std::to_string(kSnapshotFormat);
        return false;
    }
    if (!message.joints || !fromMessage(*message.joints, header.joints)) return false;
    for (const auto& water : message.waters)
        if (!fromMessage(*water, header.waters.emplace_back())) return false;
    if (message.failure && !fromMessage(*message.failure, header.failure.emplace())) return false;
    eachField(header, message, FromMessage{});
    return true;
}

bool decode(const mcap::Bytes& bytes, LightFrame& frame) {
    fb::FrameT message;
    if (!unpack<fb::Frame>(bytes, message)) return false;
    eachField(frame, message, FromMessage{});
    return true;
}

bool decode(const mcap::Bytes& bytes, FullFrame& frame) {
    fb::FullT message;
    if (!unpack<fb::Full>(bytes, message)) return false;
    eachField(frame, message, FromMessage{});
    return true;
}

SnapshotHeader headerOf(const Scenario& scenario, RunGeometry geometry, std::string command_line,
                        int frames_per_full) {
    const Model& model = scenario.model;
    SnapshotHeader header;
    header.scenario_path = scenario.path;
    header.scenario_text = scenario.text;
    header.units = kUnits;
    header.build = buildInfo();
    header.command_line = std::move(command_line);
    header.gravity = model.gravity.magnitude;
    header.duration = model.run.duration;
    header.frame_interval = model.run.frame_interval;
    header.frames_per_full = frames_per_full;
    for (const Block& block : model.blocks) {
        header.names.push_back(block.name);
        header.motions.push_back(block.motion);
    }
    header.geometry = std::move(geometry);
    header.joints = model.joints;
    header.waters = model.waters;
    return header;
}

}  // namespace talus::formats
