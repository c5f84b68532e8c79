#include "mesh/plane_table.h"

#include <algorithm>
#include <cmath>

#include "files/number.h"
#include "mesh/plane_notation.h"
#include "talus/angles.h"
#include "talus/formats/csv.h"
#include "talus/fractures.h"
#include "talus/rock_mass.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using toml::numberText;

/// Two notations of one plane may differ by the rounding of both to whole degrees, not by more.
constexpr double kNotationsAgree = 2 * kDegree;

/// A column: its name here, its unit, its usual other names, and its range.
struct Column {
    std::string_view name, unit, other_titles;  ///< words of titleWord between blanks
    double least, most;
    bool open = false;  ///< more than `least`
};
constexpr std::array<Column, kPlaneColumns> kColumns{
    {{"dip", "_deg", " dipangle ", 0, 90},
     {"dip_direction", "_deg", " dipdir dipdirn dd dipazimuth dipaz dipdirectionazimuth ", -360, 360},
     {"strike", "_deg", " strikeright strikerhr strikerightrule strikerighthandrule rhr ", -360, 360},
     {"trend", "_deg", " poletrend trendofpole ", -360, 360},
     {"plunge", "_deg", " poleplunge plungeofpole ", 0, 90},
     {"nx", "", " normalx ", -1e6, 1e6},
     {"ny", "", " normaly ", -1e6, 1e6},
     {"nz", "", " normalz ", -1e6, 1e6},
     {"x", "_m", "", -1e6, 1e6},
     {"y", "_m", "", -1e6, 1e6},
     {"z", "_m", "", -1e6, 1e6},
     {"radius", "_m", "", 0, 1e6, true},
     {"diameter", "_m", "", 0, 2e6, true},
     {"trace", "_m", " tracelength lengthoftrace ", 0, 2e6, true},
     {"set", "", " setid setno setnumber setname jointset family ", 0, 0},
     {"spacing", "_m", " setspacing truespacing normalspacing ", 0, 1e6, true},
     {"weight", "", " weighting ", 0, 1e12, true},
     {"quantity", "", " qty ", 1, 10000},
     {"scanline_trend", "_deg", " traversetrend ", -360, 360},
     {"scanline_plunge", "_deg", " traverseplunge ", -90, 90},
     {"semi_major", "_m", " semimajoraxis halflength ", 0, 1e6, true},
     {"semi_minor", "_m", " semiminoraxis halfwidth ", 0, 1e6, true},
     {"rake", "_deg", " pitch rakeofmajoraxis ", -360, 360}}};

using enum PlaneColumn;
/// In order of preference.
const std::array<std::vector<PlaneColumn>, 4> kNotations{
    {{dip, dip_direction}, {strike, dip}, {trend, plunge}, {nx, ny, nz}}};

const Column& columnOf(PlaneColumn column) { return kColumns[static_cast<std::size_t>(column)]; }

std::string shown(PlaneColumn column) {
    return std::string(columnOf(column).name) + std::string(columnOf(column).unit);
}

std::string listed(const std::vector<PlaneColumn>& columns) {
    std::string list;
    for (const PlaneColumn column : columns) list += (list.empty() ? "" : ", ") + shown(column);
    return list;
}

std::optional<PlaneColumn> columnTitled(const std::string& title) {
    const std::string word = titleWord(title);
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
        if (word == titleWord(kColumns[k].name) ||
            (!word.empty() && kColumns[k].other_titles.find(" " + word + " ") != std::string_view::npos))
            return static_cast<PlaneColumn>(k);
    }
    return std::nullopt;
}

std::string rangeText(const Column& column) {
    return std::string("a number ") + (column.open ? "greater than " : "of at least ") +
           numberText(column.least) + " and at most " + numberText(column.most);
}

double turned(double azimuth) {
    const double rest = std::fmod(azimuth, 360);
    return rest < 0 ? rest + 360 : rest;
}

}  // namespace

PlaneTable::PlaneTable(const std::string& path, std::string_view text, std::vector<PlaneColumn> others)
    : path_(path), lines_(text), others_(std::move(others)) {}

void PlaneTable::fault(std::string message, std::optional<PlaneColumn> column) {
    Error error{"", std::move(message), path_, lines_.number(), 0};
    if (column && has(*column)) {
        const std::size_t cell = *cell_of_[static_cast<std::size_t>(*column)];
        if (cell < row_.size()) error.column = row_[cell].column;
    }
    faults_.push_back(std::move(error));
}

std::string PlaneTable::allowed(const std::vector<PlaneColumn>& required) const {
    std::string all = required.empty() ? "" : listed(required) + ", and ";
    for (std::size_t n = 0; n < kNotations.size(); ++n)
        all += (n == 0 ? "" : ", or ") + listed(kNotations[n]) + (n == 2 ? " of the pole" : "");
    for (const PlaneColumn column : others_) {
        if (std::count(required.begin(), required.end(), column) == 0)
            all += (column == others_.front() && required.empty() ? "; optional: " : ", ") + shown(column);
    }
    return all + ", each once; other columns are ignored";
}

bool PlaneTable::readHeader(const std::vector<PlaneColumn>& required) {
    if (!lines_.next()) {
        fault("found no header, allowed: " + allowed(required));
        return false;
    }
    separator_ = separatorOf(lines_.line());
    const auto titles = cellsOf(lines_.line(), separator_);
    width_ = titles.size();
    bool is_unique = true;
    for (std::size_t cell = 0; cell < titles.size(); ++cell) {
        const auto column = columnTitled(titles[cell].text);
        titles_.push_back(titles[cell].text);
        const bool is_read =
            column && (*column <= nz || std::count(others_.begin(), others_.end(), *column) > 0);
        if (!is_read) {
            if (!titles[cell].text.empty()) passed_over_.push_back(titles[cell].text);
            continue;
        }
        is_unique = is_unique && !has(*column);
        cell_of_[static_cast<std::size_t>(*column)] = cell;
    }
    const auto all_there = [&](const std::vector<PlaneColumn>& columns) {
        return std::all_of(columns.begin(), columns.end(), [&](PlaneColumn column) { return has(column); });
    };
    for (std::size_t n = 0; n < kNotations.size(); ++n)
        if (all_there(kNotations[n])) notations_.push_back(n);
    if (is_unique && !notations_.empty() && all_there(required)) return true;
    fault("found columns " + toml::quoted(withoutBlanks(lines_.line())) + ", allowed: " + allowed(required));
    return false;
}

bool PlaneTable::next() {
    while (faults_.size() < kMostFaults && lines_.next()) {
        row_ = cellsOf(lines_.line(), separator_);
        std::string wrong = rowFault(row_, width_, separator_, separator_ != ',');
        if (wrong.empty()) return true;
        row_.clear();
        fault(std::move(wrong));
    }
    return false;
}

std::string PlaneTable::text(PlaneColumn column) const {
    return row_[*cell_of_[static_cast<std::size_t>(column)]].text;
}

/// With a decimal comma where commas do not part the columns.
std::optional<double> PlaneTable::numberIn(std::string text) const {
    if (separator_ != ',') std::replace(text.begin(), text.end(), ',', '.');
    return numberOf(text);
}

std::optional<double> PlaneTable::number(PlaneColumn column) {
    const Column& what = columnOf(column);
    const auto number = numberIn(withoutDegreeSigns(text(column)));
    const bool is_allowed =
        number && *number <= what.most && (what.open ? *number > what.least : *number >= what.least);
    if (is_allowed) return number;
    fault("found " + std::string(what.name) + " " + toml::quoted(text(column)) +
              ", allowed: " + rangeText(what),
          column);
    return std::nullopt;
}

std::optional<Orientation> PlaneTable::byDipDirection() {
    const auto angle = number(dip), towards = number(dip_direction);
    if (!angle || !towards) return std::nullopt;
    return Orientation{*angle * kDegree, *towards * kDegree};
}

/// By the right-hand rule, the dip direction 90 degrees clockwise of the strike; or with the quadrant towards
/// which the plane dips.
std::optional<Orientation> PlaneTable::byStrike() {
    const auto quadrant = quadrantAzimuth(text(strike));
    const auto bearing = quadrant ? quadrant : number(strike);
    const auto with_side = quadrantDip(text(dip));
    if (!bearing) return std::nullopt;
    if (!with_side) {
        const auto angle = number(dip);
        if (angle && quadrant) {
            fault("found dip " + toml::quoted(text(dip)) + " with the strike " + toml::quoted(text(strike)) +
                      ", allowed: a dip with the side to which the plane dips, such as 45SE",
                  dip);
        }
        if (!angle || quadrant) return std::nullopt;
        return Orientation{*angle * kDegree, turned(*bearing + 90) * kDegree};
    }
    const auto angle = numberIn(with_side->number);
    const auto towards = dipDirectionTowards(*bearing, with_side->towards);
    if (angle && *angle >= 0 && *angle <= 90 && towards)
        return Orientation{*angle * kDegree, *towards * kDegree};
    fault("found dip " + toml::quoted(text(dip)) + " with the strike " + toml::quoted(text(strike)) +
              ", allowed: 0 to 90 with a side that is not the strike's own, such as 45SE with N45E",
          dip);
    return std::nullopt;
}

std::optional<Orientation> PlaneTable::byPole() {
    const auto towards = number(trend), down = number(plunge);
    if (!towards || !down) return std::nullopt;
    return Orientation{(90 - *down) * kDegree, turned(*towards + 180) * kDegree};
}

std::optional<Orientation> PlaneTable::byNormal() {
    const auto x = number(nx), y = number(ny), z = number(nz);
    if (!x || !y || !z) return std::nullopt;
    Vec3 normal(*x, *y, *z);
    if (normal.norm() == 0) {
        fault("found a normal of length 0, allowed: a direction, of any length", nx);
        return std::nullopt;
    }
    normal.normalize();
    const auto [angle, towards] = dipOf(normal.z() < 0 ? Vec3(-normal) : normal);
    return Orientation{angle, towards};
}

std::optional<Orientation> PlaneTable::byNotation(std::size_t notation) {
    if (notation == 0) return byDipDirection();
    if (notation == 1) return byStrike();
    return notation == 2 ? byPole() : byNormal();
}

std::optional<Orientation> PlaneTable::orientation() {
    const auto plane = byNotation(notations_.front());
    if (!plane) return std::nullopt;
    const Vec3 normal = upwardNormal(plane->dip, plane->dip_direction);
    for (std::size_t k = 1; k < notations_.size(); ++k) {
        const auto other = byNotation(notations_[k]);
        if (!other) return std::nullopt;
        if (normal.cross(upwardNormal(other->dip, other->dip_direction)).norm() <= std::sin(kNotationsAgree))
            continue;
        fault("found a plane by " + listed(kNotations[notations_[k]]) + " that differs from the one by " +
                  listed(kNotations[notations_.front()]) + ", allowed: the same plane within 2 degrees",
              kNotations[notations_[k]].front());
        return std::nullopt;
    }
    return plane;
}

std::string PlaneTable::notation() const { return listed(kNotations[notations_.front()]); }

}  // namespace talus::formats
