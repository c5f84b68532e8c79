#pragma once
// Kinematic analysis of a slope: planes from a table or a scenario, their sets, and which can slide or
// topple.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cli/common.h"
#include "cli/json_fwd.h"
#include "report/net.h"
#include "talus/formats/poles.h"
#include "talus/formats/scenario.h"
#include "talus/kinematics.h"
#include "talus/pole_statistics.h"

namespace talus::tools {

inline constexpr double kLateralDeg = 20;    ///< as Dips begins; 15 to 30 are in use [deg]
inline constexpr double kBiasLimitDeg = 15;  ///< of Terzaghi's weight, as Dips begins [deg]

/// Options of the analysis.
struct KinematicsQuestion {
    kinematics::Face face{};
    kinematics::Limits limits{};
    std::size_t find_sets = 0;           ///< number of sets to find; 0: those that are given
    std::optional<Vec3> scanline{};      ///< of all planes of a table
    std::optional<double> bias_limit{};  ///< of Terzaghi's weight [rad]
};

/// "70/135" as dip and dip direction [deg]; throws BadInput. \param option  in the message
std::pair<double, double> anglesOf(const std::string& option, const std::string& text, const char* what);

/// The unit vector of a trend and a plunge [deg]; throws BadInput where the plunge is beyond -90 and 90.
Vec3 scanlineOf(double trend, double plunge);

/// Whether a file is a table of poles by the ending of its name: .csv, .tsv, .txt, .dat. All else is a
/// scenario.
bool isPoleTable(std::string path);

/// Planes, by set.
struct PoleSource {
    std::vector<kinematics::Pole> poles{};
    std::vector<std::string> sets{};         ///< names
    std::string notation{};                  ///< of a table: the columns of the orientation
    std::string weighted_by{};               ///< "" where all planes weigh the same
    std::vector<std::string> passed_over{};  ///< titles of columns
    std::vector<std::string> warnings{};
    bool is_tilted = false;  ///< of a scenario: its planes were turned so that gravity points down
};

/// Throws BadInput where an option does not apply to a table.
PoleSource polesOf(const formats::PoleTable& table, const KinematicsQuestion& question);
/// One plane for each that cuts the rock mass. Throws BadInput, also where there is none.
PoleSource polesOf(const formats::Scenario& scenario, const KinematicsQuestion& question);

struct KinematicsAnswer {
    KinematicsQuestion question;
    PoleSource source;
    kinematics::Analysis analysis;
    std::vector<kinematics::FisherStatistics> sets;      ///< each plane counted once
    std::vector<kinematics::FisherStatistics> weighted;  ///< by weight; none where all weigh the same
};

KinematicsAnswer answerKinematics(PoleSource source, const KinematicsQuestion& question);

Json kinematicsJson(const KinematicsAnswer& answer, const Common& common, const std::string& file);
std::string kinematicsText(const KinematicsAnswer& answer);

/// Options of a picture.
struct NetPicture {
    Projection projection = Projection::equal_area;
    /// Lines with wedge sliding and direct toppling, else poles with planar sliding and flexural toppling.
    bool intersections = false;
    kinematics::Counting counting{};
    bool contours = true;
};

/// Words of NetPicture; the first of each is the default.
inline constexpr std::array kNetViews{"poles", "intersections"};
inline constexpr std::array kNetProjections{"equal-area", "equal-angle"};
inline constexpr std::array kNetContours{"fisher", "circle", "none"};
/// Throws BadInput for other words, and for an area that is not 0.1 to 20. \param counting_area  of the
/// hemisphere [%]
NetPicture netPicture(const std::string& view, const std::string& projection, const std::string& contours,
                      double counting_area);
std::string kinematicsSvg(const KinematicsAnswer& answer, const NetPicture& picture,
                          const std::string& title);

}  // namespace talus::tools
