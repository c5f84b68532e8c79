// Wavefront OBJ: `v x y z` and `f a b c ...`. Each corner is `vertex`, `vertex/texture` or
// `vertex/texture/normal`, counted from 1, or backwards from -1. `o` and `g` name solids.

#include <charconv>

#include "mesh/builder.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using mesh::FileSurface;
using mesh::SurfaceBuilder;
using mesh::Words;

class ObjReader {
 public:
    ObjReader(const std::string& text, SurfaceBuilder& builder) : words_(text), builder_(builder) {}

    Result<FileSurface> read() {
        while (words_.nextLine()) {
            const std::string_view word = words_.next();
            if (word == "v")
                if (auto fault = readVertex()) return *fault;
            if (word == "f")
                if (auto fault = readFace()) return *fault;
            if (word == "o" || word == "g") builder_.continueSolid(std::string(words_.next()));
        }
        return builder_.finish();
    }

 private:
    std::optional<Error> readVertex() {
        Vec3 position;
        for (double& coordinate : position) {
            const std::string_view word = words_.next();
            const auto value = numberOf(word);
            if (!value)
                return builder_.fault(
                    words_.line(), "found " + toml::quoted(word) + ", allowed: v with three finite numbers");
            coordinate = *value;
        }
        vertices_.push_back(builder_.vertex(position));
        return std::nullopt;
    }

    std::optional<Error> readFace() {
        std::vector<std::int32_t> corners;
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            const auto index = indexOf(word);
            if (!index)
                return builder_.fault(words_.line(),
                                      "found the corner " + toml::quoted(word) + ", allowed: 1 to " +
                                          std::to_string(vertices_.size()) + ", or -1 to -" +
                                          std::to_string(vertices_.size()) + ", the vertices listed before");
            corners.push_back(*index);
        }
        if (corners.size() < 3)
            return builder_.fault(words_.line(), "found a face with " + std::to_string(corners.size()) +
                                                     " corners, allowed: three or more");
        if (!builder_.face(corners, words_.line()))
            return builder_.fault(words_.line(),
                                  "found a face that is not convex, allowed: convex faces, or triangles");
        return std::nullopt;
    }

    std::optional<std::int32_t> indexOf(std::string_view word) const {
        word = word.substr(0, word.find('/'));
        std::int64_t index = 0;
        const auto read = std::from_chars(word.data(), word.data() + word.size(), index);
        if (read.ec != std::errc() || read.ptr != word.data() + word.size()) return {};
        const auto count = static_cast<std::int64_t>(vertices_.size());
        if (index < 0) index += count + 1;
        if (index < 1 || index > count) return {};
        return vertices_[static_cast<std::size_t>(index - 1)];
    }

    Words words_;
    SurfaceBuilder& builder_;
    std::vector<std::int32_t> vertices_;
};

}  // namespace

Result<FileSurface> mesh::readObj(const std::string& text, SurfaceBuilder builder) {
    return ObjReader(text, builder).read();
}

}  // namespace talus::formats
