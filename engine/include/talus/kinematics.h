#pragma once
// Kinematic tests of a rock slope: which planes and lines of intersection can slide or topple out of a face.
//
// A plane is its unit normal that points upwards. A line is a unit vector that points downwards, as lines and
// poles plot on the lower hemisphere. A plane's pole is minus its normal. x is east, y north, z up; angles
// are in rad.
//
// Each test is a margin [rad]: the smallest of the angles by which its conditions are met. A plane or line is
// critical where the margin is positive. Pictures shade the same margins, so that a zone on the net and the
// counts cannot differ.
//
// Sources: Markland (1972) and Hocking (1976) for sliding; Goodman and Bray (1976) and Goodman (1980) for
// flexural toppling; Hudson and Harrison (1997), chapter 18, for direct toppling. The zones are those of Dips
// (Rocscience).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "talus/model.h"
#include "talus/polyhedron.h"
#include "talus/result.h"

namespace talus::kinematics {

/// Angles that differ by less are the same [rad]: some 6e-8 degrees. It is far above the rounding of a change
/// of notation (1e-15) and far below the resolution of a compass (0.01). So a plane on a limit has the same
/// result in every notation.
inline constexpr double kSameAngle = 1e-9;
/// Planes at a smaller angle are parallel and have no line of intersection [rad]: 6e-5 degrees, below every
/// survey.
inline constexpr double kParallel = 1e-6;

/// A plane's upward normal in the east, north and up of the untilted model; these axes tilt with the model.
/// With gravity along -z it is the same.
Vec3 normalUnderGravity(const Vec3& normal, const Gravity& gravity);

/// The rock face.
struct Face {
    double dip = 0;            ///< 0..pi/2, more than 0 [rad]
    double dip_direction = 0;  ///< clockwise from +y [rad]
};

struct Limits {
    double friction = 0;  ///< of all planes, 0..pi/2 [rad]
    double lateral = 0;   ///< to each side of the face's dip direction, 0..pi/2 [rad]
};

/// Dip and plunge [rad] without the loss of digits that arc sine and cosine have near 90 and 0 degrees.
double dipOfPlane(const Vec3& normal);
double plungeOf(const Vec3& line);
/// Clockwise from +y, 0..2 pi [rad]; 0 of a vertical line.
double trendOf(const Vec3& line);

/// The steepest line down a plane; nothing of a horizontal plane.
std::optional<Vec3> dipVector(const Vec3& normal);
/// The line in which two planes meet; nothing of parallel planes.
std::optional<Vec3> intersection(const Vec3& normal_a, const Vec3& normal_b);

/// The angle by which a line comes out of the face, negative into it [rad]: asin(line . n), n the face's
/// upward normal. It is positive exactly where tan(plunge) < tan(dip of the face) cos(trend - dip direction),
/// the daylight envelope.
double daylight(const Vec3& line, const Face& face);

/// Planar sliding: the plane dips more steeply than friction, its dip vector daylights, and its dip direction
/// lies within the lateral limits (these included) of the face's.
double planarMargin(const Vec3& normal, const Face& face, const Limits& limits);

/// Wedge sliding on a line of intersection, without lateral limits. Primary zone: the line daylights and
/// plunges more steeply than friction.
double wedgeMargin(const Vec3& line, const Face& face, double friction);
/// Secondary zone: the line daylights and plunges less steeply than friction. It is steeper than the apparent
/// dip, along its trend, of a plane that dips at the friction angle in the face's dip direction. The wedge
/// can slide on one of its planes.
double secondaryWedgeMargin(const Vec3& line, const Face& face, double friction);

/// The planes on which a wedge slides, by the dip vectors alone.
enum class SlidesOn : std::uint8_t {
    both,   ///< along the line of intersection
    first,  ///< down the first plane's dip vector, which leads away from the second plane
    second
};
/// s_A is A's dip vector and n_B is B's upward normal: the wedge slides on A alone where s_A . n_B > 0, since
/// it then leaves B: tan(dip B) cos(angle between the dip directions) > tan(dip A). That cannot hold for both
/// planes. The wedge may lie on either side of a vertical plane; the side on which it leaves that plane
/// counts.
SlidesOn slidesOn(const Vec3& normal_a, const Vec3& normal_b);

/// Direct toppling: the line plunges more steeply than 90 degrees minus the face's dip. It dips into the
/// face, with its trend within the lateral limits (these included) of the opposite of the face's dip
/// direction. A vertical line counts as within the lateral limits. The same of a plane's pole: a base plane
/// that dips out of the face, less steeply than it.
double directTopplingMargin(const Vec3& line, const Face& face, const Limits& limits);
/// Oblique toppling: a line outside the lateral limits that dips into the face within 90 degrees and lies
/// within the friction angle of the vertical, and within the face's dip.
double obliqueTopplingMargin(const Vec3& line, const Face& face, const Limits& limits);

/// Flexural toppling of layers: the pole lies outside the slip limit and within the lateral limits (these
/// included). The slip limit is a plane in the face's dip direction that dips at the face's dip minus
/// friction. In the face's dip direction: (90 - dip) + friction < dip of the face. A vertical plane has two
/// poles; see flexuralToppling.
double flexuralTopplingMargin(const Vec3& pole, const Face& face, const Limits& limits);

bool planarSliding(const Vec3& normal, const Face& face, const Limits& limits);
bool flexuralToppling(const Vec3& normal, const Face& face, const Limits& limits);
enum class WedgeZone : std::uint8_t { none, primary, secondary };
WedgeZone wedgeZone(const Vec3& line, const Face& face, double friction);
enum class TopplingZone : std::uint8_t { none, direct, oblique };
TopplingZone topplingZone(const Vec3& line, const Face& face, const Limits& limits);

/// A measured plane.
struct Pole {
    Vec3 normal = Vec3::UnitZ();  ///< upwards
    double weight = 1;            ///< of the plane, greater than 0
    std::size_t set = 0;
};

/// How many of all are critical, and the same by weight. A pair weighs the product of its planes' weights.
struct Share {
    std::size_t critical = 0, total = 0;
    double critical_weight = 0, total_weight = 0;

    double percent() const;  ///< of the count; 0 of nothing
    double weightedPercent() const;
    void count(bool is_critical, double weight);
    void add(const Share& other);
};

/// Tests of planes.
struct PlaneShares {
    Share planar, planar_without_limits, flexural;
    Share base;                    ///< planes that can be the base of toppling blocks, directly or obliquely
    std::size_t sliding_base = 0;  ///< of these critical ones: steeper than friction
};

/// Tests of lines of intersection.
struct LineShares {
    Share wedge;  ///< both zones
    std::size_t primary = 0, secondary = 0;
    std::size_t on_one_plane = 0;  ///< of the critical ones: slide on one plane alone
    /// of the critical ones, all in the secondary zone: the line or the one plane they would slide on is no
    /// steeper than friction
    std::size_t held_by_friction = 0;
    Share direct, oblique;
    std::size_t parallel = 0;  ///< pairs without a line
};

/// Lines between the planes of two sets, or within one.
struct SetPair {
    std::size_t a = 0, b = 0;  ///< a <= b
    LineShares lines;
};

struct Analysis {
    PlaneShares planes;
    LineShares lines;
    std::vector<PlaneShares> sets;  ///< by set
    std::vector<SetPair> pairs;     ///< of all sets, (0, 0), (0, 1), ...
};

/// Pairs grow with the square of the planes: so many take a minute.
inline constexpr std::size_t kMostPoles = 20'000;

/// Tests all planes and all lines of intersection of two of them. Errors: no poles or more than kMostPoles; a
/// set beyond `sets`; a face or limits out of range; a weight that is not positive.
Result<Analysis> analyse(const std::vector<Pole>& poles, std::size_t sets, const Face& face,
                         const Limits& limits);

}  // namespace talus::kinematics
