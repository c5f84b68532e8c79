#include "snapshot/convert.h"

#include <algorithm>
#include <memory>
#include <type_traits>

#include "snapshot/alignment.h"
#include "snapshot/fields.h"
#include "snapshot/header_parts.h"
#include "snapshot/joint_numbers.h"
#include "snapshot/tables.h"

namespace talus::formats {
namespace {

constexpr std::size_t kMostMessageBytes = std::size_t{2000}
                                          << 20;           // FlatBuffers hold 2 GiB, offsets included
constexpr std::size_t kFirstBytes = std::size_t{1} << 16;  // grows
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
    void laws(FrameLaws& f, fb::LawsT& m) const {
        for (FrameLaws::Parameter& parameter : f.parameters)
            if (auto* column = columnOf(kLawColumns, parameter.name, m))
                *column = std::move(parameter.values);
            else
                m.parameter.push_back(jointNumbers(parameter.name, std::move(parameter.values)));
        m.bonded = std::move(f.bonded);
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
    void laws(FrameLaws& f, fb::LawsT& m) const {
        f.parameters.clear();
        for (const LawColumn& column : kLawColumns) f.named(column.name) = std::move(m.*column.values);
        for (const auto& numbers : m.parameter) f.named(numbers->name) = std::move(numbers->values);
        f.bonded = std::move(m.bonded);
    }
};

mcap::Bytes bytesOf(const flatbuffers::FlatBufferBuilder& builder) {
    return {builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize()};
}

template <class Table, class Message>
mcap::Bytes pack(const Message& message) {
    flatbuffers::FlatBufferBuilder builder(kFirstBytes);
    builder.Finish(Table::Pack(builder, &message), fb::FrameIdentifier());
    return bytesOf(builder);
}

template <class Table>
constexpr const char* kTypeName = nullptr;
template <>
constexpr const char* kTypeName<fb::Header> = "talus.snapshot.Header";
template <>
constexpr const char* kTypeName<fb::Frame> = "talus.snapshot.Frame";
template <>
constexpr const char* kTypeName<fb::Full> = "talus.snapshot.Full";

/// The message in place; nullptr when its bytes are not one.
template <class Table>
const Table* verified(const mcap::Bytes& bytes) {
    flatbuffers::Verifier verifier(bytes.data(), bytes.size());
    if (!verifier.VerifyBuffer<Table>(fb::FrameIdentifier()) || !vectorsAreAligned(bytes, kTypeName<Table>))
        return nullptr;
    return flatbuffers::GetRoot<Table>(bytes.data());
}

/// The message as plain data; false when its bytes are not one.
template <class Table, class Message>
bool readMessage(const mcap::Bytes& bytes, Message& message) {
    const Table* table = verified<Table>(bytes);
    if (table != nullptr) table->UnPackTo(&message);
    return table != nullptr;
}

template <class Table, class Part>
auto packPart(flatbuffers::FlatBufferBuilder& builder, Part& part) {
    typename Table::NativeTableType message;
    eachField(part, message, IntoMessage{});
    return Table::Pack(builder, &message);
}

template <class Table, class Part>
void unpackPart(const Table* table, Part& part) {
    typename Table::NativeTableType message;
    if (table != nullptr) table->UnPackTo(&message);
    eachField(part, message, FromMessage{});
}

/// Nothing where forces remember nothing.
flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<fb::ForceArray>>> packMemory(
    flatbuffers::FlatBufferBuilder& builder, const std::vector<ForceArray>& memory) {
    if (memory.empty()) return 0;
    std::vector<flatbuffers::Offset<fb::ForceArray>> arrays;
    for (const ForceArray& array : memory) {
        const auto name = builder.CreateString(array.name);
        arrays.push_back(fb::CreateForceArray(builder, name, packed(builder, array.values)));
    }
    return builder.CreateVector(arrays);
}

/// Children are written in the schema's order, as flatc's own code does.
flatbuffers::Offset<fb::Full> packFull(flatbuffers::FlatBufferBuilder& builder, FullFrame& f) {
    const auto blocks = packTable<fb::Blocks, FieldsOf<kBlockFields>>(builder, f.blocks);
    const auto interfaces = packTable<fb::Interfaces, FieldsOf<kInterfaceFields>>(builder, f.interfaces);
    const auto points = packTable<fb::Points, FieldsOf<kPointFields>>(builder, f.points);
    const auto wet = packTable<fb::WetPatches, FieldsOf<kWetFields>>(builder, f.wet);
    const auto waters = packTable<fb::WaterLoads, FieldsOf<kWaterFields>>(builder, f.waters);
    const auto laws = packPart<fb::Laws>(builder, f.laws);
    const auto loads = packPart<fb::Loads>(builder, f.loads);
    const auto position = packed(builder, f.search_position);
    const auto orientation = packed(builder, f.search_orientation);
    const auto search = fb::CreateSearch(builder, position, orientation, f.search_margin);
    const auto progress = packPart<fb::Progress>(builder, f.progress);
    flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<flatbuffers::String>>> warnings = 0;
    if (!f.warnings.empty()) warnings = builder.CreateVectorOfStrings(f.warnings);
    const auto memory = packMemory(builder, f.memory);
    return fb::CreateFull(builder, f.time, f.step, f.state_hash, blocks, interfaces, points, wet, waters,
                          laws, loads, search, progress, f.shear_lost, warnings, f.origin_x, f.origin_y,
                          f.origin_z, memory);
}

void unpackFull(const fb::Full& m, FullFrame& f) {
    f.time = m.time(), f.step = m.step(), f.state_hash = m.state_hash();
    unpackTable<fb::Blocks, FieldsOf<kBlockFields>>(m.blocks(), f.blocks);
    unpackTable<fb::Interfaces, FieldsOf<kInterfaceFields>>(m.interfaces(), f.interfaces);
    unpackTable<fb::Points, FieldsOf<kPointFields>>(m.points(), f.points);
    unpackTable<fb::WetPatches, FieldsOf<kWetFields>>(m.wet(), f.wet);
    unpackTable<fb::WaterLoads, FieldsOf<kWaterFields>>(m.waters(), f.waters);
    unpackPart(m.laws(), f.laws);
    unpackPart(m.loads(), f.loads);
    if (const fb::Search* search = m.search()) {
        unpack(search->position(), f.search_position);
        unpack(search->orientation(), f.search_orientation);
        f.search_margin = search->margin();
    }
    unpackPart(m.progress(), f.progress);
    f.shear_lost = m.shear_lost();
    if (m.warnings() != nullptr)
        for (const flatbuffers::String* warning : *m.warnings()) f.warnings.push_back(warning->str());
    if (m.memory() != nullptr)
        for (const fb::ForceArray* array : *m.memory()) {
            ForceArray& into = f.memory.emplace_back();
            if (array->name() != nullptr) into.name = array->name()->str();
            unpack(array->values(), into.values);
        }
    f.origin_x = m.origin_x(), f.origin_y = m.origin_y(), f.origin_z = m.origin_z();
}

/// Upper bound of a full frame's message [bytes], generously.
std::size_t messageBytes(const FullFrame& frame) {
    std::size_t memory = 0;
    for (const ForceArray& array : frame.memory) memory += 256 + 8 * array.values.size();
    return 240 * frame.blocks.inverse_mass.size() + 284 * frame.interfaces.size() +
           16 * frame.interfaces.patch_xi.size() + 81 * frame.points.size() + 400 * frame.wet.block.size() +
           16 * frame.wet.vertex_x.size() + memory + 65536;
}

}  // namespace

mcap::Bytes encode(SnapshotHeader header) {
    fb::HeaderT message;
    message.joints = std::make_unique<fb::JointsT>(toMessage(header.joints));
    for (const Water& water : header.waters) message.waters.push_back(toMessage(water));
    for (const PhreaticSurface::Point& point : header.phreatic) {
        message.phreatic_x.push_back(point.x);
        message.phreatic_z.push_back(point.z);
    }
    for (const Vec3& vertex : header.phreatic_mesh.vertices) {
        message.phreatic_x.push_back(vertex.x());
        message.phreatic_y.push_back(vertex.y());
        message.phreatic_z.push_back(vertex.z());
    }
    for (const auto& triangle : header.phreatic_mesh.triangles)
        message.phreatic_triangle.insert(message.phreatic_triangle.end(), triangle.begin(), triangle.end());
    if (header.failure) message.failure = std::make_unique<fb::FailureT>(toMessage(*header.failure));
    eachField(header, message, IntoMessage{});
    if (!header.geometry.supports.name.empty())
        eachField(header.geometry.supports, made(message.supports), IntoMessage{});
    if (header.flow) eachField(*header.flow, made(message.flow), IntoMessage{});
    return pack<fb::Header>(message);
}

mcap::Bytes encode(LightFrame frame) {
    fb::FrameT message;
    eachField(frame, message, IntoMessage{});
    if (!frame.supports.force.empty()) eachField(frame.supports, made(message.supports), IntoMessage{});
    return pack<fb::Frame>(message);
}

mcap::Bytes encode(FullFrame frame) {
    if (messageBytes(frame) > kMostMessageBytes) return {};
    flatbuffers::FlatBufferBuilder builder(kFirstBytes);
    builder.Finish(packFull(builder, frame), fb::FrameIdentifier());
    return bytesOf(builder);
}

namespace {

bool readPhreatic(const fb::HeaderT& message, SnapshotHeader& header) {
    const std::size_t count = message.phreatic_x.size();
    const bool is_mesh = !message.phreatic_triangle.empty();
    if (message.phreatic_z.size() != count || message.phreatic_y.size() != (is_mesh ? count : 0) ||
        message.phreatic_triangle.size() % 3 != 0)
        return false;
    for (std::size_t k = 0; k < count && !is_mesh; ++k)
        header.phreatic.push_back({message.phreatic_x[k], message.phreatic_z[k]});
    for (std::size_t k = 0; k < count && is_mesh; ++k)
        header.phreatic_mesh.vertices.emplace_back(message.phreatic_x[k], message.phreatic_y[k],
                                                   message.phreatic_z[k]);
    const auto& numbers = message.phreatic_triangle;
    for (std::size_t k = 0; k < numbers.size(); k += 3)
        header.phreatic_mesh.triangles.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
    return std::all_of(numbers.begin(), numbers.end(),
                       [&](std::int32_t v) { return v >= 0 && static_cast<std::size_t>(v) < count; });
}

}  // namespace

bool decode(const mcap::Bytes& bytes, SnapshotHeader& header, std::string& why) {
    why = "its header is damaged";
    fb::HeaderT message;
    if (!readMessage<fb::Header>(bytes, message)) return false;
    if (message.format > kSnapshotFormat) {
        why = "it has format " + std::to_string(message.format) +
              ", of a later version; this one reads up to " + std::to_string(kSnapshotFormat);
        return false;
    }
    if (!message.joints || !fromMessage(*message.joints, header.joints)) return false;
    for (const auto& water : message.waters)
        if (!fromMessage(*water, header.waters.emplace_back())) return false;
    if (!readPhreatic(message, header)) return false;
    if (message.failure && !fromMessage(*message.failure, header.failure.emplace())) return false;
    eachField(header, message, FromMessage{});
    if (message.supports) eachField(header.geometry.supports, *message.supports, FromMessage{});
    if (message.flow) eachField(header.flow.emplace(), *message.flow, FromMessage{});
    return true;
}

bool decode(const mcap::Bytes& bytes, LightFrame& frame) {
    fb::FrameT message;
    if (!readMessage<fb::Frame>(bytes, message)) return false;
    eachField(frame, message, FromMessage{});
    if (message.supports) eachField(frame.supports, *message.supports, FromMessage{});
    return true;
}

bool decode(const mcap::Bytes& bytes, FullFrame& frame) {
    const fb::Full* message = verified<fb::Full>(bytes);
    if (message != nullptr) unpackFull(*message, frame);
    return message != nullptr;
}

SnapshotFlow flowOf(const SteadyFlow& flow, const Model& model) {
    const double unit_weight = model.flow->density * model.gravity.magnitude;
    SnapshotFlow out;
    for (std::size_t n = 0; n < flow.nodes.size(); ++n) {
        out.node.push_back(flow.nodes[n]);
        out.pressure.push_back(unit_weight * flow.pressure_head[n]);
    }
    for (const auto& triangle : flow.triangles)
        out.triangle.insert(out.triangle.end(), triangle.begin(), triangle.end());
    out.joint = flow.joint;
    out.block_a = flow.block_a;
    out.block_b = flow.block_b;
    return out;
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
    const std::vector<Joint>& wet = header.geometry.wet_joints;
    header.joints.insert(header.joints.end(), wet.begin(), wet.end());
    if (!allCoulomb(model.joints)) header.format = kFormatWithLaws;
    header.waters = model.waters;
    if (model.phreatic) {
        header.phreatic = model.phreatic->line;
        header.phreatic_mesh = model.phreatic->mesh;
    }
    return header;
}

}  // namespace talus::formats
