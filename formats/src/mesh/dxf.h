#pragma once
// DXF as text: pairs of lines, a group code and its value.

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace talus::formats::mesh {

class DxfPairs {
 public:
    explicit DxfPairs(std::string_view text) : rest_(text) {}

    /// Goes to the next pair; false at the end of the text, or where no group code stands (isFaulty).
    bool next();
    bool isFaulty() const { return faulty_; }

    int code() const { return code_; }
    std::string_view value() const { return value_; }  ///< without the blanks around it
    bool is(int code, std::string_view value) const { return code_ == code && value_ == value; }
    /// Of the value; where the pairs are faulty, of the text in place of a group code, which is `value`.
    int line() const { return line_; }

 private:
    std::string_view nextLine();

    std::string_view rest_, value_{};
    int code_ = 0, line_ = 0;
    bool faulty_ = false;
};

/// What the section ENTITIES has one after the other.
struct DxfEntity {
    std::string type, layer = "0";
    int line = 0;
    std::map<int, double> numbers{};  ///< by their group codes; the last of each

    double number(int code, double otherwise = 0) const {
        const auto found = numbers.find(code);
        return found == numbers.end() ? otherwise : found->second;
    }
    int flags() const {
        const double all = number(70);
        return all >= 0 && all < 65536 ? static_cast<int>(all) : 0;
    }
    bool has(int code) const { return numbers.count(code) > 0; }
};

/// Of entities by their types: "2 INSERT, 1 SPLINE".
std::string countedText(const std::map<std::string, std::size_t>& counts);

/// Advice for an entity type that is not read: "explode the block"; "" for most.
std::string_view dxfRemedy(std::string_view type);

/// A unit of the header's $INSUNITS in metres; nothing where it has none.
std::optional<double> dxfUnit(std::string_view insunits);

}  // namespace talus::formats::mesh
