// STL. Binary: 80 bytes of header, the number of triangles, then 50 bytes each (normal, three corners, two
// bytes of attributes), little endian. Text: solid / facet normal / outer loop / vertex x y z (three times) /
// endloop / endfacet. Normals are passed over; the order of the corners says which side is out.

#include <cstring>

#include "mesh/builder.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using mesh::FileSurface;
using mesh::SurfaceBuilder;
using mesh::Words;

constexpr std::size_t kHead = 84, kRecord = 50;

std::uint32_t countOf(const std::string& bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    return count;
}

Result<FileSurface> readBinary(const std::string& bytes, SurfaceBuilder& builder) {
    builder.setSinglePrecision();
    for (std::size_t at = kHead; at < bytes.size(); at += kRecord) {
        std::array<float, 12> numbers;
        std::memcpy(numbers.data(), bytes.data() + at, sizeof numbers);
        std::array<std::int32_t, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 corner(numbers[3 + 3 * i], numbers[4 + 3 * i], numbers[5 + 3 * i]);
            if (!corner.allFinite())
                return builder.fault(0, "triangle " + std::to_string((at - kHead) / kRecord + 1) +
                                            ": found a coordinate that is not finite");
            corners[i] = builder.vertex(corner);
        }
        builder.triangle(corners, 0);
    }
    return builder.finish();
}

class TextReader {
 public:
    TextReader(const std::string& text, SurfaceBuilder& builder) : words_(text), builder_(builder) {}

    Result<FileSurface> read() {
        while (words_.nextLine()) {
            const std::string_view word = words_.next();
            if (word == "vertex") {
                if (auto fault = readVertex()) return *fault;
            } else if (word == "endfacet" || word == "endloop") {
                if (word == "endfacet" && corners_.size() != 3) return corners();
                if (word == "endfacet")
                    builder_.triangle({corners_[0], corners_[1], corners_[2]}, facet_line_);
            } else if (word == "facet") {
                corners_.clear();
                facet_line_ = words_.line();
            } else if (word == "solid") {
                builder_.beginSolid(std::string(words_.next()));
            } else if (!word.empty() && word != "outer" && word != "endsolid") {
                return builder_.fault(words_.line(),
                                      "found " + toml::quoted(word) +
                                          ", allowed: facet, outer loop, vertex, endloop, endfacet");
            }
        }
        return builder_.finish();
    }

 private:
    std::optional<Error> readVertex() {
        Vec3 corner;
        for (double& coordinate : corner) {
            const std::string_view word = words_.next();
            const auto value = numberOf(word);
            if (!value)
                return builder_.fault(words_.line(), "found " + toml::quoted(word) +
                                                         ", allowed: vertex with three finite numbers");
            coordinate = *value;
        }
        corners_.push_back(builder_.vertex(corner));
        return std::nullopt;
    }

    Error corners() const {
        return builder_.fault(facet_line_, "found a facet with " + std::to_string(corners_.size()) +
                                               " corners, allowed: three");
    }

    Words words_;
    SurfaceBuilder& builder_;
    std::vector<std::int32_t> corners_;
    int facet_line_ = 0;
};

}  // namespace

Result<FileSurface> mesh::readStl(const std::string& bytes, SurfaceBuilder builder) {
    const bool has_head = bytes.size() >= kHead;
    if (has_head && bytes.size() == kHead + kRecord * std::size_t{countOf(bytes)})
        return readBinary(bytes, builder);
    // Some binary files begin with "solid", too: a text has no zero bytes.
    if (bytes.find('\0') == std::string::npos) return TextReader(bytes, builder).read();
    return builder.fault(0, has_head ? "found " + std::to_string(bytes.size()) + " bytes, allowed: " +
                                           std::to_string(kHead + kRecord * std::size_t{countOf(bytes)}) +
                                           " for the " + std::to_string(countOf(bytes)) +
                                           " triangles a binary STL file counts"
                                     : "found neither text nor a binary STL file");
}

}  // namespace talus::formats
