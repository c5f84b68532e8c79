#pragma once
// How a run's messages are laid out in the container: channels, topics, schemas, times.

#include <cmath>
#include <cstdint>
#include <string_view>

namespace talus::formats {

inline constexpr std::string_view kProfile = "talus";
inline constexpr std::string_view kEndName = "talus.end";  ///< metadata record that a finished file has

enum Channel : std::uint16_t { kHeaderChannel = 1, kFrameChannel = 2, kFullChannel = 3 };

struct ChannelLayout {
    std::uint16_t id;
    const char* topic;
    const char* schema;
};
inline constexpr ChannelLayout kChannels[] = {{kHeaderChannel, "header", "talus.snapshot.Header"},
                                              {kFrameChannel, "frame", "talus.snapshot.Frame"},
                                              {kFullChannel, "full", "talus.snapshot.Full"}};

/// Simulated time as the container's log time.
inline std::uint64_t nanoseconds(double seconds) {
    return seconds > 0 ? static_cast<std::uint64_t>(std::llround(seconds * 1e9)) : 0;
}
inline double seconds(std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) / 1e9; }

}  // namespace talus::formats
