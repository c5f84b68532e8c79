#include "scenario/unnamed.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "scenario/properties.h"

namespace talus::formats::scenario {
namespace {

void collectTexts(const Node& node, std::set<std::string>& texts) {
    if (node.kind() == Kind::text) texts.insert(node.text());
    if (node.kind() == Kind::array)
        for (std::size_t i = 0; i < node.size(); ++i) collectTexts(node.at(i), texts);
    if (node.kind() == Kind::table)
        for (const Entry& entry : node.entries()) collectTexts(entry.value, texts);
}

/// What a file refers to, or may by its own name: the names of its joints in rock among them.
std::set<std::string> textsOf(const Node& root) {
    std::set<std::string> texts;
    collectTexts(root, texts);
    return texts;
}

}  // namespace

std::optional<std::string> unknownName(const FieldPath& path, const KnownNames& known) {
    const auto* section = path.size() < 2 ? nullptr : std::get_if<std::string>(&path[0]);
    const auto* name = path.size() < 2 ? nullptr : std::get_if<std::string>(&path[1]);
    if (section == nullptr || name == nullptr || *name == "*") return std::nullopt;
    if (*section != "joint" && *section != "material") return std::nullopt;
    const std::vector<std::string>& names = *section == "joint" ? known.joints : known.materials;
    if (names.empty() || std::find(names.begin(), names.end(), *name) != names.end()) return std::nullopt;
    return "found the unknown " + *section + " " + quoted(*name) + suggestion(*name, names);
}

void warnOfUnnamed(Report& report, const Node& root) {
    if (root.kind() != Kind::table) return;
    std::optional<std::set<std::string>> named;  // by the file; most have nothing to look for
    for (const char* section : {"material", "joint"}) {
        const auto tables = root.find(section);
        if (!tables || tables->kind() != Kind::table) continue;
        const bool is_joint = std::string_view(section) == "joint";
        if (!is_joint && tables->size() < 2) continue;
        for (const Entry& entry : tables->entries()) {
            if (is_joint && entry.key == kDefaultJoint) continue;
            if (!named) named = textsOf(root);
            if (named->count(entry.key) > 0) continue;
            const auto meant = nearest(entry.key, {named->begin(), named->end()});
            report.warn(joinField(section, entry.key) +
                        (entry.place.line > 0 ? " (line " + std::to_string(entry.place.line) + ")" : "") +
                        ": nothing in the file uses this " + section + ", so it has no effect" +
                        (meant ? ", did you mean " + quoted(*meant) + "?" : ""));
        }
    }
}

}  // namespace talus::formats::scenario
