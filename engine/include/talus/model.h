#pragma once
// The description of a slope: what a scenario file says, in SI units and radians, before anything is
// computed. The analyses (analysis.h) and time histories (simulation.h) build the state that moves out of it.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "talus/flow_data.h"
#include "talus/joint.h"
#include "talus/level_point.h"
#include "talus/polyhedron.h"
#include "talus/result.h"
#include "talus/surface.h"

namespace talus {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class Motion : std::uint8_t { free, fixed, driven };

struct Block {
    std::string name;
    Polyhedron shape;    ///< in the model frame
    double density = 0;  ///< [kg/m^3]
    Motion motion = Motion::free;
    std::int32_t material = 0;             ///< index of the scenario's material, for changes of its density
    Vec3 velocity = Vec3::Zero();          ///< initial; kept when driven [m/s]
    std::vector<std::int32_t> face_joint;  ///< one joint index per face of the shape
    std::string field{};  ///< its entry in the scenario ("stack[0]", "block[2]"), for messages
    Vec3 angular_velocity = Vec3::Zero();  ///< initial, about its centroid; of free blocks [rad/s]
};

/// Joint of one pair of blocks, in place of the rule (of the two faces' joints the one with less friction,
/// the one declared first on ties).
struct PairJoint {
    std::int32_t block_a = 0;
    std::int32_t block_b = 0;
    std::int32_t joint = 0;
    /// an error if the two blocks share no interface at the start (written by hand)
    bool must_touch = false;
    std::string field{};
    std::int32_t face_a = -1, face_b = -1;  ///< of these two faces only; -1: wherever the blocks touch
};

/// One wall that bounds a fissure: a face of a block.
struct WetFace {
    std::int32_t block = 0;
    std::int32_t face = 0;
};

/// Water in one fissure. Hydrostatic below a horizontal table: p = rho_w g * (depth below the table along
/// gravity).
struct Water {
    enum class Level : std::uint8_t {
        depth,      ///< up along the joint plane's steepest line from its lowest wet point
        elevation,  ///< along -g above the model's origin
        head        ///< two heads at the ends of one interface, linear between: p = rho_w g cos(tilt) head
    };
    Level kind = Level::depth;
    /// depth or elevation over time; one entry when constant; empty for `head`
    std::vector<LevelPoint> level;
    /// at the patch's +x and its -x end (+z and -z for patches normal to x) [m]
    std::array<double, 2> head{};
    double density = 1000;  ///< [kg/m^3]
    /// [m]; the fissure is empty for good once an interface opens wider
    double drains_at_aperture = kInfinity;
    /// What the pressure falls to where the joint's lowest end lies open, after E. Hoek and J. W. Bray.
    enum class Daylight : std::uint8_t {
        closed,  ///< nothing: hydrostatic to the lowest end
        /// from what it is at the joint's upper end in a straight line to nothing (below a crack full of
        /// water)
        straight,
        half_height,  ///< hydrostatic down to half the wet height, from there in a straight line to nothing
    };
    Daylight daylight = Daylight::closed;
    double base = -kInfinity;    ///< no water below this z of the model at the start (perched water) [m]
    std::vector<WetFace> walls;  ///< the faces it pushes on; empty when `pair` is given
    /// of a fissure that ends in its plane: corners of a convex polygon in order, in the model as built [m];
    /// walls are dry beyond it. Empty: the fissure is as large as its walls.
    std::vector<Vec3> outline{};
    /// In a joint of a rock mass: depths, heads and falling pressures count from the ends of the part that
    /// bounds free or driven blocks. The depth of the cut into fixed rock then changes nothing.
    bool ends_at_free_blocks = false;
    bool is_share = false;  ///< its level was given as a share of its joint's height
    /// instead: the interface of two blocks, both walls
    std::optional<std::pair<std::int32_t, std::int32_t>> pair;
    /// In time histories the level follows from the volume that the walls enclose
    /// (forces/closed_water.h); searches hold it as filled.
    bool closed = false;
    double opening = 0;  ///< closed: width of the fissure while its walls stand as built [m]
    /// closed: inflow over time [m^3/s per m of the fissure's horizontal width]; empty: none
    std::vector<LevelPoint> inflow{};
    /// closed: depth or elevation, as the level is given, above which it runs over [m]; infinite: it runs
    /// over where its walls end
    double overflow = kInfinity;
    std::vector<LevelPoint> rain{};  ///< closed: on its catchment over time [m/s]; empty: no rain
    double catchment = 0;            ///< closed: slope that drains into it, per m of its horizontal width [m]
    /// closed: hydraulic aperture through which its foot leaks, while the walls stand as built [m]; 0: tight
    double leak_aperture = 0;
    double leak_length = 0;  ///< closed: of the leak, from the foot to where the water leaves the rock [m]
    std::string field{};     ///< "water[0]", for messages
};

/// The water table of a slope: a line over x, extruded along y, or an open surface. Every face below it, of
/// joints and free ones (ponded water), feels the pressure of the depth below it along gravity, times
/// `factor`. It does not move. Where another water of the model wets a wall, that water's pressure acts
/// instead.
struct PhreaticSurface {
    struct Point {
        double x = 0, z = 0;  ///< [m]
    };
    std::vector<Point> line;  ///< x rising; level beyond its ends
    TriangleSurface mesh{};   ///< instead: over all free blocks, looking up
    double factor = 1;        ///< of the head (Hu)
    double density = 1000;    ///< [kg/m^3]
    /// [m]; the two faces of a joint are dry for good once it opens wider
    double drains_at_aperture = kInfinity;
    std::string field{};  ///< "water[0]", for messages
};

/// Where contact points lie on a patch, and which area each stands for.
struct PointRule {
    /// distributed: as vertex, but each point carries the pressure of its share of the closed part of the
    /// patch
    enum class Kind : std::uint8_t { vertex, distributed, quarter, corner, grid };
    Kind kind = Kind::vertex;
    int grid = 0;  ///< N of `grid N`
};

struct Gravity {
    double magnitude = 9.81;  ///< [m/s^2]
    double tilt = 0;          ///< about y, positive: downhill is -x [rad]
    /// which way it pulls before it is tilted, of any length; default -z
    std::optional<Vec3> direction{};
};

/// A pseudo-static earthquake: each free block feels these shares of its weight; water stays as it is.
struct Seismic {
    double horizontal = 0;                ///< k_h; a search for the critical one starts from it
    double azimuth = 4.7123889803846897;  ///< the way it pushes, clockwise from +y [rad]
    double vertical = 0;                  ///< k_v, against gravity
};

/// A force at a point of a block, or a pressure: on one face, or on all free face area in a box with normals
/// within 60 degrees of a direction. It keeps the direction it has at the start and follows its point.
struct AppliedLoad {
    enum class Kind : std::uint8_t { force, face, box };
    Kind kind = Kind::force;
    std::int32_t block = 0;          ///< of `force` and `face`
    Vec3 force = Vec3::Zero();       ///< of `force` [N]
    std::optional<Vec3> point{};     ///< of `force`, at the start; default the block's centroid [m]
    Vec3 direction = Vec3::UnitZ();  ///< which way the faces look
    double pressure = 0;             ///< on them [Pa]
    Vec3 box_min = Vec3::Zero(), box_max = Vec3::Zero();  ///< [m]
    std::vector<LevelPoint> factor{};                     ///< over time; empty: 1
    std::string field{};                                  ///< "load[0]", for messages
};

/// A bar between two places. Free between head and end, it ties the blocks that these lie in. Bonded over its
/// length, it ties all blocks it crosses.
struct Bolt {
    std::string name;
    Vec3 head = Vec3::Zero(), end = Vec3::Zero();  ///< at the start [m]
    bool grouted = false;
    bool plate = false;      ///< grouted: held at its head by a plate
    double area = 0;         ///< [m^2]
    double modulus = 0;      ///< [Pa]
    double yield_force = 0;  ///< beyond it the force stays [N]
    double pretension = 0;   ///< [N]
    double rupture_strain = kInfinity;
    double bond_stiffness = 0;   ///< grouted [N/m per m]
    double bond_strength = 0;    ///< grouted [N/m]
    double shear_stiffness = 0;  ///< grouted, of each joint it crosses [N/m]
    bool must_hold = true;       ///< one that ties no blocks is an error
    std::string field{};         ///< "bolt[0]", for messages
};

/// Bolts of one kind on a face.
struct BoltPattern {
    Bolt like;                                            ///< without head and end
    Vec3 box_min = Vec3::Zero(), box_max = Vec3::Zero();  ///< of the heads [m]
    Vec3 direction = Vec3::UnitX();                       ///< which way the faces look
    double spacing_along = 0, spacing_up = 0;             ///< on the face [m]
    double length = 0;                                    ///< [m]
    double plunge = 0, trend = 0;  ///< of the bolts: below the horizontal; clockwise from +y [rad]
};

/// A recorded motion of all fixed blocks. Motion is computed against them: free blocks feel the opposite of
/// its acceleration.
struct GroundMotion {
    std::vector<double> time;        ///< [s]; where two are equal the acceleration jumps
    std::vector<Vec3> acceleration;  ///< linear between, none outside [m/s^2]

    bool empty() const { return time.empty(); }
};

/// Damping terms of eqs (3)-(4), and Cundall's local damping.
struct Damping {
    double mass = 0;      ///< c_m = mass * m [1/s]
    double rotation = 0;  ///< c_I = rotation * I [1/s]
    double contact = 0;   ///< c_k = contact * k of the contact point [s]
    double local = 0;     ///< share of the out-of-balance force that opposes the motion, 0..1
    /// contact points have the restitution of their joints; set in the build where a joint has one below 1
    bool restitution = false;
};

struct AnalysisSettings {
    std::optional<double> start;  ///< critical-angle: where the search starts; default gravity.tilt [rad]
    double stop = 0.78539816339744831;         ///< [rad]
    double tolerance = 1.7453292519943296e-4;  ///< width of the bracket [rad]
    double factor_tolerance = 0.001;           ///< width of the bracket of a factor of safety
    double acceleration_tolerance = 1e-4;      ///< width of the bracket of a seismic coefficient
    /// of the free blocks' mass: a failure of less is removed, and the search continues; 0: any failure is
    /// the answer
    double least_mass_share = 0;
    /// Neighbours that part by more have failed: share of the median block size.
    double failure_displacement = 3e-4;
    bool reduce_tensile_strength = false;  ///< all joints are Joint::tension_reduced
    bool time_scaling = true;              ///< inertia scaling in quasi-static work
};

struct RunSettings {
    double duration = 1.0;            ///< [s]
    std::optional<double> time_step;  ///< default: from the stability bound [s]
    double frame_interval = 0.01;     ///< [s]
    enum class Start : std::uint8_t {
        equilibrium,  ///< weight and water act from time 0, in equilibrium where there is one
        unstressed    ///< they are applied at once
    };
    Start start = Start::equilibrium;
    std::vector<std::string> watch;  ///< names of blocks to report
};

/// Data of a regular stack for the closed formulas (theory.h); present when the model is one stack only.
struct StackShape {
    int columns = 0, rows = 0, slices = 0;
    Vec3 block = Vec3::Zero();   ///< [m]
    Vec3 origin = Vec3::Zero();  ///< [m]
    bool running = false;        ///< running bond
    std::vector<int> heights;    ///< rows per column
};

struct Model {
    std::vector<Joint> joints;
    std::vector<Block> blocks;
    std::vector<PairJoint> pair_joints;
    std::vector<Water> waters;
    std::optional<PhreaticSurface> phreatic;
    std::optional<Flow> flow{};
    std::vector<AppliedLoad> loads;
    std::vector<Bolt> bolts;
    std::vector<BoltPattern> bolt_patterns;  ///< their bolts stand among the others (talus/bolts.h)
    PointRule points;
    Gravity gravity;
    Seismic seismic;
    GroundMotion ground_motion;
    Damping damping;
    AnalysisSettings analysis;
    RunSettings run;
    std::optional<StackShape> stack;
    bool is_remainder = false;  ///< blocks were removed: their loads and bolts may have nothing to act on

    bool hasWater() const { return !waters.empty() || phreatic || flow; }
    /// Whether anything acts beside weight, earthquake, contacts and the waters of the list.
    bool hasOtherForces() const { return phreatic || flow || !loads.empty() || !bolts.empty(); }
};

}  // namespace talus
