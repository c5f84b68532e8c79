#include "toml/write_document.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace talus::formats::toml {

namespace {

/// A basic string with everything escaped that TOML wants escaped.
std::string stringText(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            quoted += {'\\', c};
        } else if (code < 0x20 || code == 0x7f) {
            constexpr char kDigits[] = "0123456789ABCDEF";
            quoted += {'\\', 'u', '0', '0', kDigits[code >> 4], kDigits[code & 15]};
        } else {
            quoted += c;
        }
    }
    return quoted + '"';
}

std::string keyText(const std::string& key) {
    const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    });
    return bare ? key : stringText(key);
}

/// The shortest text that reads back as the same double, and as a float of TOML.
std::string realText(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    std::array<char, 40> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    std::string text(buffer.data(), end);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string inlineText(const Node& node) {
    std::string list;
    switch (node.kind()) {
        case Kind::text:
            return stringText(node.text());
        case Kind::integer:
            return std::to_string(node.integer());
        case Kind::real:
            return realText(node.real());
        case Kind::boolean:
            return node.boolean() ? "true" : "false";
        case Kind::array:
            for (std::size_t i = 0; i < node.size(); ++i) list += (i ? ", " : "") + inlineText(node.at(i));
            return "[" + list + "]";
        case Kind::table:
            for (const Entry& entry : node.entries())
                list += (list.empty() ? " " : ", ") + keyText(entry.key) + " = " + inlineText(entry.value);
            return "{" + list + " }";
        case Kind::date:  // no scenario has one; reading it back is an error, as it was
            break;
    }
    return "1970-01-01";
}

bool isTableArray(const Node& node) {
    if (node.kind() != Kind::array || node.size() == 0) return false;
    for (std::size_t i = 0; i < node.size(); ++i)
        if (node.at(i).kind() != Kind::table) return false;
    return true;
}

/// Whether an entry of a section is a section of its own; the others are lines of it.
bool isSection(const Node& node, int depth) {
    return depth < 2 && (node.kind() == Kind::table || isTableArray(node));
}

bool hasLines(const Node& table, int depth) {
    const auto entries = table.entries();
    return entries.empty() || std::any_of(entries.begin(), entries.end(),
                                          [&](const Entry& entry) { return !isSection(entry.value, depth); });
}

void writeSection(std::string& text, const std::string& header, const std::string& path, const Node& table,
                  int depth);

void writeSections(std::string& text, const std::string& path, const Node& table, int depth) {
    for (const Entry& entry : table.entries()) {
        if (!isSection(entry.value, depth)) continue;
        const std::string name = (path.empty() ? "" : path + ".") + keyText(entry.key);
        if (entry.value.kind() == Kind::table) {
            // [joint] alone says nothing when all there is are [joint.NAME]s.
            const std::string header = hasLines(entry.value, depth + 1) ? "\n[" + name + "]\n" : "";
            writeSection(text, header, name, entry.value, depth + 1);
        } else {
            // Tables below an element stay inline ("box = { ... }"), as people write them.
            for (std::size_t i = 0; i < entry.value.size(); ++i)
                writeSection(text, "\n[[" + name + "]]\n", name, entry.value.at(i), 2);
        }
    }
}

void writeSection(std::string& text, const std::string& header, const std::string& path, const Node& table,
                  int depth) {
    text += header;
    for (const Entry& entry : table.entries())
        if (!isSection(entry.value, depth))
            text += keyText(entry.key) + " = " + inlineText(entry.value) + "\n";
    writeSections(text, path, table, depth);
}

}  // namespace

std::string writeDocument(const Document& document) {
    std::string text;
    writeSection(text, "", "", document.root(), 0);
    return text;
}

}  // namespace talus::formats::toml
