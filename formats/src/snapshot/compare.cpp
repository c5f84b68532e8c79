// The first difference of two frames, found by walking both messages along the schema.

#include <flatbuffers/reflection.h>

#include <charconv>
#include <vector>

#include "snapshot/convert.h"
#include "snapshot_schema.h"

namespace talus::formats {
namespace {

using reflection::BaseType;

std::string textOf(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

class Walk {
 public:
    explicit Walk(const reflection::Schema& schema) : schema_(schema) {}

    std::optional<Difference> tables(const reflection::Object& type, const flatbuffers::Table& a,
                                     const flatbuffers::Table& b, const std::string& path) const {
        // The schema lists fields by name; here they come in the order they were declared in.
        std::vector<const reflection::Field*> fields_in_order(type.fields()->size());
        for (const reflection::Field* field : *type.fields()) fields_in_order[field->id()] = field;
        for (const reflection::Field* field : fields_in_order)
            if (auto found = fields(*field, a, b, path + field->name()->str())) return found;
        return std::nullopt;
    }

 private:
    std::optional<Difference> fields(const reflection::Field& field, const flatbuffers::Table& a,
                                     const flatbuffers::Table& b, const std::string& path) const {
        switch (field.type()->base_type()) {
            case BaseType::Obj: {
                const auto* in_a = flatbuffers::GetFieldT(a, field);
                const auto* in_b = flatbuffers::GetFieldT(b, field);
                if (in_a == nullptr || in_b == nullptr) return present(path, in_a, in_b);
                const auto& type =
                    *schema_.objects()->Get(static_cast<flatbuffers::uoffset_t>(field.type()->index()));
                return tables(type, *in_a, *in_b, path + ".");
            }
            case BaseType::Vector:
                return vectors(field, a, b, path);
            default:
                return texts(path, flatbuffers::GetAnyFieldS(a, field, nullptr),
                             flatbuffers::GetAnyFieldS(b, field, nullptr), scalar(a, field),
                             scalar(b, field));
        }
    }

    /// A scalar's bits, for numbers that print alike and are not.
    static std::string scalar(const flatbuffers::Table& table, const reflection::Field& field) {
        if (field.type()->base_type() == BaseType::String) return "";
        const double value = flatbuffers::GetAnyFieldF(table, field);
        return field.type()->base_type() == BaseType::Double
                   ? textOf(value)
                   : flatbuffers::GetAnyFieldS(table, field, nullptr);
    }

    static std::optional<Difference> texts(const std::string& path, const std::string& a,
                                           const std::string& b, const std::string& exact_a,
                                           const std::string& exact_b) {
        if (a == b && exact_a == exact_b) return std::nullopt;
        return Difference{path, exact_a.empty() ? a : exact_a, exact_b.empty() ? b : exact_b};
    }

    static std::optional<Difference> present(const std::string& path, const void* a, const void* b) {
        if (a == b) return std::nullopt;  // both absent
        return Difference{path, a == nullptr ? "absent" : "present", b == nullptr ? "absent" : "present"};
    }

    static std::optional<Difference> vectors(const reflection::Field& field, const flatbuffers::Table& a,
                                             const flatbuffers::Table& b, const std::string& path) {
        const BaseType element = field.type()->element();
        const auto* in_a = flatbuffers::GetFieldAnyV(a, field);
        const auto* in_b = flatbuffers::GetFieldAnyV(b, field);
        const std::size_t size_a = in_a == nullptr ? 0 : in_a->size(),
                          size_b = in_b == nullptr ? 0 : in_b->size();
        if (size_a != size_b)
            return Difference{path, std::to_string(size_a) + " values", std::to_string(size_b) + " values"};
        for (std::size_t k = 0; k < size_a; ++k) {
            const std::string place = path + "[" + std::to_string(k) + "]";
            const std::string text_a = flatbuffers::GetAnyVectorElemS(in_a, element, k);
            const std::string text_b = flatbuffers::GetAnyVectorElemS(in_b, element, k);
            const bool number = element == BaseType::Double || element == BaseType::Float;
            if (auto found =
                    texts(place, text_a, text_b,
                          number ? textOf(flatbuffers::GetAnyVectorElemF(in_a, element, k)) : text_a,
                          number ? textOf(flatbuffers::GetAnyVectorElemF(in_b, element, k)) : text_b))
                return found;
        }
        return std::nullopt;
    }

    const reflection::Schema& schema_;
};

std::optional<Difference> compare(const mcap::Bytes& a, const mcap::Bytes& b, const char* type_name) {
    if (a == b) return std::nullopt;
    const auto* schema = reflection::GetSchema(kSnapshotSchema);
    const auto* type = schema->objects()->LookupByKey(type_name);
    auto found = Walk(*schema).tables(*type, *flatbuffers::GetAnyRoot(a.data()),
                                      *flatbuffers::GetAnyRoot(b.data()), "");
    return found ? found : Difference{"message", "other bytes", "other bytes"};
}

}  // namespace

std::optional<Difference> firstDifference(const LightFrame& a, const LightFrame& b) {
    return compare(encode(a), encode(b), "talus.snapshot.Frame");
}

std::optional<Difference> firstDifference(const FullFrame& a, const FullFrame& b) {
    return compare(encode(a), encode(b), "talus.snapshot.Full");
}

}  // namespace talus::formats
