#include "snapshot/alignment.h"

#include <flatbuffers/reflection.h>

#include <algorithm>

#include "snapshot_schema.h"

namespace talus::formats {
namespace {

using flatbuffers::Offset;
using flatbuffers::Table;
using reflection::BaseType;

bool isAligned(const reflection::Schema& schema, const reflection::Object& type, const Table& table);

const reflection::Object& objectOf(const reflection::Schema& schema, const reflection::Field& field) {
    return *schema.objects()->Get(static_cast<flatbuffers::uoffset_t>(field.type()->index()));
}

bool vectorIsAligned(const reflection::Schema& schema, const Table& table, const reflection::Field& field) {
    if (field.type()->element() == BaseType::Obj) {
        const auto* tables = flatbuffers::GetFieldV<Offset<Table>>(table, field);
        return tables == nullptr || std::all_of(tables->begin(), tables->end(), [&](const Table* element) {
                   return isAligned(schema, objectOf(schema, field), *element);
               });
    }
    const auto* vector = flatbuffers::GetFieldAnyV(table, field);
    const std::size_t size = flatbuffers::GetTypeSize(field.type()->element());
    return vector == nullptr || reinterpret_cast<std::uintptr_t>(vector->Data()) % size == 0;
}

bool isAligned(const reflection::Schema& schema, const reflection::Object& type, const Table& table) {
    return std::all_of(type.fields()->begin(), type.fields()->end(), [&](const reflection::Field* field) {
        if (field->type()->base_type() == BaseType::Vector) return vectorIsAligned(schema, table, *field);
        if (field->type()->base_type() != BaseType::Obj) return true;
        const Table* inner = flatbuffers::GetFieldT(table, *field);
        return inner == nullptr || isAligned(schema, objectOf(schema, *field), *inner);
    });
}

}  // namespace

bool vectorsAreAligned(const mcap::Bytes& message, const char* type_name) {
    const auto& schema = *reflection::GetSchema(kSnapshotSchema);
    return isAligned(schema, *schema.objects()->LookupByKey(type_name),
                     *flatbuffers::GetAnyRoot(message.data()));
}

}  // namespace talus::formats
