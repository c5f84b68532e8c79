#include "mesh/traces.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "files/number.h"
#include "mesh/dxf.h"
#include "mesh/mend_notes.h"
#include "talus/angles.h"
#include "talus/rock_mass.h"
#include "toml/file_text.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using toml::numberText;

/// Of the length: with less relief, an error of drawing of a hundredth of it turns the plane by 10 degrees.
constexpr double kLeastRelief = 0.05;
/// Of the relief: points farther off the plane than that span no plane.
constexpr double kMostOffPlane = 0.3;
/// Between a trace and the stated plane: a trace of another set.
constexpr double kMostAcross = 30 * kDegree;
constexpr std::size_t kMostFaults = 20;
constexpr double kFarthest = 1e6;  ///< as of tables of discs [m]
constexpr std::string_view kBinary = "AutoCAD Binary DXF";
constexpr int kClosed = 1, kCurveFit = 2, kSplineFit = 4, kInSpace = 8, kPolygonMesh = 16, kPolyface = 64;

struct Trace {
    std::string type, layer = "0";
    int line = 0;
    int flags = 0;
    bool in_plan = false;  ///< drawn in a plane of the drawing, which is not that of the joint
    bool has_bulge = false, is_tilted = false;
    double elevation = 0;
    std::vector<Vec3> points{};

    /// "the POLYLINE on layer "J1" from (1, 2, 3)"
    std::string words() const {
        std::string text = "the " + type + " on layer " + toml::quoted(layer);
        return points.empty() ? text : text + " from " + mesh::placeText(points.front());
    }
};

/// Traces as the file has them; faults of single ones are told later.
class TraceReader {
 public:
    TraceReader(const std::string& text, std::string path) : pairs_(text), path_(std::move(path)) {}

    std::vector<Error> read() {
        std::string section;
        bool more = pairs_.next();
        while (more && !pairs_.is(0, "EOF") && errors_.empty()) {
            if (pairs_.is(0, "SECTION")) {
                more = pairs_.next();
                section = more && pairs_.code() == 2 ? pairs_.value() : "";
                if (more) more = pairs_.next();
            } else if (section == "ENTITIES" && pairs_.code() == 0 && !pairs_.is(0, "ENDSEC")) {
                more = readEntity();
            } else {
                if (section == "HEADER") readUnit();
                more = pairs_.next();
            }
        }
        if (pairs_.isFaulty())
            fault(pairs_.line(), "found " + toml::quoted(pairs_.value()) +
                                     " in place of a group code, allowed: DXF as text, pairs of lines with a "
                                     "whole number and its value");
        else if (!more && errors_.empty())
            fault(pairs_.line(), "found the end of the file without EOF, allowed: a whole file");
        endPolyline();
        return std::move(errors_);
    }

    std::vector<Trace> take() { return std::move(traces_); }
    std::optional<double> unit() const { return unit_; }  ///< of the header [m]

    /// How many entities of each type were not read, on one layer or on all.
    std::map<std::string, std::size_t> leftOut(const std::optional<std::string>& layer) const {
        std::map<std::string, std::size_t> counts;
        for (const auto& [entity, count] : left_out_)
            if (!layer || entity.first == *layer) counts[entity.second] += count;
        return counts;
    }

 private:
    void fault(int line, std::string message) { errors_.push_back({"", std::move(message), path_, line, 0}); }

    /// Of the header: the name of a variable, then its value.
    void readUnit() {
        if (pairs_.code() == 9) is_unit_ = pairs_.value() == "$INSUNITS";
        if (is_unit_ && pairs_.code() == 70) unit_ = mesh::dxfUnit(pairs_.value());
    }

    bool readEntity() {
        Trace entity{std::string(pairs_.value())};
        entity.line = pairs_.line();
        entity.in_plan = entity.type == "LWPOLYLINE";
        const bool is_line = entity.type == "LINE" || entity.in_plan;
        const bool is_taken = is_line || entity.type == "POLYLINE" || entity.type == "VERTEX";
        bool more = false;
        while ((more = pairs_.next()) && pairs_.code() != 0) {
            if (pairs_.code() == 8) entity.layer = pairs_.value();
            if (is_taken && !readPair(entity)) return false;
        }
        for (Vec3& point : entity.points)
            if (entity.in_plan) point.z() = entity.elevation;
        finish(std::move(entity), is_line);
        return more;
    }

    /// Groups 10 and 11 begin a point; of a POLYLINE itself they hold nothing.
    bool readPair(Trace& entity) {
        const int code = pairs_.code();
        const bool is_place =
            (code >= 10 && code <= 11) || (code >= 20 && code <= 21) || (code >= 30 && code <= 31);
        if (!is_place && code != 38 && code != 42 && code != 70 && code != 230) return true;
        const auto number = numberOf(pairs_.value());
        if (!number || std::abs(*number) > kFarthest) {
            fault(pairs_.line(), "found " + toml::quoted(pairs_.value()) + " for group code " +
                                     std::to_string(code) + " of " + entity.type +
                                     ", allowed: a number up to " + numberText(kFarthest));
            return false;
        }
        if (code / 10 == 1) entity.points.push_back(Vec3(*number, 0, 0));
        if (code / 10 == 2 && !entity.points.empty()) entity.points.back().y() = *number;
        if (code / 10 == 3 && is_place && !entity.points.empty()) entity.points.back().z() = *number;
        if (code == 38) entity.elevation = *number;
        if (code == 42) entity.has_bulge = entity.has_bulge || *number != 0;
        if (code == 70) entity.flags = static_cast<int>(std::clamp(*number, 0.0, 65535.0));
        if (code == 230) entity.is_tilted = *number != 1;
        return true;
    }

    void finish(Trace entity, bool is_line) {
        if (entity.type == "VERTEX") {
            if (!polyline_) return;
            polyline_->points.insert(polyline_->points.end(), entity.points.begin(), entity.points.end());
            polyline_->has_bulge = polyline_->has_bulge || entity.has_bulge;
            return;
        }
        endPolyline();
        if (entity.type == "POLYLINE" && (entity.flags & (kPolygonMesh | kPolyface)) == 0) {
            entity.points.clear();
            polyline_ = std::move(entity);
        } else if (is_line) {
            traces_.push_back(std::move(entity));
        } else if (entity.type != "SEQEND") {
            ++left_out_[{entity.layer, entity.type == "POLYLINE" ? "POLYLINE mesh" : entity.type}];
        }
    }

    void endPolyline() {
        if (!polyline_) return;
        const auto& points = polyline_->points;
        polyline_->in_plan = (polyline_->flags & kInSpace) == 0 &&
                             std::all_of(points.begin(), points.end(),
                                         [&](const Vec3& p) { return p.z() == points.front().z(); });
        traces_.push_back(*std::move(polyline_));
        polyline_.reset();
    }

    mesh::DxfPairs pairs_;
    std::string path_;
    std::vector<Trace> traces_;
    std::optional<Trace> polyline_;                                        ///< whose vertices are read
    std::map<std::pair<std::string, std::string>, std::size_t> left_out_;  ///< by layer and type
    bool is_unit_ = false;  ///< the header's variable is $INSUNITS
    std::optional<double> unit_;
    std::vector<Error> errors_;
};

/// What keeps a line from being a trace; empty: nothing.
std::string shapeFault(const Trace& trace) {
    if (trace.has_bulge || (trace.flags & (kCurveFit | kSplineFit)) != 0)
        return "found " + trace.words() + " with arcs or a spline, allowed: straight pieces between points";
    if (trace.in_plan && trace.is_tilted)
        return "found " + trace.words() + " drawn in a tilted plane, allowed: a 3D POLYLINE";
    if ((trace.flags & kClosed) != 0)
        return "found " + trace.words() + ", which is closed, allowed: an open line with two ends";
    return "";
}

/// The plane through the ends that is nearest to the stated one; nothing where they lie across it.
std::optional<Vec3> normalThrough(const Vec3& along, const Orientation& stated) {
    const Vec3 normal = upwardNormal(stated.dip, stated.dip_direction);
    const double across = along.dot(normal);
    if (std::abs(across) > std::sin(kMostAcross)) return std::nullopt;
    const Vec3 nearest = (normal - across * along).normalized();
    return nearest.z() < 0 ? Vec3(-nearest) : nearest;
}

std::string reliefText(const Trace& trace, const TracePlane& plane) {
    if (trace.in_plan)
        return "found " + trace.words() + ", whose points all lie in the plane it was drawn in";
    if (plane.relief < kLeastRelief * plane.length)
        return "found " + trace.words() + " with a relief of " + mesh::shortText(plane.relief, 2) +
               " m over " + mesh::shortText(plane.length, 3) + " m, too straight to define a plane";
    return "found " + trace.words() + ", whose points lie up to " + mesh::shortText(plane.off_plane, 2) +
           " m off their plane";
}

/// The normal of the trace's joint, or what is wrong with the trace.
Result<Vec3> normalOf(const Trace& trace, const TracePlane& plane, const TraceOptions& options) {
    const bool defines_plane = !trace.in_plan && plane.relief >= kLeastRelief * plane.length &&
                               plane.off_plane <= kMostOffPlane * plane.relief;
    if (defines_plane) return plane.normal;
    if (!options.orientation)
        return Error{"", reliefText(trace, plane) + ", allowed: a trace with a relief of at least " +
                             numberText(kLeastRelief) +
                             " of its length in one plane, or dip_deg and dip_direction_deg of the set"};
    const Vec3 along = (trace.points.back() - trace.points.front()).normalized();
    if (const auto normal = normalThrough(along, *options.orientation)) return *normal;
    return Error{"", "found " + trace.words() +
                         ", which lies across the plane of dip_deg and "
                         "dip_direction_deg, allowed: traces within " +
                         numberText(kMostAcross / kDegree) + " degrees of it"};
}

Result<Fracture> discOf(const Trace& trace, const TraceOptions& options) {
    if (std::string fault = shapeFault(trace); !fault.empty()) return Error{"", std::move(fault)};
    if (trace.points.size() < 2 || (trace.points.back() - trace.points.front()).norm() == 0)
        return Error{"", "found " + trace.words() + " without two different ends, allowed: an open line"};
    const TracePlane plane = planeOfTrace(trace.points);
    const auto normal = normalOf(trace, plane, options);
    if (!normal) return normal.errors();
    const auto [dip, dip_direction] = dipOf(*normal);
    Fracture disc;
    disc.centre = 0.5 * (trace.points.front() + trace.points.back());
    disc.dip = dip;
    disc.dip_direction = dip_direction;
    disc.radius = 0.5 * (trace.points.back() - trace.points.front()).norm();
    return disc;
}

std::string layersText(const std::vector<Trace>& traces) {
    std::set<std::string> layers;
    for (const Trace& trace : traces) layers.insert(trace.layer);
    std::string text;
    for (const std::string& layer : layers) text += (text.empty() ? "" : ", ") + toml::quoted(layer);
    return text;
}

/// ' on layer "J1"'; "" where all are wanted.
std::string onLayer(const TraceOptions& options) {
    return options.layer ? " on layer " + toml::quoted(*options.layer) : "";
}

Error noTraces(const std::vector<Trace>& lines, const std::string& left_out, const std::string& path,
               const TraceOptions& options) {
    const std::string found =
        "found no traces" + (left_out.empty() ? "" : " but " + left_out) + onLayer(options);
    if (lines.empty() || !options.layer)
        return {"", found + ", allowed: LINE, POLYLINE or LWPOLYLINE", path, 0, 0};
    return {"", found + ", allowed: a layer that has some: " + layersText(lines), path, 0, 0};
}

}  // namespace

TracePlane planeOfTrace(const std::vector<Vec3>& points) {
    TracePlane plane;
    double length = 0;
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k < points.size(); ++k) {
        const double piece = (points[k] - points[k - 1]).norm();
        sum += 0.5 * piece * (points[k] + points[k - 1] - 2 * points[0]);
        length += piece;
    }
    const Vec3 middle = points[0] + sum / length;
    // Over a piece of length l about its middle m: l (m m^T + d d^T / 12), d from end to end.
    Mat3 spread = Mat3::Zero();
    for (std::size_t k = 1; k < points.size(); ++k) {
        const Vec3 d = points[k] - points[k - 1], m = 0.5 * (points[k] + points[k - 1]) - middle;
        spread += d.norm() * (m * m.transpose() + d * d.transpose() / 12);
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);  // ascending
    const Vec3 normal = axes.eigenvectors().col(0), along = axes.eigenvectors().col(2);
    plane.normal = normal.z() < 0 ? Vec3(-normal) : normal;
    double least = 0, most = 0;
    for (const Vec3& point : points) {
        const Vec3 from = point - middle;
        least = std::min(least, along.dot(from));
        most = std::max(most, along.dot(from));
        plane.relief = std::max(plane.relief, (from - along.dot(from) * along).norm());
        plane.off_plane = std::max(plane.off_plane, std::abs(normal.dot(from)));
    }
    plane.length = most - least;
    return plane;
}

Result<Traces> parseTraces(const std::string& text, const std::string& path, const TraceOptions& options) {
    if (text.starts_with(kBinary))
        return Error{"", "found a binary DXF file, allowed: DXF as text (ASCII)", path, 0, 0};
    TraceReader reader(text, path);
    std::vector<Error> errors = reader.read();
    if (!errors.empty()) return errors;
    const std::vector<Trace> lines = reader.take();
    Traces traces;
    for (const Trace& line : lines) {
        if (options.layer && line.layer != *options.layer) continue;
        const auto disc = discOf(line, options);
        if (disc)
            traces.discs.push_back(*disc);
        else if (errors.size() < kMostFaults)
            errors.push_back({"", disc.errors().front().message, path, line.line, 0});
    }
    if (!errors.empty()) return errors;
    const std::string left_out = mesh::countedText(reader.leftOut(options.layer));
    if (traces.discs.empty()) return noTraces(lines, left_out, path, options);
    if (!left_out.empty())
        traces.notes.push_back("has " + left_out + onLayer(options) +
                               ", left out: traces are LINE, POLYLINE or LWPOLYLINE");
    if (reader.unit() && *reader.unit() != 1)
        traces.notes.push_back("has a unit of " + numberText(*reader.unit()) +
                               " m by its header, and was read in metres");
    return traces;
}

Result<Traces> readTraces(const std::string& path, const TraceOptions& options) {
    const auto text = toml::readFileText(path);
    if (!text) return text.errors();
    return parseTraces(*text, path, options);
}

}  // namespace talus::formats
