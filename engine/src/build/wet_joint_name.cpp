#include "talus/wet_joint_name.h"

#include <charconv>

#include "measure/words.h"

namespace talus {
namespace {

constexpr std::string_view kWet = "wet";

}  // namespace

std::string WetJointName::text() const { return joint + "@" + formatted("%g", share) + std::string(kWet); }

std::optional<WetJointName> readWetJointName(std::string_view name) {
    const std::size_t at = name.rfind('@');
    if (at == std::string_view::npos || !name.ends_with(kWet)) return std::nullopt;
    const std::string_view number = name.substr(at + 1, name.size() - at - 1 - kWet.size());
    WetJointName read{std::string(name.substr(0, at))};
    const char* end = number.data() + number.size();
    const auto [last, fault] = std::from_chars(number.data(), end, read.share);
    if (fault != std::errc() || last != end) return std::nullopt;
    return read;
}

std::string jointText(const std::string& name) {
    const auto wet = readWetJointName(name);
    return wet ? wet->joint + " (" + formatted("%.3g", 100 * wet->share) + " % wet)" : name;
}

}  // namespace talus
