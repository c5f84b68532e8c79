// PLY (G. Turk, 1994): a header of lines that says which elements there are and of which properties, then
// their values as text or binary, in either order of bytes. Of `vertex` x, y and z count, of `face` the list
// vertex_indices (or vertex_index); everything else is passed over.

#include <algorithm>
#include <bit>
#include <cstring>

#include "mesh/builder.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using mesh::FileSurface;
using mesh::SurfaceBuilder;
using mesh::Words;

enum class Number : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Number> numberNamed(std::string_view name) {
    constexpr std::pair<std::string_view, Number> kNames[]{
        {"char", Number::int8},      {"int8", Number::int8},       {"uchar", Number::uint8},
        {"uint8", Number::uint8},    {"short", Number::int16},     {"int16", Number::int16},
        {"ushort", Number::uint16},  {"uint16", Number::uint16},   {"int", Number::int32},
        {"int32", Number::int32},    {"uint", Number::uint32},     {"uint32", Number::uint32},
        {"float", Number::float32},  {"float32", Number::float32}, {"double", Number::float64},
        {"float64", Number::float64}};
    for (const auto& [known, number] : kNames)
        if (known == name) return number;
    return std::nullopt;
}

struct Property {
    std::string name;
    Number number = Number::float32;
    std::optional<Number> count{};  ///< of a list
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties{};
};

enum class Encoding : std::uint8_t { text, little, big };

template <class T>
double valueOf(std::string bytes, bool swapped) {
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return static_cast<double>(value);
}

class PlyReader {
 public:
    PlyReader(const std::string& text, SurfaceBuilder& builder)
        : text_(text), words_(text), builder_(builder) {}

    Result<FileSurface> read() {
        if (auto fault = readHeader()) return *fault;
        for (const Element& element : elements_) {
            // Such an element takes no bytes, so any number of them would fit the file.
            if (element.properties.empty())
                return fault("found an element " + toml::quoted(element.name) + " without properties");
            for (std::size_t k = 0; k < element.count; ++k)
                if (auto fault = readElement(element)) return *fault;
        }
        return builder_.finish();
    }

 private:
    Error fault(std::string message) const {
        return builder_.fault(encoding_ == Encoding::text ? words_.line() : 0, std::move(message));
    }

    std::optional<Error> readHeader() {
        if (!words_.nextLine() || words_.next() != "ply")
            return fault("found no PLY file, allowed: ply in its first line");
        while (words_.nextLine()) {
            const std::string_view word = words_.next();
            if (word == "end_header") {
                at_ = words_.position(text_);
                return std::nullopt;
            }
            if (word == "format") {
                if (auto error = readFormat()) return error;
            } else if (word == "element") {
                const std::string name(words_.next());
                const auto count = numberOf(words_.next());
                if (!count || !(*count >= 0 && *count <= static_cast<double>(text_.size())))
                    return fault("found no number of elements that the file can hold");
                elements_.push_back({name, static_cast<std::size_t>(*count)});
            } else if (word == "property") {
                if (auto error = readProperty()) return error;
            } else if (!word.empty() && word != "comment" && word != "obj_info") {
                return fault("found " + toml::quoted(word) +
                             ", allowed: format, element, property, comment, end_header");
            }
        }
        return fault("found no end_header");
    }

    std::optional<Error> readFormat() {
        const std::string_view name = words_.next();
        if (name == "ascii")
            encoding_ = Encoding::text;
        else if (name == "binary_little_endian")
            encoding_ = Encoding::little;
        else if (name == "binary_big_endian")
            encoding_ = Encoding::big;
        else
            return fault("found the format " + toml::quoted(name) +
                         ", allowed: ascii, binary_little_endian, binary_big_endian");
        return std::nullopt;
    }

    std::optional<Error> readProperty() {
        if (elements_.empty()) return fault("found a property before the first element");
        std::string_view type = words_.next();
        Property property;
        if (type == "list") {
            property.count = numberNamed(words_.next());
            if (!property.count) return fault("found a list without a type of its count");
            type = words_.next();
        }
        const auto number = numberNamed(type);
        if (!number) return fault("found the type " + toml::quoted(type) + ", allowed: char to double");
        property.number = *number;
        property.name = words_.next();
        if (property.number == Number::float32 && property.name == "x" && encoding_ != Encoding::text)
            builder_.setSinglePrecision();
        elements_.back().properties.push_back(std::move(property));
        return std::nullopt;
    }

    std::optional<Error> readElement(const Element& element) {
        if (encoding_ == Encoding::text) words_.nextLine();
        Vec3 place = Vec3::Zero();
        std::vector<std::int32_t> corners;
        for (const Property& property : element.properties) {
            const std::optional<double> length = property.count ? next(*property.count) : 1.0;
            if (!length || !(*length >= 0)) return cutShort(element);
            const auto axis = std::string_view("xyz").find(property.name);
            for (double k = 0; k < *length; ++k) {
                const auto value = next(property.number);
                if (!value) return cutShort(element);
                if (element.name == "vertex" && property.name.size() == 1 && axis < 3)
                    place[static_cast<Eigen::Index>(axis)] = *value;
                if (element.name == "face" && property.name.starts_with("vertex_ind")) {
                    if (!(*value >= 0 && *value < static_cast<double>(vertices_.size())))
                        return fault("found a face with a corner that is not one of the " +
                                     std::to_string(vertices_.size()) + " vertices before it");
                    corners.push_back(vertices_[static_cast<std::size_t>(*value)]);
                }
            }
        }
        if (element.name == "vertex") vertices_.push_back(builder_.vertex(place));
        if (element.name != "face") return std::nullopt;
        if (corners.size() < 3)
            return fault("found a face with " + std::to_string(corners.size()) +
                         " corners, allowed: three or more");
        if (!builder_.face(corners, encoding_ == Encoding::text ? words_.line() : 0))
            return fault("found a face that is not convex, allowed: convex faces, or triangles");
        return std::nullopt;
    }

    Error cutShort(const Element& element) const {
        return fault("found an element " + toml::quoted(element.name) +
                     " that lacks a finite number, allowed: one for each of its properties");
    }

    std::optional<double> next(Number type) {
        const auto value = encoding_ == Encoding::text ? numberOf(words_.next()) : nextBinary(type);
        return value && std::isfinite(*value) ? value : std::nullopt;
    }

    std::optional<double> nextBinary(Number type) {
        constexpr std::size_t kSizes[]{1, 1, 2, 2, 4, 4, 4, 8};
        const std::size_t size = kSizes[static_cast<std::size_t>(type)];
        if (at_ + size > text_.size()) return std::nullopt;
        const std::string bytes = text_.substr(at_, size);
        at_ += size;
        const bool swapped = (encoding_ == Encoding::big) == (std::endian::native == std::endian::little);
        switch (type) {
            case Number::int8:
                return valueOf<std::int8_t>(bytes, swapped);
            case Number::uint8:
                return valueOf<std::uint8_t>(bytes, swapped);
            case Number::int16:
                return valueOf<std::int16_t>(bytes, swapped);
            case Number::uint16:
                return valueOf<std::uint16_t>(bytes, swapped);
            case Number::int32:
                return valueOf<std::int32_t>(bytes, swapped);
            case Number::uint32:
                return valueOf<std::uint32_t>(bytes, swapped);
            case Number::float32:
                return valueOf<float>(bytes, swapped);
            case Number::float64:
                break;
        }
        return valueOf<double>(bytes, swapped);
    }

    const std::string& text_;
    Words words_;
    SurfaceBuilder& builder_;
    Encoding encoding_ = Encoding::text;
    std::vector<Element> elements_;
    std::vector<std::int32_t> vertices_;
    std::size_t at_ = 0;  ///< of the next byte of binary values
};

}  // namespace

Result<FileSurface> mesh::readPly(const std::string& text, SurfaceBuilder builder) {
    return PlyReader(text, builder).read();
}

}  // namespace talus::formats
