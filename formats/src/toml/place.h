#pragma once

namespace talus::formats::toml {

/// Where something stands in the text, 1-based; columns count code points.
struct Place {
    int line = 0;
    int column = 0;
};

}  // namespace talus::formats::toml
