#pragma once
// The blocks of a model as files: a mesh for other programs, a table, a picture.

#include <string>
#include <string_view>

#include "talus/model.h"

namespace talus::tools {

/// Wavefront OBJ, one object per block; coordinates in m, read back to the last bit. `comments` are whole lines.
std::string blocksObj(const Model& model, std::string_view comments);

/// CSV: name, motion, volume [m3], centroid [m], number of faces, thickness [m].
std::string blocksCsv(const Model& model, std::string_view comments);

/// From where a picture is taken: azimuth clockwise from north (+y), elevation above the horizon [rad].
struct View {
    double azimuth = 0;
    double elevation = 0;
};

/// Parallel projection as SVG: the faces that can be seen, free blocks in the colours of rock, fixed ones in grey.
std::string blocksSvg(const Model& model, const View& view, std::string_view title);

}  // namespace talus::tools
