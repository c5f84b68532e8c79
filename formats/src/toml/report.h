#pragma once
// Collects every fault found while a scenario is read, and the place of every field.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "toml/document.h"
#include "toml/questions.h"

namespace talus::formats::toml {

class Report {
 public:
    explicit Report(std::string path) : path_(std::move(path)) {}

    void add(Place place, std::string field, std::string message);

    /// Values that are allowed but probably not intended.
    void warn(std::string message);
    std::vector<std::string> takeWarnings() { return std::move(warnings_); }

    /// So many faults that further ones are only counted; callers may skip costly suggestions.
    bool full() const;
    bool clean() const { return count_ == 0; }
    std::size_t count() const { return count_; }

    /// The first faults in the order of the file, and a last entry that counts the others, if any.
    std::vector<Error> errors() const;

    /// Where a field stands, else the nearest table around it.
    std::optional<Place> placeOf(std::string field) const;

    void mark(const std::string& field, Place place) { places_[field] = {place.line, place.column}; }
    std::map<std::string, std::pair<int, int>> takePlaces() { return std::move(places_); }

    /// Record of the readers' queries; null unless wanted.
    void listen(Questions* questions) { questions_ = questions; }
    Questions* questions() const { return questions_; }

 private:
    std::string path_;
    std::vector<Error> errors_;
    std::size_t count_ = 0;
    std::vector<std::string> warnings_;
    std::map<std::string, std::pair<int, int>> places_;
    Questions* questions_ = nullptr;
};

}  // namespace talus::formats::toml
