#pragma once
// The blocks of a model as files: a mesh for other programs, a table, a picture.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "talus/model.h"

namespace talus::tools {

/// Wavefront OBJ, one object per block; coordinates in m, read back to the last bit. `comments` are whole
/// lines.
std::string blocksObj(const Model& model, std::string_view comments);

/// CSV: name, motion, volume [m3], centroid [m], number of faces, thickness [m].
std::string blocksCsv(const Model& model, std::string_view comments);

/// From where a picture is taken: azimuth clockwise from north (+y), elevation above the horizon [rad].
struct View {
    double azimuth = 0;
    double elevation = 0;
    double tilt = 0;  ///< of the model, uphill along x [rad]
};

/// Blocks that a picture shows alike.
struct BlockLook {
    std::string words;                    ///< in the legend
    double red = 0, green = 0, blue = 0;  ///< in full light, 0..255
};

/// Groups of blocks in a picture: by default free and fixed ones.
struct Painting {
    std::vector<BlockLook> looks{};
    std::vector<std::size_t> look_of_block{};  ///< one for each block
    std::string heading{};                     ///< drawn above; empty: none
    std::string remark{};                      ///< drawn beside the scale
};

/// Free blocks in the colours of rock, fixed ones in grey.
Painting paintedByMotion(const Model& model);

/// Parallel projection as SVG: the faces that can be seen.
std::string blocksSvg(const Model& model, const View& view, std::string_view title, const Painting& painting);
std::string blocksSvg(const Model& model, const View& view, std::string_view title);

}  // namespace talus::tools
