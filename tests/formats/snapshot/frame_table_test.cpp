// The table of a frame's arrays (talus/frame_table.h) against the schema, the codec, and the decoder of the
// replay page.

#include "talus/frame_table.h"

#include <doctest/doctest.h>
#include <flatbuffers/reflection.h>

#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "snapshot/convert.h"
#include "snapshot_schema.h"
#include "support/files.h"

namespace talus::formats {
namespace {

using reflection::BaseType;

const reflection::Schema& schema() { return *reflection::GetSchema(kSnapshotSchema); }

const reflection::Object& tableOf(const std::string& name) {
    const auto* found = schema().objects()->LookupByKey(("talus.snapshot." + name).c_str());
    REQUIRE(found != nullptr);
    return *found;
}

const reflection::Object& typeOf(const reflection::Field& field) {
    return *schema().objects()->Get(static_cast<flatbuffers::uoffset_t>(field.type()->index()));
}

/// "[double]", "Vectors", "double", ... of a field of the schema.
std::string typeName(const reflection::Field& field) {
    static const std::map<BaseType, std::string> kNames{
        {BaseType::UByte, "ubyte"},   {BaseType::Int, "int"},     {BaseType::Long, "long"},
        {BaseType::ULong, "ulong"},   {BaseType::Float, "float"}, {BaseType::Double, "double"},
        {BaseType::String, "string"}, {BaseType::Bool, "bool"},   {BaseType::Obj, "table"}};
    const BaseType type = field.type()->base_type();
    if (type == BaseType::Obj) {
        const std::string name = typeOf(field).name()->str();
        return name.substr(name.rfind('.') + 1);
    }
    if (type == BaseType::Vector) return "[" + kNames.at(field.type()->element()) + "]";
    return kNames.at(type);
}

/// Fields of a table that are in use, by name.
std::map<std::string, const reflection::Field*> fieldsOf(const reflection::Object& table) {
    std::map<std::string, const reflection::Field*> fields;
    for (const reflection::Field* field : *table.fields())
        if (!field->deprecated()) fields[field->name()->str()] = field;
    return fields;
}

std::string typeOfArray(const VectorList<double>&) { return "Vectors"; }
std::string typeOfArray(const QuaternionList&) { return "Quaternions"; }
std::string typeOfArray(const std::vector<double>&) { return "[double]"; }
std::string typeOfArray(const std::vector<float>&) { return "[float]"; }
std::string typeOfArray(const std::vector<std::int32_t>&) { return "[int]"; }
std::string typeOfArray(const std::vector<std::int64_t>&) { return "[long]"; }
std::string typeOfArray(const std::vector<std::uint8_t>&) { return "[ubyte]"; }
std::string typeOfArray(const std::vector<PointState>&) { return "[ubyte]"; }

/// Values that no other array has; `next` counts on.
template <class Number>
void fill(std::vector<Number>& values, int& next) {
    for (int k = 0; k < 3; ++k) values.push_back(static_cast<Number>(next++ % 251));
}
void fill(std::vector<PointState>& values, int& next) {
    values = {PointState::sticking, PointState::open, PointState::slipping};
    ++next;
}
void fill(VectorList<double>& list, int& next) { fill(list.x, next), fill(list.y, next), fill(list.z, next); }
void fill(QuaternionList& list, int& next) {
    fill(list.w, next), fill(list.x, next), fill(list.y, next), fill(list.z, next);
}

template <class Number>
std::vector<double> numbersIn(const std::vector<Number>& values) {
    std::vector<double> numbers;
    for (const Number value : values) numbers.push_back(static_cast<double>(value));
    return numbers;
}
std::vector<double> numbersIn(const VectorList<double>& list) {
    std::vector<double> all = list.x;
    all.insert(all.end(), list.y.begin(), list.y.end());
    all.insert(all.end(), list.z.begin(), list.z.end());
    return all;
}
std::vector<double> numbersIn(const QuaternionList& list) {
    std::vector<double> all = list.w;
    const std::vector<double> rest = numbersIn(VectorList<double>{list.x, list.y, list.z});
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
}

/// All numbers under a field of a message, in the order of the schema.
std::vector<double> numbersUnder(const flatbuffers::Table& table, const reflection::Field& field) {
    std::vector<double> numbers;
    if (field.type()->base_type() == BaseType::Obj) {
        const auto* inner = flatbuffers::GetFieldT(table, field);
        REQUIRE(inner != nullptr);
        for (const char* name : {"w", "x", "y", "z"})
            if (const auto* component = typeOf(field).fields()->LookupByKey(name)) {
                const std::vector<double> more = numbersUnder(*inner, *component);
                numbers.insert(numbers.end(), more.begin(), more.end());
            }
        return numbers;
    }
    const auto* vector = flatbuffers::GetFieldAnyV(table, field);
    REQUIRE(vector != nullptr);
    for (std::size_t k = 0; k < vector->size(); ++k)
        numbers.push_back(flatbuffers::GetAnyVectorElemF(vector, field.type()->element(), k));
    return numbers;
}

/// As flatc names accessors: reference_gap -> referenceGap, shear_1 -> shear1.
std::string camel(const std::string& name) {
    std::string text;
    for (std::size_t k = 0; k < name.size(); ++k) {
        if (name[k] != '_')
            text += name[k];
        else if (++k < name.size())
            text += static_cast<char>(std::toupper(static_cast<unsigned char>(name[k])));
    }
    return text;
}

const reflection::Field* fieldByAccessor(const std::string& table, const std::string& accessor) {
    for (const auto& [name, field] : fieldsOf(tableOf(table)))
        if (camel(name) == accessor) return field;
    return nullptr;
}

}  // namespace

TEST_CASE("the schema has the table's arrays, with their types, and no others") {
    const auto in_full = fieldsOf(tableOf("Full"));
    std::map<std::string, std::set<std::string>> seen;
    const FullFrame frame{};
    eachFrameArray(frame, [&](std::string_view table, const auto& field, const auto& array) {
        const std::string name(field.name);
        CAPTURE(table);
        CAPTURE(name);
        REQUIRE(in_full.count(std::string(table)) == 1);
        const auto fields = fieldsOf(typeOf(*in_full.at(std::string(table))));
        if (table == "laws" && fields.count(name) == 0) return;  // goes by its name: see below
        REQUIRE(fields.count(name) == 1);
        CHECK(typeName(*fields.at(name)) == typeOfArray(array));
        CHECK(seen[std::string(table)].insert(name).second);
    });
    for (const auto& [table, names] : seen)
        for (const auto& [name, field] : fieldsOf(typeOf(*in_full.at(table)))) {
            const std::string place = table + "." + name;
            CAPTURE(place);
            const bool is_array =
                field->type()->base_type() == BaseType::Vector || field->type()->base_type() == BaseType::Obj;
            const bool has_names = table == "laws" && name == "parameter";
            CHECK((names.count(name) == 1) == (is_array && !has_names));
        }
}

TEST_CASE(
    "what has no column of its own goes by its name, and comes back; what a file does not have is missing") {
    FullFrame frame;
    frame.laws.named("roughness") = {1.5, 2.5};
    const mcap::Bytes message = encode(frame);
    FullFrame read;
    REQUIRE(decode(message, read));
    REQUIRE(read.laws.find("roughness") != nullptr);
    CHECK(*read.laws.find("roughness") == std::vector<double>{1.5, 2.5});
    CHECK(read.laws.find("smoothness") == nullptr);
    for (auto& parameter : read.laws.parameters) parameter.values.resize(2);
    read.laws.bonded.resize(2);
    read.laws.named("roughness") = {1.5};
    read.interfaces.point_begin = read.interfaces.patch_begin = read.wet.water_begin =
        read.wet.vertex_begin = {0};
    CHECK(misfit(read, {.joints = 2}) == "laws.roughness");
    read.laws.named("roughness") = {1.5, 2.5};
    CHECK_FALSE(misfit(read, {.joints = 2}).has_value());
}

TEST_CASE("the codec puts each array under its own name, and back") {
    FullFrame frame;
    int next = 1;
    eachFrameArray(frame, [&](std::string_view, const auto&, auto& array) { fill(array, next); });
    frame.memory = {{"one.a", {1, 2, 3}}, {"one.b", {}}, {"other.a", {4}}};
    const mcap::Bytes message = encode(frame);
    const flatbuffers::Table& root = *flatbuffers::GetAnyRoot(message.data());
    const auto in_full = fieldsOf(tableOf("Full"));
    std::map<std::string, std::vector<double>> written;
    eachFrameArray(frame, [&](std::string_view table, const auto& field, const auto& array) {
        const std::string name = std::string(table) + "." + std::string(field.name);
        CAPTURE(name);
        const reflection::Field& holder = *in_full.at(std::string(table));
        const auto* inner = flatbuffers::GetFieldT(root, holder);
        REQUIRE(inner != nullptr);
        written[name] = numbersIn(array);
        if (fieldsOf(typeOf(holder)).count(std::string(field.name)) == 0) return;
        CHECK(numbersUnder(*inner, *fieldsOf(typeOf(holder)).at(std::string(field.name))) == written[name]);
    });
    FullFrame read;
    REQUIRE(decode(message, read));
    eachFrameArray(read, [&](std::string_view table, const auto& field, const auto& array) {
        const std::string name = std::string(table) + "." + std::string(field.name);
        CAPTURE(name);
        CHECK(numbersIn(array) == written[name]);
    });
    REQUIRE(read.memory.size() == frame.memory.size());
    for (std::size_t k = 0; k < read.memory.size(); ++k) {
        CHECK(read.memory[k].name == frame.memory[k].name);
        CHECK(read.memory[k].values == frame.memory[k].values);
    }
}

TEST_CASE("the replay page reads existing fields only") {
    const std::string source =
        test::contentOf(std::string(TALUS_SOURCE_DIR) + "/tools/replay/src/data/messages.js");
    static const std::map<std::string, std::string> kMessages{{"header", "Header"},
                                                              {"frame", "Frame"},
                                                              {"full", "Full"},
                                                              {"water", "Water"},
                                                              {"failure", "Failure"}};
    const std::regex chain("\\b(header|frame|full|water|failure)((?:\\??\\.\\w+)+)"), part("\\w+");
    int checked = 0;
    for (auto it = std::sregex_iterator(source.begin(), source.end(), chain); it != std::sregex_iterator();
         ++it) {
        const std::string text = it->str(), names = (*it)[2];
        CAPTURE(text);
        std::string type = kMessages.at((*it)[1]);
        for (auto name = std::sregex_iterator(names.begin(), names.end(), part);
             name != std::sregex_iterator(); ++name) {
            if (std::set<std::string>{"length", "map", "toString"}.count(name->str()) == 1) break;
            const auto* field = fieldByAccessor(type, name->str());
            REQUIRE(field != nullptr);
            type = typeName(*field);
            ++checked;
        }
    }
    CHECK(checked > 30);
}

}  // namespace talus::formats
