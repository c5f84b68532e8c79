#pragma once
// A parsed TOML text as plain nodes with their places. Only document.cpp includes toml++, which takes long to
// compile.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "talus/result.h"
#include "toml/place.h"

namespace talus::formats::toml {

enum class Kind : std::uint8_t { table, array, text, integer, real, boolean, date };

struct Entry;

/// A node of a Document, valid as long as the document lives. Cheap to copy.
class Node {
 public:
    explicit Node(const void* node) : node_(node) {}

    Kind kind() const;
    Place place() const;

    /// \pre the node is of the kind asked for
    std::int64_t integer() const;
    double real() const;
    bool boolean() const;
    bool isNumber() const { return kind() == Kind::integer || kind() == Kind::real; }
    double number() const { return kind() == Kind::integer ? static_cast<double>(integer()) : real(); }
    const std::string& text() const;
    std::size_t size() const;                              ///< of an array or a table
    Node at(std::size_t index) const;                      ///< of an array
    std::optional<Node> find(std::string_view key) const;  ///< of a table
    std::vector<Entry> entries() const;                    ///< of a table, in the order of the file

 private:
    friend class Document;
    const void* node_;  ///< a toml::node
};

struct Entry {
    std::string key;
    Place place;  ///< of the key
    Node value;
};

/// What was found, for messages: `a string "abc"`, `an integer 3`, `a table`.
std::string describe(const Node& node);

/// The value alone, for messages about its size: `-3`, `"abc"`, `nan`.
std::string valueText(const Node& node);

/// A value that can be put into a document.
using Scalar = std::variant<bool, std::int64_t, double, std::string>;

/// One part of a field's path: a key of a table, or an index of an array.
using PathPart = std::variant<std::string, std::size_t>;

class Document {
 public:
    /// Syntax errors carry their line and column.
    static Result<Document> parse(const std::string& text, const std::string& path);

    Node root() const { return Node(root_.get()); }

    /// Replaces a value, which keeps its place in the text. Adds a missing key, and missing tables of the
    /// path. With `may_append` an index just behind the end of an array adds an element. Returns what is
    /// wrong with the path, or nothing. Copies of a document share its nodes.
    std::optional<std::string> set(const std::vector<PathPart>& path, const Scalar& value,
                                   bool may_append = false);
    /// The same with a copy of another document's node.
    std::optional<std::string> set(const std::vector<PathPart>& path, const Node& value);

    /// Takes a key out of its table; nothing happens where there is none.
    void erase(const std::vector<PathPart>& path);

 private:
    explicit Document(std::shared_ptr<void> root) : root_(std::move(root)) {}
    std::shared_ptr<void> root_;  ///< a toml::node, namely a table
};

}  // namespace talus::formats::toml
