#include "toml/document.h"

#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>

#include <algorithm>
#include <tuple>

#include "toml/key_depth.h"
#include "toml/wording.h"

namespace talus::formats::toml {

namespace {

const ::toml::node& raw(const void* node) { return *static_cast<const ::toml::node*>(node); }

Place placeOf(const ::toml::source_region& region) {
    return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

/// What stands at one part of a path, made when it is missing; nothing when it cannot be there.
class Step {
 public:
    Step(::toml::node& parent, const PathPart& part) : parent_(parent), part_(part) {}

    /// Why this part leads nowhere, or nothing.
    std::optional<std::string> fault(bool may_append) const {
        if (const auto* key = std::get_if<std::string>(&part_)) {
            if (parent_.is_table()) return std::nullopt;
            return "there is no table to hold the key " + quoted(*key);
        }
        const std::size_t index = std::get<std::size_t>(part_);
        if (!parent_.is_array()) return "there is no array to hold element [" + std::to_string(index) + "]";
        const std::size_t size = parent_.as_array()->size();
        if (index < size || (may_append && index == size)) return std::nullopt;
        return "there is no element [" + std::to_string(index) + "], the array has " + std::to_string(size) +
               (size == 1 ? " element" : " elements");
    }

    ::toml::node* find() const {
        if (const auto* key = std::get_if<std::string>(&part_)) return parent_.as_table()->get(*key);
        return parent_.as_array()->get(std::get<std::size_t>(part_));
    }

    template <class T>
    void put(T&& value) const {
        if (const auto* key = std::get_if<std::string>(&part_)) {
            parent_.as_table()->insert_or_assign(*key, std::forward<T>(value));
        } else if (::toml::array& array = *parent_.as_array(); std::get<std::size_t>(part_) < array.size()) {
            array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(std::get<std::size_t>(part_)),
                          std::forward<T>(value));
        } else {
            array.push_back(std::forward<T>(value));
        }
    }

    void erase() const {
        if (const auto* key = std::get_if<std::string>(&part_)) parent_.as_table()->erase(*key);
    }

 private:
    ::toml::node& parent_;
    const PathPart& part_;
};

/// Hands the last step of a path to `put`, and makes what is missing on the way. \return what is wrong with
/// the path, or nothing
template <class Put>
std::optional<std::string> putAt(void* root, const std::vector<PathPart>& path, bool may_append,
                                 const Put& put) {
    ::toml::node* node = static_cast<::toml::node*>(root);
    for (std::size_t i = 0; i < path.size(); ++i) {
        const Step step(*node, path[i]);
        if (auto fault = step.fault(may_append)) return fault;
        if (i + 1 == path.size()) {
            put(step);
            return std::nullopt;
        }
        if (!step.find()) {
            if (std::holds_alternative<std::string>(path[i + 1])) {
                step.put(::toml::table{});
            } else if (may_append) {
                step.put(::toml::array{});
            } else {
                return "there is no such array";
            }
        }
        node = step.find();
    }
    return "the path is empty";
}

Error syntaxError(const std::string& path, Place place, std::string message) {
    return {"", std::move(message), path, place.line, place.column};
}

}  // namespace

Kind Node::kind() const {
    switch (raw(node_).type()) {
        case ::toml::node_type::table:
            return Kind::table;
        case ::toml::node_type::array:
            return Kind::array;
        case ::toml::node_type::string:
            return Kind::text;
        case ::toml::node_type::integer:
            return Kind::integer;
        case ::toml::node_type::floating_point:
            return Kind::real;
        case ::toml::node_type::boolean:
            return Kind::boolean;
        default:
            return Kind::date;
    }
}

Place Node::place() const { return placeOf(raw(node_).source()); }

std::int64_t Node::integer() const { return raw(node_).as_integer()->get(); }

double Node::real() const { return raw(node_).as_floating_point()->get(); }

bool Node::boolean() const { return raw(node_).as_boolean()->get(); }

const std::string& Node::text() const { return raw(node_).as_string()->get(); }

std::size_t Node::size() const {
    const ::toml::node& node = raw(node_);
    return node.is_array() ? node.as_array()->size() : node.as_table()->size();
}

Node Node::at(std::size_t index) const { return Node(raw(node_).as_array()->get(index)); }

std::optional<Node> Node::find(std::string_view key) const {
    const ::toml::node* value = raw(node_).as_table()->get(key);
    return value ? std::optional<Node>(Node(value)) : std::nullopt;
}

std::vector<Entry> Node::entries() const {
    std::vector<Entry> entries;
    for (const auto& [key, value] : *raw(node_).as_table())
        entries.push_back({std::string(key.str()), placeOf(key.source()), Node(&value)});
    // toml++ keeps tables sorted by key; the file's order decides ties between joints.
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
    });
    return entries;
}

std::string valueText(const Node& node) {
    switch (node.kind()) {
        case Kind::table:
            return "a table";
        case Kind::array:
            return "an array";
        case Kind::text:
            return quoted(node.text());
        case Kind::integer:
            return std::to_string(node.integer());
        case Kind::real:
            return numberText(node.real());
        case Kind::boolean:
            return node.boolean() ? "true" : "false";
        default:
            return "a date or time";
    }
}

std::string describe(const Node& node) {
    switch (node.kind()) {
        case Kind::text:
            return "a string " + valueText(node);
        case Kind::integer:
            return "an integer " + valueText(node);
        case Kind::boolean:
            return "a boolean " + valueText(node);
        case Kind::real: {
            const std::string value = valueText(node);
            const bool looks_integer = value.find_first_not_of("-0123456789") == std::string::npos;
            return "a number " + value + (looks_integer ? ".0" : "");
        }
        default:
            return valueText(node);
    }
}

Result<Document> Document::parse(const std::string& text, const std::string& path) {
    if (const auto place = tooDeepKey(text))
        return syntaxError(path, *place,
                           "found a key of more than " + std::to_string(kMaxKeyDepth) + " dotted parts");
    try {
        auto table =
            std::make_shared<::toml::table>(::toml::parse(std::string_view(text), std::string_view(path)));
        return Document(std::shared_ptr<void>(table, static_cast<::toml::node*>(table.get())));
    } catch (const ::toml::parse_error& error) {
        return syntaxError(path, placeOf(error.source()),
                           "not valid TOML: " + oneLine(std::string(error.description())));
    }
}

std::optional<std::string> Document::set(const std::vector<PathPart>& path, const Scalar& value,
                                         bool may_append) {
    return putAt(root_.get(), path, may_append,
                 [&](const Step& step) { std::visit([&](const auto& scalar) { step.put(scalar); }, value); });
}

std::optional<std::string> Document::set(const std::vector<PathPart>& path, const Node& value) {
    return putAt(root_.get(), path, false, [&](const Step& step) {
        raw(value.node_).visit([&](const auto& node) { step.put(node); });
    });
}

void Document::erase(const std::vector<PathPart>& path) {
    ::toml::node* node = static_cast<::toml::node*>(root_.get());
    for (const PathPart& part : path) {
        const Step step(*node, part);
        if (step.fault(false)) return;
        if (&part == &path.back()) return step.erase();
        node = step.find();
        if (node == nullptr) return;
    }
}

}  // namespace talus::formats::toml
