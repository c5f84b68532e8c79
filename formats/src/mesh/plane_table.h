#pragma once
// Tables of planes made with spreadsheets: columns by any usual name, and the contents of a row. Fractures
// and poles are read with it.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/csv_line.h"
#include "talus/result.h"

namespace talus::formats {

enum class PlaneColumn : std::uint8_t {
    dip,
    dip_direction,
    strike,
    trend,
    plunge,
    nx,
    ny,
    nz,
    x,
    y,
    z,
    radius,
    diameter,
    trace,
    set,
    spacing,
    weight,
    quantity,
    scanline_trend,
    scanline_plunge,
    semi_major,
    semi_minor,
    rake
};
inline constexpr std::size_t kPlaneColumns = 23;

struct Orientation {
    double dip = 0, dip_direction = 0;  ///< [rad]
};

/// Rows of such a table. Faults are collected, up to kMostFaults; reading continues with the next row.
class PlaneTable {
 public:
    static constexpr std::size_t kMostFaults = 20;

    /// \param others  columns that are read besides the orientation; the rest are passed over
    PlaneTable(const std::string& path, std::string_view text, std::vector<PlaneColumn> others);

    /// Reads the header. False: a fault, no way to read on. \param required  columns without which the table
    /// means nothing
    bool readHeader(const std::vector<PlaneColumn>& required);
    /// Goes to the next row of the right length; false at the end, or when there are too many faults.
    bool next();

    bool has(PlaneColumn column) const { return cell_of_[static_cast<std::size_t>(column)].has_value(); }
    /// A number of the row within what the column may hold; else a fault.
    std::optional<double> number(PlaneColumn column);
    std::string text(PlaneColumn column) const;
    /// The row's plane, by the first notation the table has; a fault where another one tells another plane.
    std::optional<Orientation> orientation();

    void fault(std::string message, std::optional<PlaneColumn> column = std::nullopt);
    const std::vector<Error>& faults() const { return faults_; }
    /// As the header has them, of the orientation: "dip_deg, dip_direction_deg".
    std::string notation() const;
    const std::vector<std::string>& passedOver() const { return passed_over_; }

 private:
    using Places = std::array<std::optional<std::size_t>, kPlaneColumns>;

    std::optional<double> numberIn(std::string text) const;
    std::optional<Orientation> byDipDirection();
    std::optional<Orientation> byStrike();
    std::optional<Orientation> byPole();
    std::optional<Orientation> byNormal();
    std::optional<Orientation> byNotation(std::size_t notation);
    std::string allowed(const std::vector<PlaneColumn>& required) const;

    std::string path_;
    CsvLines lines_;
    std::vector<PlaneColumn> others_;
    char separator_ = ',';
    std::size_t width_ = 0;                 ///< cells of a row
    Places cell_of_{};                      ///< of each column, where the table has it
    std::vector<std::string> titles_{};     ///< of the cells
    std::vector<std::size_t> notations_{};  ///< complete ones
    std::vector<std::string> passed_over_{};
    std::vector<CsvCell> row_{};
    std::vector<Error> faults_{};
};

}  // namespace talus::formats
