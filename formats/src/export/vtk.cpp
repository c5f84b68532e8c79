// VTK's XML poly data, arrays appended raw: exact, small, and written without a library of two gigabytes.

#include <array>
#include <charconv>
#include <cstring>

#include "export/placed.h"
#include "talus/contact_table.h"

namespace talus::formats {
namespace {

std::string shortest(double value) {
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// The file as it grows: elements in the head, their values in the appended part.
class PolyData {
 public:
    PolyData(std::size_t points, std::size_t vertices, std::size_t polygons) {
        head_ =
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
            std::to_string(points) + "\" NumberOfVerts=\"" + std::to_string(vertices) +
            "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(polygons) +
            "\">\n";
    }

    void open(const char* element) { head_ += std::string("<") + element + ">\n"; }
    void close(const char* element) { head_ += std::string("</") + element + ">\n"; }

    template <class Number>
    void array(const char* name, const std::vector<Number>& values, int components = 1) {
        head_ += std::string("<DataArray type=\"") + typeOf(Number{}) + "\" Name=\"" + name +
                 "\" NumberOfComponents=\"" + std::to_string(components) +
                 "\" format=\"appended\" offset=\"" + std::to_string(data_.size()) + "\"/>\n";
        const std::uint64_t bytes = values.size() * sizeof(Number);
        data_.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
        data_.append(reinterpret_cast<const char*>(values.data()), bytes);
    }

    std::string file() const {
        return head_ + "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + data_ +
               "\n</AppendedData>\n</VTKFile>\n";
    }

 private:
    static const char* typeOf(double) { return "Float64"; }
    static const char* typeOf(float) { return "Float32"; }
    static const char* typeOf(std::int32_t) { return "Int32"; }
    static const char* typeOf(std::int64_t) { return "Int64"; }

    std::string head_, data_;
};

void append(std::vector<double>& flat, const Vec3& v) { flat.insert(flat.end(), {v.x(), v.y(), v.z()}); }

std::vector<double> flat(const VectorList<double>& list) {
    std::vector<double> all;
    all.reserve(3 * list.x.size());
    for (std::size_t k = 0; k < list.x.size(); ++k) append(all, {list.x[k], list.y[k], list.z[k]});
    return all;
}

/// Values that each block has, spread over its faces.
struct FaceValues {
    std::vector<std::int32_t> block, motion, role;
    std::vector<float> displacement, velocity, rotation;
};

void append(std::vector<float>& flat, const VectorList<float>& list, std::size_t k) {
    flat.insert(flat.end(), {list.x[k], list.y[k], list.z[k]});
}

FaceValues faceValues(const SnapshotHeader& header, const LightFrame& frame) {
    const std::vector<FailureMode> roles = failureRoles(header, frame);
    FaceValues values;
    for (std::size_t b = 0; b < header.names.size(); ++b)
        for (auto f = header.geometry.face_begin[b]; f < header.geometry.face_begin[b + 1]; ++f) {
            if (header.geometry.isInner(static_cast<std::size_t>(f))) continue;
            values.block.push_back(static_cast<std::int32_t>(b));
            values.motion.push_back(static_cast<std::int32_t>(header.motions[b]));
            values.role.push_back(static_cast<std::int32_t>(roles[b]));
            append(values.displacement, frame.displacement, b);
            append(values.velocity, frame.velocity, b);
            append(values.rotation, frame.rotation, b);
        }
    return values;
}

/// Outlines of all faces but inner ones, one after the other, and where each ends.
struct Surface {
    std::vector<std::int32_t> vertex, end;

    template <class Outline>
    void add(const Outline& outline) {
        vertex.insert(vertex.end(), outline.begin(), outline.end());
        end.push_back(static_cast<std::int32_t>(vertex.size()));
    }
};

/// A file with its points [m] and polygons; data of points or cells follow.
PolyData polygonFile(const std::vector<double>& points, const Surface& surface) {
    PolyData poly(points.size() / 3, 0, surface.end.size());
    poly.open("Points");
    poly.array("Points", points, 3);
    poly.close("Points");
    poly.open("Polys");
    poly.array("connectivity", surface.vertex);
    poly.array("offsets", surface.end);
    poly.close("Polys");
    return poly;
}

Surface surfaceOf(const RunGeometry& g) {
    Surface surface;
    for (std::size_t f = 0; f + 1 < g.face_vertex_begin.size(); ++f) {
        if (g.isInner(f)) continue;
        surface.vertex.insert(surface.vertex.end(), g.face_vertex.begin() + g.face_vertex_begin[f],
                              g.face_vertex.begin() + g.face_vertex_begin[f + 1]);
        surface.end.push_back(static_cast<std::int32_t>(surface.vertex.size()));
    }
    return surface;
}

}  // namespace

std::string vtpBlocks(const SnapshotHeader& header, const LightFrame& frame) {
    const RunGeometry& g = header.geometry;
    std::vector<double> points;
    for (const Vec3& v : placedVertices(header, frame)) append(points, v);
    const FaceValues values = faceValues(header, frame);
    PolyData poly = polygonFile(points, surfaceOf(g));
    poly.open("CellData");
    poly.array("block_id", values.block);
    poly.array("motion", values.motion);
    poly.array("failure_role", values.role);
    poly.array("displacement", values.displacement, 3);
    poly.array("velocity", values.velocity, 3);
    poly.array("rotation", values.rotation, 3);
    poly.close("CellData");
    return poly.file();
}

std::string vtpContacts(const FullFrame& full) {
    const ContactTable table = contactTable(full);
    const std::size_t n = table.size();
    std::vector<std::int64_t> index(n), offsets(n);
    for (std::size_t k = 0; k < n; ++k) {
        index[k] = static_cast<std::int64_t>(k);
        offsets[k] = static_cast<std::int64_t>(k + 1);
    }
    PolyData poly(n, n, 0);
    poly.open("Points");
    poly.array("Points", flat(table.position), 3);
    poly.close("Points");
    poly.open("Verts");
    poly.array("connectivity", index);
    poly.array("offsets", offsets);
    poly.close("Verts");
    poly.open("PointData");
    poly.array("force", flat(table.force), 3);
    poly.array("normal_force", table.normal_force);
    poly.array("shear_force", flat(table.shear), 3);
    poly.array("water_force", table.water_force);
    poly.array("area", table.area);
    std::vector<std::int32_t> state;
    for (const PointState each : table.state) state.push_back(static_cast<std::int32_t>(each));
    poly.array("state", state);
    poly.array("mobilised_friction", table.mobilised);
    poly.array("interface", table.interface);
    poly.array("block_a", table.block_a);
    poly.array("block_b", table.block_b);
    poly.close("PointData");
    return poly.file();
}

std::string vtpMap(const PolygonMap& map) {
    std::vector<double> points;
    for (const Vec3& v : map.vertices) append(points, v);
    Surface surface;
    for (const auto& polygon : map.polygons) surface.add(polygon);
    PolyData poly = polygonFile(points, surface);
    poly.open("CellData");
    for (const auto& [name, values] : map.values) poly.array(name.c_str(), values);
    poly.close("CellData");
    return poly.file();
}

std::string vtpFlow(const SteadyFlow& flow) {
    std::vector<double> points, discharge;
    for (const Vec3& x : flow.nodes) append(points, x);
    for (const Vec3& q : flow.discharge) append(discharge, q);
    Surface surface;
    for (const auto& triangle : flow.triangles) surface.add(triangle);
    PolyData poly = polygonFile(points, surface);
    poly.open("PointData");
    poly.array("head", flow.head);
    poly.array("pressure", flow.pressure);
    poly.array("inflow", flow.inflow);
    poly.close("PointData");
    poly.open("CellData");
    poly.array("discharge", discharge, 3);
    poly.array("wet_share", flow.wet_share);
    poly.array("aperture", flow.aperture);
    poly.array("joint", flow.joint);
    poly.array("block_a", flow.block_a);
    poly.array("block_b", flow.block_b);
    poly.close("CellData");
    return poly.file();
}

std::string pvdSeries(const std::vector<std::pair<double, std::string>>& files) {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n";
    for (const auto& [time, file] : files)
        text += "<DataSet timestep=\"" + shortest(time) + "\" part=\"0\" file=\"" + file + "\"/>\n";
    return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace talus::formats
